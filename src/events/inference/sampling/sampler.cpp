#include "events/inference/sampling/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "events/inference/sampling/proposal.hpp"
#include "math/roots.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::MeasuredValue;
using catalogue::Observation;
using catalogue::RuptureVelocityIs;
using catalogue::StressDropIs;
using catalogue::UncertainConstant;
using medium::Constants;
using medium::elastic;

namespace {

Surroundings surroundings_of(const Observation& o, const medium::Elastic& elastic) {
  Surroundings s{.elastic = elastic, .plastic = medium::plastic_contact_ratio(elastic.poisson_ratio)};
  s.spacing = o.asperity_spacing.value_or(0);
  if (const MeasuredValue* time = o.damping_time()) s.duration = time->middle();
  s.slipping = o.slip_time() ? o.slip_time()->middle() : 1;
  if (o.hardness) s.hardness = o.hardness->middle();
  return s;
}

/// Root of `f` between two points at which it has opposite signs.
template <class F>
double root_between(double low, double high, double at_low, double at_high, const F& f) {
  const double sign = at_low > 0 ? -1 : 1;  // a bracket needs a rising function
  return root_of({low, high, sign * at_low, sign * at_high, low}, 1e-13, 1e-13, 1,
                 [&](double x) { return sign * f(x); });
}

bool has(const std::vector<Evidence>& evidence, Source source) {
  return std::any_of(evidence.begin(), evidence.end(), [&](const Evidence& e) { return e.source == source; });
}

bool has_errors(const Observation& o) {
  for (const auto* m : {&o.rupture_velocity_m_s, &o.slip_velocity_m_s, &o.slip, &o.rise_time, &o.duration,
                        &o.friction_coefficient, &o.stress_drop, &o.normal_stress, &o.hardness})
    if (*m && !(*m)->is_exact()) return true;
  return !o.uncertain_constants.empty();
}

}  // namespace

Sampler::Sampler(const Observation& o, const medium::Defaults& defaults, const Sampling& sampling,
                 std::string_view without, const std::optional<MeasuredValue>& within)
    : o_(o),
      defaults_(defaults),
      velocity_(o.rupture_velocity_m_s),
      model_(o, sampling.closure),
      all_(evidence_of(o)),
      predicts_range_(within.has_value()),
      seed_(seed_of(sampling.seed, o)),
      points_(sampling.samples, seed_),
      middle_(surroundings_of(o, elastic(o, defaults))),
      constants_(static_cast<const Constants&>(o)),
      around_(middle_) {
  const double c = middle_.elastic.speed;
  if (without == "rupture_velocity")
    velocity_ = within.value_or(MeasuredValue{model_.least_seen() * c, model_.most_seen() * c});
  for (const Evidence& e : all_) {
    if (e.name == without && !within) continue;
    used_.push_back(e);
    if (e.name == without) used_.back().measured = *within;
  }
  if (within) sort_by_precision(used_);
  choose_mode(!without.empty());
  if (mode_ != Mode::nothing) make_cells();
}

void Sampler::choose_mode(bool predicts) {
  const bool slips = has(used_, Source::slip), drops = has(used_, Source::drop),
             front = velocity_ && o_.rupture_velocity_is == RuptureVelocityIs::front;
  const bool static_drop = drops && o_.stress_drop_is == StressDropIs::static_drop;
  const bool several = used_.size() > 1;
  knows_contact_ = has(used_, Source::contact) || has(used_, Source::strength) || drops;
  fixes_friction_ = several && (slips || has(used_, Source::friction) || (drops && (static_drop || front)));
  const bool moves = front ? slips || drops : static_drop;
  if (velocity_ && (predicts || moves || fixes_friction_)) {
    mode_ = Mode::friction;
  } else {
    std::erase_if(used_, [](const Evidence& e) { return e.source == Source::friction; });
    const bool bounds = velocity_ ? front || (slips && !knows_contact_) : slips && knows_contact_ && !drops;
    mode_ = bounds ? Mode::bounds : velocity_ ? Mode::contact : Mode::nothing;
  }
  // Two exact observations determine A and the damping number. A third one is not needed.
  std::size_t exact = 0;
  const std::size_t most = mode_ == Mode::friction ? 2 : velocity_ ? 1 : 2;
  std::erase_if(used_, [&](const Evidence& e) {
    const bool too_many = e.measured.is_exact() && ++exact > most;
    if (too_many) unused_.push_back(e.name);
    return too_many;
  });
  solves_damping_ = mode_ == Mode::friction && exact >= 2;
  has_errors_ = has_errors(o_);
  uncertain_ = has_errors_ || (mode_ == Mode::friction && !solves_damping_);
  if (mode_ == Mode::friction && used_.empty())
    used_.push_back({Source::contact, "contact_ratio", MeasuredValue{least_contact_ratio, middle_.plastic}, 0});
  if (mode_ == Mode::bounds && !velocity_)  // the slip velocity comes first, then the contact ratio
    std::stable_partition(used_.begin(), used_.end(), [](const Evidence& e) { return e.source == Source::slip; });
}

