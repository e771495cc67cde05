#include "events/inference/sampling/proposal.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "events/inference/sampling/sampler.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/inference/posterior.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::inference {
namespace {

/// Steele, Lea & Flood's mixer (splitmix64).
std::uint64_t mixed(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The sequence without shift, made once for each number of points.
const std::vector<std::uint64_t>& sequence(std::size_t points) {
  static std::mutex mutex;
  static std::map<std::size_t, std::vector<std::uint64_t>> known;
  const std::scoped_lock lock(mutex);
  std::vector<std::uint64_t>& found = known[points];
  if (found.empty()) {
    boost::random::sobol engine(ShiftedSobol::dimensions);
    found.resize(points * ShiftedSobol::dimensions);
    for (std::uint64_t& x : found) x = engine();
  }
  return found;
}

}  // namespace

ShiftedSobol::ShiftedSobol(std::size_t points, std::uint64_t seed) : points_(&sequence(points)) {
  for (std::uint64_t& shift : shift_) shift = mixed(seed);
}

void ShiftedSobol::grow(std::size_t points) { points_ = &sequence(points); }

double ShiftedSobol::operator()(std::size_t point, std::size_t dimension) const {
  const std::uint64_t bits = (*points_)[point * dimensions + dimension] ^ shift_[dimension];
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

std::uint64_t seed_of(std::uint64_t seed, const catalogue::Observation& o) {
  std::uint64_t state = seed;
  const auto add = [&](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    state ^= bits;
    state = mixed(state);
  };
  const auto add_measured = [&](const catalogue::MeasuredValue& m) {
    for (const double x : {m.low, m.high, m.spread, m.spread_below, static_cast<double>(m.shape)}) add(x);
  };
  const auto none = std::numeric_limits<double>::quiet_NaN();
  for (const auto* m : {&o.rupture_velocity_m_s, &o.slip_velocity_m_s, &o.slip, &o.rise_time, &o.duration,
                        &o.stress_drop, &o.friction_coefficient, &o.normal_stress, &o.hardness})
    *m ? add_measured(**m) : add(none);
  for (const medium::Constant& c : medium::constants()) add((o.*c.member).value_or(none));
  for (const catalogue::UncertainConstant& c : o.uncertain_constants) add_measured(c.measured);
  add(static_cast<double>(o.measure()));
  add(static_cast<double>(o.rupture_velocity_is));
  add(static_cast<double>(o.stress_drop_is));
  add(o.front_threshold);
  return mixed(state) >> 11;  // whole in a JSON number
}

using catalogue::MeasuredValue;

namespace {

constexpr std::size_t first_cells = 16, refined_cells = 28;
/// Length in ln V of a wide range.
constexpr double wide_range = 4;
/// Ratio of the stresses at the edges of further cells of V.
constexpr double stress_step = 1.5;
/// Part of the samples that is drawn without regard to the other observations, so that no weight becomes large.
constexpr double defence = 0.1;

const double least_ln_A = std::log(least_contact_ratio);

double likelihood(const MeasuredValue& m, double ln_x) { return m.is_exact() ? 1 : m.likelihood_of_log(ln_x); }

/// The first cells over the share of the largest damping number. They are narrow near 1, where |V-| tends to c and the
/// slip velocity rises steeply.
Axis damping_axis() {
  Axis axis;
  for (std::size_t i = 0; i <= first_cells; ++i) {
    const double s = static_cast<double>(i) / first_cells;
    axis.edges.push_back(s * (2 - s));
  }
  return axis;
}

/// Adds edges at stresses that grow by `stress_step`, because W rises steeply where |V-| tends to c.
void add_stress_edges(Axis& velocities, const PulseModel& model, double speed) {
  const auto range = friction_ratio::stress_range();
  const double low = velocities.edges.front(), high = velocities.edges.back();
  const int steps = static_cast<int>(std::log(range.most / range.least) / std::log(stress_step));
  for (int i = 1; i <= steps; ++i) {
    const double ln_V = std::log(model.seen_without_friction(range.least * std::pow(stress_step, i)) * speed);
    if (ln_V > low && ln_V < high) velocities.edges.push_back(ln_V);
  }
  std::sort(velocities.edges.begin(), velocities.edges.end());
}

/// Largest change of ln W from a cell to its neighbours.
double change_of_W(const std::vector<PulseState>& pulses, std::size_t j) {
  double change = 0;
  if (j > 0) change = std::fabs(std::log(pulses[j].W / pulses[j - 1].W));
  if (j + 1 < pulses.size()) change = std::fmax(change, std::fabs(std::log(pulses[j + 1].W / pulses[j].W)));
  return change;
}

/// Whether V is so uncertain that its cells are moved to where the likelihood of the others is.
bool is_wide(const MeasuredValue& m, const Axis& axis) {
  return m.is_range() && axis.edges.back() - axis.edges.front() > wide_range;
}

/// A wide density around a measured value: the fourth root of its likelihood, which has twice its standard deviation.
std::vector<double> wide(const Axis& axis, const MeasuredValue& m) {
  std::vector<double> base;
  for (std::size_t i = 0; i < axis.cells(); ++i) base.push_back(std::sqrt(std::sqrt(likelihood(m, axis.centre(i)))));
  return base;
}

}  // namespace

/// The likelihoods of the observations at one pulse, as functions of the first of them.
class Sampler::AlongThird {
 public:
  AlongThird(const Sampler& sampler, const PulseState& pulse, double u, double resolution)
      : sampler_(sampler), resolution_(resolution) {
    for (const Evidence& e : sampler.used_) offsets_.push_back(e.offset(pulse, u, sampler.middle_));
  }
  /// Product of the likelihoods, but that of the first observation itself. `width` is that of the cell around ln_x: a
  /// cell whose middle is outside the range of A may reach into it.
  double operator()(double ln_x, double width) const {
    const std::vector<Evidence>& used = sampler_.used_;
    if (used.empty()) return 1;
    const double ln_A = used[0].contact(ln_x, offsets_[0]);
    const double margin = std::fmin(width, 1.0) + 2 * resolution_;
    if (!(ln_A >= least_ln_A - margin && ln_A <= sampler_.most_ln_A_ + margin)) return 0;
    double product = 1;
    for (std::size_t i = 1; i < used.size(); ++i)
      if (!used[i].measured.is_exact() || used[i].blur > 0)
        product *=
            used[i].blurred_likelihood(used[i].predicted(ln_A, offsets_[i]), resolution_, sampler_.predicts_range_);
    return product;
  }

 private:
  const Sampler& sampler_;
  double resolution_;
  std::vector<double> offsets_;
};

/// Change of ln W without friction in a cell of V. The cells of a wide range are so wide that no centre need agree with
/// the observations.
double Sampler::change_of_W_in(const Axis& velocities, std::size_t i) const {
  const auto ln_W = [&](double ln_V) {
    return std::log(model_.without_friction(std::exp(ln_V) / middle_.elastic.speed).W);
  };
  return std::fabs(ln_W(velocities.edges[i + 1]) - ln_W(velocities.edges[i]));
}

/// One row of cells: those of one observed velocity.
void Sampler::fill_row(Filled& filled, std::size_t i, const std::vector<double>& of_third) const {
  Cells& cells = filled.cells;
  const Axis &first = cells.axis(0), &second = cells.axis(1), &third = cells.axis(2);
  const double of_first = likelihood(velocity_ ? *velocity_ : used_[0].measured, first.centre(i));
  if (!velocity_ || solves_damping_) {
    for (std::size_t k = 0; k < third.cells(); ++k)
      filled.best = std::fmax(filled.best, cells.target(i, 0, k) = of_first * (velocity_ ? 1 : of_third[k]));
    return;
  }
  const double seen = std::exp(first.centre(i)) / middle_.elastic.speed;
  const double most_u = mode_ == Mode::friction ? model_.most_u(seen) : 0;
  if (most_u < 0 || !(seen < 1)) {
    filled.off_table = true;
    return;
  }
  std::vector<PulseState> pulses;
  for (std::size_t j = 0; j < second.cells(); ++j)
    pulses.push_back(mode_ == Mode::friction ? model_.at(seen, most_u * second.centre(j))
                                             : model_.without_friction(seen));
  double first_width = first.is_exact() ? 0 : 0.3 * first.width(i);
  if (velocity_ && is_wide(*velocity_, first)) first_width = std::fmax(first_width, 0.3 * change_of_W_in(first, i));
  for (std::size_t j = 0; j < second.cells(); ++j) {
    const double factor = mode_ == Mode::friction ? most_u * pulses[j].slope : 1;
    const double resolution = std::hypot(first_width, 0.3 * change_of_W(pulses, j));
    const AlongThird others(*this, pulses[j], most_u * second.centre(j), resolution);
    for (std::size_t k = 0; k < third.cells(); ++k) {
      const double fit = of_first * of_third[k] * others(third.centre(k), third.is_exact() ? 0 : third.width(k));
      cells.target(i, j, k) = factor * fit;
      filled.best = std::fmax(filled.best, fit);
    }
  }
}

Sampler::Filled Sampler::filled(const Axis& first, const Axis& second, const Axis& third) const {
  Filled filled{Cells(first, second, third), 0, false};
  const std::size_t of_contact = velocity_ ? 0 : 1;
  std::vector<double> of_third(third.cells(), 1.0);
  if (used_.size() > of_contact)
    for (std::size_t k = 0; k < third.cells(); ++k)
      of_third[k] = likelihood(used_[of_contact].measured, third.centre(k));
  for (std::size_t i = 0; i < first.cells(); ++i) fill_row(filled, i, of_third);
  return filled;
}

/// One cell: the prior of the damping number is its proposal.
void Sampler::make_cell_of_damping(const Axis& first, const Axis& third) {
  if (model_.most_u(velocity_->low / middle_.elastic.speed) < 0) {
    ++refused_[off_table];
    least_misfit_ = std::numeric_limits<double>::infinity();
    return;
  }
  cells_.emplace(first, Axis::uniform(0, 1, 1), third);
  cells_->target(0, 0, 0) = 1;
  cells_->finish(defence, {1}, {1});
}

void Sampler::make_cells() {
  const double c = middle_.elastic.speed;
  const bool tabled = mode_ == Mode::friction;
  const MeasuredValue& of_first = velocity_ ? *velocity_ : used_[0].measured;
  const double low = velocity_ ? (tabled ? model_.least_seen() : 1e-30) * c : 1e-30;
  const double high = velocity_ ? (tabled ? model_.most_seen() : 1 - 1e-12) * c : 1e30;
  Axis first = axis_of(of_first, low, high, Fineness::coarse);
  const MeasuredValue* of_third = used_.size() > (velocity_ ? 0 : 1) ? &used_[velocity_ ? 0 : 1].measured : nullptr;
  const Axis third = of_third ? axis_of(*of_third, 1e-60, 1e60, Fineness::fine) : Axis::exact(0);
  most_ln_A_ = std::log(middle_.plastic);
  if (first.edges.empty()) {
    ++refused_[off_table];
    least_misfit_ = std::numeric_limits<double>::infinity();
    return;
  }
  if (predicts_range_ && tabled && !first.is_exact()) add_stress_edges(first, model_, c);
  const bool over_damping = mode_ == Mode::friction && !solves_damping_;
  if (knows_all_but_damping()) return make_cell_of_damping(first, third);
  Filled now = filled(first, over_damping ? damping_axis() : Axis::exact(0), third);
  // The likelihoods of the first cells are wide. If their misfit is twice that of hopeless observations, finer cells
  // would not agree either.
  if (over_damping && now.best > std::exp(-hopeless_misfit)) {
    for (int i = 0; i < 2 && is_wide(of_first, first); ++i) {
      first = now.cells.refined(0, first.cells());
      now = filled(first, damping_axis(), third);
    }
    now = filled(first, now.cells.refined(1, refined_cells), third);
  }
  least_misfit_ = now.best > 0 ? -2 * std::log(now.best) : std::numeric_limits<double>::infinity();
  if (!(now.best > 0)) {
    ++refused_[now.off_table ? off_table : mode_ == Mode::bounds ? bad_contact : contradicted];
    return;
  }
  now.cells.finish(defence, wide(first, of_first), of_third ? wide(third, *of_third) : std::vector<double>{1});
  cells_ = std::move(now.cells);
}

using catalogue::Observation;
using catalogue::RuptureVelocityIs;
using catalogue::SlipVelocityKind;
using catalogue::StressDropIs;
using friction_ratio::Drop;
using friction_ratio::stress_range;

namespace {

/// ln |V-| and Sigma- at psi, with their slopes by ln psi (Eqs. 8-10).
struct Front {
  double ln_V, V_slope, stress, stress_slope;
};
Front front_at(double psi) {
  const elliptic::AtPsi at = elliptic::at_psi(psi);
  const double m = (1 - at.s) * (1 + at.s), K_slope = elliptic::log_slope_of_K(at), E_slope = at.s * (1 / at.ratio - 1);
  const double stress = std::acos(-1.0) * std::cosh(psi) / at.K;
  return {std::log(at.s / at.ratio), psi * (m / at.s + K_slope - E_slope), stress, stress * psi * (at.s - K_slope)};
}

/// A first guess of psi, from |V-| = psi ln(4 / psi) for small psi.
double rough_psi(double V) {
  const double log = std::log(4 / V);
  return V / (log + std::log(std::fmax(log, 1.0)));
}

}  // namespace

double frictionless(SlipVelocityKind measure, double stress, double W_at_origin) {
  if (measure != SlipVelocityKind::mean) return W_at_origin;
  const auto range = stress_range();
  const double tabled = std::fmin(std::fmax(stress, range.least), range.most);
  return W_at_origin * friction_ratio::evaluate(measure, friction::Closure::consistent, tabled, 0).value;
}

PulseModel::PulseModel(const Observation& o, friction::Closure closure)
    : measure_(o.measure()),
      closure_(closure),
      sees_front_(o.rupture_velocity_is == RuptureVelocityIs::front),
      static_drop_(o.stress_drop && o.stress_drop_is == StressDropIs::static_drop),
      front_(closure, o.front_threshold) {
  static const rupture::Relations least = rupture::from_stress(stress_range().least);
  static const rupture::Relations most = rupture::from_stress(stress_range().most);
  least_psi_ = least.psi;
  most_psi_ = most.psi;
  least_ln_V_ = std::log(least.rupture_velocity);
  most_ln_V_ = std::log(most.rupture_velocity);
  least_seen_ = least.rupture_velocity * (sees_front_ ? front_(least.stress, 0).value : 1);
  most_seen_ = most.rupture_velocity * (sees_front_ ? front_(most.stress, 0).value : 1);
}

double PulseModel::most_u(double seen) const {
  static const double most_damping_u = std::log1p(most_damping_number);
  if (!(seen >= least_seen_ && seen <= most_seen_)) return no_pulse;
  if (!sees_front_) return most_damping_u;
  const double ratio = seen / most_seen_ * front_(stress_range().most, 0).value;
  const auto excess = [&](double u) {
    const double damping = std::expm1(u);
    const friction_ratio::Ratio r = front_(stress_range().most, damping);
    return std::pair(std::log(r.value / ratio), (1 + damping) * r.by_damping / r.value);
  };
  if (excess(most_damping_u).first >= 0) return most_damping_u;
  return bracketed_newton(0, most_damping_u, std::fmin(2 * std::log1p(1 / ratio), most_damping_u), false, excess);
}

PulseState PulseModel::state(const rupture::Relations& r, double slope, double damping) const {
  const double stress = std::clamp(r.stress, stress_range().least, stress_range().most);
  return {.rupture_velocity = r.rupture_velocity,
          .stress = r.stress,
          .frictionless = r.slip_velocity,
          .W = r.slip_velocity * friction_ratio::evaluate_value(measure_, closure_, stress, damping),
          .drop_share = static_drop_ ? drop_share(stress, damping) : 1,
          .slope = slope};
}

double PulseModel::static_share(double stress, double u) const {
  return drop_share(std::clamp(stress, stress_range().least, stress_range().most), std::expm1(u));
}

double PulseModel::drop_share(double stress, double damping) const {
  return friction_ratio::stress_drop_share(Drop::origin, closure_, stress, damping).value;
}

PulseState PulseModel::at(double seen, double u) const {
  const double damping = std::expm1(u), wanted = std::log(seen);
  if (!sees_front_) return state(rupture::from_rupture_velocity(seen), 1, damping);
  const friction_ratio::FrontAtDamping front = front_.at_damping(damping);
  double slope = 1;
  const auto excess = [&](double ln_psi) {
    const Front f = front_at(std::exp(ln_psi));
    const friction_ratio::Ratio r = front(std::clamp(f.stress, stress_range().least, stress_range().most));
    const double by_psi = f.V_slope + r.by_stress / r.value * f.stress_slope;
    slope = f.V_slope / by_psi;
    return std::pair(f.ln_V + std::log(r.value) - wanted, by_psi);
  };
  const double ratio = front(1).value;
  const double guess = std::clamp(rough_psi(std::fmin(seen / ratio, 0.99)), least_psi_, most_psi_);
  const double ln_psi = bracketed_newton(std::log(least_psi_), std::log(most_psi_), std::log(guess), true, excess);
  return state(rupture::from_psi(std::exp(ln_psi)), slope, damping);
}

PulseState PulseModel::of_prior(double share, double u) const {
  const double V = std::exp(least_ln_V_ + share * (most_ln_V_ - least_ln_V_));
  return state(rupture::from_rupture_velocity(V), 1, std::expm1(u));
}

double PulseModel::seen_without_friction(double stress) const {
  return rupture::from_stress(stress).rupture_velocity * (sees_front_ ? front_(stress, 0).value : 1);
}

double PulseModel::seen(const PulseState& p, double u) const {
  if (!sees_front_) return p.rupture_velocity;
  const double stress = std::clamp(p.stress, stress_range().least, stress_range().most);
  return p.rupture_velocity * front_(stress, std::expm1(u)).value;
}

PulseState PulseModel::without_friction(double seen) const {
  const rupture::Relations r = rupture::from_rupture_velocity(seen);
  return {.rupture_velocity = r.rupture_velocity,
          .stress = r.stress,
          .frictionless = r.slip_velocity,
          .W = frictionless(measure_, r.stress, r.slip_velocity),
          .drop_share = static_drop_ ? 1 - r.stress_at_origin / r.stress : 1,
          .slope = 1};
}

}  // namespace slipfront::inference