bool Sampler::draw_surroundings() {
  std::size_t dimension = 6;
  bool moved = false;
  for (const UncertainConstant& c : o_.uncertain_constants) {
    if (c.member == &Constants::contact_ratio) continue;
    const double value = at(c.measured, dimension++);
    if (!(value > 0) && c.member != &Constants::poisson_ratio) return refuse(bad_constants);
    constants_.*c.member = value;
    moved = moved || c.member != &Constants::asperity_spacing;
  }
  if (moved) try {
      around_.elastic = elastic(constants_, defaults_);
      around_.plastic = medium::plastic_contact_ratio(around_.elastic.poisson_ratio);
    } catch (const InputError&) {
      return refuse(bad_constants);
    }
  around_.spacing = constants_.asperity_spacing.value_or(0);
  const MeasuredValue *time = o_.damping_time(), *slip_time = o_.slip_time();
  if (time) around_.duration = at(*time, 3);
  if (slip_time) around_.slipping = slip_time == time ? around_.duration : at(*slip_time, 5);
  if (o_.hardness) around_.hardness = at(*o_.hardness, 4);
  return ((!time || around_.duration > 0) && around_.slipping > 0 && (!o_.hardness || around_.hardness > 0)) ||
         refuse(contradicted);
}

std::vector<Sampler::Root> Sampler::roots(double seen) {
  const double most_u = model_.most_u(seen);
  const Evidence &a = used_[0], &b = used_[1];
  const auto gap = [&](double u) {
    const PulseState p = model_.at(seen, u);
    return a.contact(std::log(a.measured.low), a.offset(p, u, around_)) -
           b.contact(std::log(b.measured.low), b.offset(p, u, around_));
  };
  const int steps = o_.rupture_velocity_is == RuptureVelocityIs::front ? 16 : 4;
  std::vector<Root> found;
  double low = 0, at_low = gap(0);
  for (int i = 1; i <= steps; ++i) {
    const double high = most_u * i / steps, at_high = gap(high);
    if (at_low == 0 || (at_low < 0) != (at_high < 0)) {
      const double u = at_low == 0 ? low : root_between(low, high, at_low, at_high, gap);
      const double h = 1e-4, above = std::fmin(u + h, most_u), below = std::fmax(u - h, 0.0);
      const double slope = (gap(above) - gap(below)) / (above - below);
      found.push_back({u, model_.at(seen, u).slope / std::fabs(slope)});
    }
    low = high, at_low = at_high;
  }
  if (found.empty()) {
    const bool slip_with_contact = a.source == Source::slip && b.source != Source::friction;
    refuse(!slip_with_contact ? bad_contact : gap(0) > 0 ? slips_too_fast : slips_too_slowly);
  }
  return found;
}

/// Draws u. Where two exact observations determine it, the share chooses one of the solutions.
std::optional<double> Sampler::draw_damping(Sample& s, double seen, double share, double most_u) {
  if (mode_ != Mode::friction) return 0;
  if (!solves_damping_) {
    s.weight *= most_u;
    return share * most_u;
  }
  const std::vector<Root> all = roots(seen);
  if (all.empty()) return std::nullopt;
  double sum = 0, below = 0;
  for (const Root& root : all) sum += root.weight;
  s.weight *= sum;
  for (const Root& root : all)
    if ((below += root.weight) >= points_(point_, 1) * sum) return root.u;
  return all.back().u;
}

bool Sampler::draw_pulse(Sample& s, const Cells::Point& point) {
  const double V = std::exp(point.first), seen = V / around_.elastic.speed;
  if (!(seen > 0 && seen < 1)) return refuse(too_fast);
  if (!velocity_->is_exact()) s.weight *= velocity_->likelihood(V);
  const double most_u = mode_ == Mode::friction ? model_.most_u(seen) : 0;
  if (most_u < 0) return refuse(off_table);
  const auto u = draw_damping(s, seen, point.second, most_u);
  if (!u) return false;
  const PulseState p = mode_ == Mode::friction ? model_.at(seen, *u) : model_.without_friction(seen);
  if (!solves_damping_) s.weight *= p.slope;
  s.state.rupture_velocity_m_s = V;
  s.state.rupture_velocity = seen;
  return weigh(s, p, *u, point.third);
}

/// Draws A from the first evidence and multiplies the weight by the likelihood of the others.
bool Sampler::weigh(Sample& s, const PulseState& p, double u, double ln_x) {
  double ln_A = std::numeric_limits<double>::quiet_NaN();
  if (!used_.empty()) {
    ln_A = used_[0].contact(ln_x, used_[0].offset(p, u, around_));
    if (!(ln_A >= std::log(least_contact_ratio) && ln_A <= std::log(around_.plastic))) return refuse(bad_contact);
  }
  for (const Evidence& e : used_)
    if (!e.measured.is_exact()) s.weight *= e.measured.likelihood_of_log(e.predicted(ln_A, e.offset(p, u, around_)));
  if (!(s.weight > 0 && std::isfinite(s.weight))) return refuse(contradicted);
  fill(s, p, u, ln_A);
  return true;
}

void Sampler::set_friction(FaultState& state, const PulseState& p, double u, double A) const {
  state.damping_number = std::expm1(u);
  if (knows_duration() && around_.spacing > 0)
    state.friction_coefficient =
        state.damping_number * around_.spacing / (around_.duration * around_.elastic.speed * A);
  state.static_drop_pa =
      medium::stress_unit(around_.elastic.shear_modulus, A) * p.stress * model_.static_share(p.stress, u);
}

void Sampler::fill(Sample& s, const PulseState& p, double u, double ln_A) const {
  FaultState& state = s.state;
  const bool front = o_.rupture_velocity_is == RuptureVelocityIs::front;
  const double A = std::exp(ln_A);
  std::optional<double> w;
  state.frictionless_slip_velocity = p.frictionless;
  if (mode_ == Mode::bounds) {
    (front ? state.stress_bound : state.stress) = p.stress;
    (knows_contact_ ? state.contact_ratio : state.contact_ratio_bound) = A;
  } else {
    state.stress = p.stress;
    state.contact_ratio = A;
    state.characteristic_velocity = p.rupture_velocity;
  }
  if (mode_ == Mode::friction) {
    set_friction(state, p, u, A);
    if (knows_slip_velocity() && knows_contact_) w = medium::slip_velocity_unit(around_.elastic.speed, A) * p.W;
  }
  derive(state, around_.elastic, w);
  for (std::size_t i = 0; i < std::min(all_.size(), s.predicted.size()); ++i)
    s.predicted[i] = all_[i].predicted(ln_A, all_[i].offset(p, u, around_));
}

bool Sampler::draw_without_velocity(Sample& s, const Cells::Point& point) {
  const Evidence &slip = used_[0], &contact = used_[1];
  const double A = std::exp(contact.contact(point.third, contact.offset({}, 0, around_)));
  if (!(A >= least_contact_ratio && A <= around_.plastic)) return refuse(bad_contact);
  const double x = std::exp(point.first), w = x / around_.slipping;
  if (!slip.measured.is_exact()) s.weight *= slip.measured.likelihood(x);
  if (!contact.measured.is_exact()) s.weight *= contact.measured.likelihood(std::exp(point.third));
  s.state.contact_ratio = A;
  s.state.stress_bound = rupture::from_slip_velocity(w / medium::slip_velocity_unit(around_.elastic.speed, A)).stress;
  derive(s.state, around_.elastic, w);
  return s.weight > 0 || refuse(contradicted);
}

std::vector<FaultState> Sampler::draw_prior(std::size_t count) {
  std::vector<FaultState> all;
  const std::size_t most = 4 * count;  // some points are rejected, for example a normal error that reaches below zero
  grow(most);
  for (point_ = 0; point_ < most && all.size() < count; ++point_) {
    if (!draw_surroundings()) continue;
    const double u = points_(point_, 1) * std::log1p(most_damping_number);
    const double least = std::log(least_contact_ratio);
    const double A = std::exp(least + points_(point_, 2) * (std::log(around_.plastic) - least));
    const PulseState p = model_.of_prior(points_(point_, 0), u);
    FaultState s = unknown_state();
    s.rupture_velocity = model_.seen(p, u);
    s.rupture_velocity_m_s = s.rupture_velocity * around_.elastic.speed;
    s.characteristic_velocity = p.rupture_velocity;
    s.stress = p.stress;
    s.frictionless_slip_velocity = p.frictionless;
    s.contact_ratio = A;
    set_friction(s, p, u, A);
    derive(s, around_.elastic, medium::slip_velocity_unit(around_.elastic.speed, A) * p.W);
    all.push_back(s);
  }
  all.resize(count, unknown_state());
  return all;
}

Sample Sampler::draw(std::size_t i) {
  point_ = i;
  Sample s{1, unknown_state(), {}};
  if (!draw_surroundings()) return {};
  const Cells::Point point = cells_->at(points_(i, 0), points_(i, 1), points_(i, 2));
  s.weight /= point.density;  // weight = prior x likelihood / proposal density; the functions below multiply by both
  if (velocity_ ? draw_pulse(s, point) : draw_without_velocity(s, point)) return s;
  return {};
}

}  // namespace slipfront::inference
