#include "lattice/chain/run_observer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "lattice/chain/observe/averages.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::chain {
namespace {

using output::Snapshot;

/// Number of dislocations in the window of velocities and stresses (smooth_average). Their ripple is then some 0.1 %.
constexpr double dislocations_in_window = 8;

/// Dislocations are much wider than 1/8 of a site. A chain with more dislocations has diverged.
constexpr double most_dislocations_a_site = 8;

/// Spacings of the trains just left and right of x = 0.
struct Spacings {
  double dense, dilute;
};

/// If there is only one train, both spacings are its own; if there is none at x = 0, that at an end, or else a default.
Spacings spacings_of_trains(const ScaledProblem& s) {
  const double next = 1e-9 * (s.right - s.left), k_left = s.stress(-next), k_right = s.stress(next);
  const auto spacing = [&](double k) { return 2 * std::numbers::pi / k / s.scale; };
  if (const double most = std::fmax(k_left, k_right); most > 0) {
    const double least = std::fmin(k_left, k_right);
    return {spacing(most), spacing(least > 0 ? least : most)};
  }
  for (const double x : {s.left, s.right})
    if (const double k = s.stress(x); k > 0) return {spacing(k), spacing(k)};
  return {(s.right - s.left) / 16, (s.right - s.left) / 16};
}

/// The number of steps to each sample of the velocity at x = 0, which we integrate. It grows with the number of steps
/// so far, so that a run has 200 samples or more. It does not depend on the end, so that a run to a later end can
/// continue this one. In a short chain we sample often enough to resolve the slip velocity while a single dislocation
/// passes x = 0.
long steps_per_sample(long steps, std::size_t sites) {
  constexpr long first = 6400;
  constexpr std::size_t few_sites = 5000;
  const bool few = sites < few_sites;
  const long most = few ? 32 : std::numeric_limits<long>::max() / 2;
  long every = few ? 2 : 32;
  for (long doubled = steps / first; doubled > 1 && every < most; doubled /= 2) every *= 2;
  return every;
}

/// The first step after `steps` at which the run samples the velocity. There is one sample at a random step in each
/// interval. A train passes x = 0 periodically, and samples in a regular pattern could repeatedly meet the same phase.
long sample_after(long steps, std::size_t sites) {
  const auto sample = [](long n, long every) {
    std::uint64_t z = static_cast<std::uint64_t>(n) * 0x9e3779b97f4a7c15u;  // splitmix64 of the number of the sample
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return n * every + static_cast<long>((z ^ (z >> 31)) % static_cast<std::uint64_t>(every));
  };
  const long every = steps_per_sample(steps, sites), n = steps / every;
  if (const long here = sample(n, every); here > steps) return here;
  const long start = (n + 1) * every, next = steps_per_sample(start, sites);
  return sample(start / next, next);
}

/// The largest force on a dislocation in the initial train at rest: dJ/dx (docs/theory/6_contact.md) plus F.
double driving_force(const ScaledProblem& s, double end) {
  constexpr int samples = 2000;
  const double dx = (s.right - s.left) / samples;
  double last = 0, by_stress = 0, by_forcing = 0;
  for (int i = 0; i <= samples; ++i) {
    const double x = s.left + dx * i, a = s.contact ? s.contact(x) : 1, k = s.stress(x);
    const double J = a * train::averages(train::at_rest(k / a)).J;
    if (i > 0) by_stress = std::fmax(by_stress, std::fabs(J - last) / dx);
    last = J;
    if (s.forcing)
      for (const double share : {0.0, 0.5, 1.0})
        by_forcing = std::fmax(by_forcing, std::fabs(s.forcing(x, share * end)));
  }
  return by_stress + by_forcing;
}

/// A chain at one time, of which windows are parts of one. A snapshot asks for some hundred windows, and a long chain
/// would compute the same sites for each.
class SeenOnce final : public Sites {
 public:
  SeenOnce(const Sites& chain, double time) : Sites(chain.problem(), &chain.ranks()), chain_(chain), time_(time) {
    for (const auto column : Window::columns) (all_.*column).reserve(chain.problem().grid.sites);
    for_own_blocks(chain, 2, time, [&](const Window& w, std::size_t begin, std::size_t end) {
      for (const auto column : Window::columns) {
        const double* const of_block = (w.*column).data() + (begin - w.begin);
        (all_.*column).insert((all_.*column).end(), of_block, of_block + (end - begin));
      }
      for (std::size_t j = begin; j < end; ++j) all_.energy.push_back(energy_density(chain.problem(), w, j));
    });
  }

  static bool is_worth(const Sites& chain) {
    constexpr std::size_t few_sites = 131'072;  // some 20 MB
    return chain.ranks().size() == 1 && chain.problem().grid.sites <= few_sites;
  }

  double time() const override { return time_; }
  std::optional<double> constant_step() const override { return chain_.constant_step(); }
  void exchange() const override {}
  Window own_window(std::size_t begin, std::size_t end, double) const override {
    const auto part = [&](const std::vector<double>& all) {
      return std::vector<double>(all.data() + begin, all.data() + end);
    };
    Window window;
    window.begin = begin;
    for (const auto column : Window::columns) window.*column = part(all_.*column);
    return window;
  }
  const Window* known() const override { return &all_; }
  SpringEnergy spring_energy() const override { return chain_.spring_energy(); }
  double load() const override { return chain_.load(); }

 private:
  const Sites& chain_;
  double time_;
  Window all_;
};

}  // namespace

RunObserver::RunObserver(const ScaledProblem& scaled, const output::Schedule& schedule, const Chain& chain)
    : scaled_(scaled), schedule_(schedule), chain_(chain) {
  choose_windows();
  const double c = scaled_.scale;
  for (std::size_t i = 0; i + 1 < schedule_.x_edges.size(); ++i) {
    CellMeans means = means_of_cell(i);
    first_u_.push_back(average_displacement(chain_, means.slip, 0));
    if (SeenOnce::is_worth(chain_)) means_.push_back(std::move(means));
  }
  const Grid& grid = chain_.problem().grid;
  if (scaled_.left + window_ / 2 <= 0 && grid.x(grid.sites - 1) / scaled_.scale - window_ / 2 >= 0)
    first_u_at_origin_ = average_displacement(chain_, 0, c * window_, 0);
  else
    first_u_at_origin_ = none;
  const Totals t = totals(chain_);
  first_energy_ = t.energy();
  first_charge_ = t.charge;
  first_dislocations_ = t.dislocations;
  driving_force_ = driving_force(scaled_, schedule_.times.back());
  sample();
}

void RunObserver::choose_windows() {
  const double length = scaled_.right - scaled_.left;
  const Spacings spacings = spacings_of_trains(scaled_);
  densest_ = spacings.dense;
  const auto width = [&](double chosen) { return scaled_.window > 0 ? scaled_.window : std::min(chosen, length / 4); };
  window_ = width(spacings.dense);
  smooth_window_ = width(dislocations_in_window * spacings.dense);
  widest_window_ = width(dislocations_in_window * spacings.dilute);
}

double RunObserver::middle_of_cell(std::size_t i) const {
  return (schedule_.x_edges[i] + schedule_.x_edges[i + 1]) / 2;
}

double RunObserver::centre_of_cell(std::size_t i) const {
  const double half = width_of_cell(i) / 2 * (1 + 1e-9);  // so that the window does not leave the chain
  return std::clamp(middle_of_cell(i), scaled_.left + half, last_site() - half);
}

double RunObserver::width_of_cell(std::size_t i) const {
  const double cell = schedule_.x_edges[i + 1] - schedule_.x_edges[i];
  return std::min(std::max(cell, densest_), (last_site() - scaled_.left) * (1 - 1e-6));
}

/// The last site of a ring is a spacing before its end.
double RunObserver::last_site() const {
  const Grid& grid = chain_.problem().grid;
  return grid.x(grid.sites - 1) / scaled_.scale;
}

long RunObserver::steps_to_sample() const {
  if (!chain_.constant_step()) return 1;
  return sample_after(chain_.steps(), chain_.problem().grid.sites) - chain_.steps();
}

void RunObserver::sample() {
  if (!sees_origin()) return;
  const double time = chain_.time();
  slip_.add(time, average(chain_, 0, scaled_.scale * window_, time).velocity);
}

bool RunObserver::sees_origin() const { return !std::isnan(first_u_at_origin_); }

Snapshot RunObserver::snapshot(double time) const {
  Snapshot s{};
  s.time = time;
  std::optional<SeenOnce> seen;
  if (SeenOnce::is_worth(chain_)) seen.emplace(chain_, scaled_.scale * time);
  const Sites& sites = seen ? static_cast<const Sites&>(*seen) : chain_;
  const std::vector<double> velocities = add_profile(sites, s, time);
  add_origin(sites, s, time);
  const Totals& now = totals_now();
  if (static_cast<double>(now.dislocations) >
      most_dislocations_a_site * static_cast<double>(chain_.problem().grid.sites))
    throw NumericsError("The chain diverged: more than " + digits(most_dislocations_a_site) +
                        " dislocations per site at t = " + digits(time));
  find_fronts(s, now, velocities);
  if (!chain_.problem().substrate) s.energy.phonons = none;  // no trains to compare with
  add_energy(s, now);
  add_sites(s, time);
  output::complete(s, schedule_);
  return s;
}

RunObserver::CellMeans RunObserver::means_of_cell(std::size_t i) const {
  const Grid& grid = chain_.problem().grid;
  const double c = scaled_.scale;
  return {weights_of_mean(grid, c * centre_of_cell(i), c * width_of_cell(i)),
          weights_of_smooth_mean(grid, c * middle_of_cell(i), c * least_width(i))};
}

double RunObserver::least_width(std::size_t i) const {
  return std::max(2 * (schedule_.x_edges[i + 1] - schedule_.x_edges[i]), smooth_window_);
}

/// Adds averages over the output cells, their peak, and the energy of phonons.
std::vector<double> RunObserver::add_profile(const Sites& sites, Snapshot& s, double time) const {
  const double c = scaled_.scale;
  std::vector<double> velocities;
  std::size_t peak = 0;
  for (std::size_t i = 0; i < first_u_.size(); ++i) {
    const CellMeans found = means_.empty() ? means_of_cell(i) : CellMeans{};
    const CellMeans& means = means_.empty() ? found : means_[i];
    const double u = average_displacement(sites, means.slip, c * time);
    const double cell = schedule_.x_edges[i + 1] - schedule_.x_edges[i], middle = middle_of_cell(i);
    const double least = least_width(i);
    BestAverage best{smooth_average(sites, means.smooth, c * time), c * least, none, none};
    velocities.push_back(best.average.velocity);
    if (widest_window_ > least) best = best_average(sites, c * middle, c * least, c * widest_window_, c * time);
    const SmoothAverage& a = best.average;
    const double wide = best.width / c;
    s.profile.k.push_back(a.stress);
    s.profile.W.push_back(a.velocity);
    // If waves or antidislocations move as well, W / k is not the velocity U of any dislocation.
    const bool of_one_sign = std::fabs(a.velocity) < a.stress;
    s.profile.U.push_back(a.stress < train::smallest_stress ? 0 : of_one_sign ? a.velocity / a.stress : none);
    s.profile.H.push_back(a.energy);
    s.profile.slip.push_back((u - first_u_[i]) / c);
    // A window that an end cuts does not give the average of a uniform train.
    const bool whole = middle - wide / 2 >= scaled_.left && middle + wide / 2 <= scaled_.right;
    const double contact = contact_at(middle);
    if (whole) s.energy.phonons += cell * (a.energy - energy_of_train(a.stress, a.velocity, contact));
    if (std::fabs(a.velocity) > std::fabs(s.profile.W[peak])) peak = i;
  }
  s.peak_slip_velocity = s.profile.W[peak];
  s.peak_position = middle_of_cell(peak);
  return velocities;
}

BestAverage RunObserver::average_at_origin(const Sites& sites, double time) const {
  const double c = scaled_.scale;
  return best_average(sites, 0, c * smooth_window_, c * widest_window_, c * time);
}

/// Adds the errors that windows at one moment do not show. Dislocations pass x = 0 one by one, and where the stress
/// changes from one to the next, the slip is wrong by a part of one. The velocity and the stress are wrong by as much
/// as that is of those that have passed. In 81 steps against the exact theory, at scales from 200 to 6000, these limits
/// cover all errors. Without them, 14 errors of the velocity and 9 of the stress were larger.
void RunObserver::widen_errors(Averages& averages, double time) const {
  const double apart = std::min(densest_, scaled_.right - scaled_.left) / 2;
  const double k_left = scaled_.stress(std::fmax(-apart, scaled_.left)),
               k_right = scaled_.stress(std::fmin(apart, scaled_.right)), most = std::fmax(k_left, k_right);
  if (scaled_.loading.acts() || !scaled_.substrate || !(most > 0) || !(time > 0)) return;
  const double c = scaled_.scale, one = 2 * std::numbers::pi / c, change = std::fabs(k_left - k_right);
  const double slip = (average_displacement(chain_, 0, c * window_, c * time) - first_u_at_origin_) / c;
  averages.velocity_error = std::fmax(averages.velocity_error, 0.55 * change / most * one / time);
  averages.stress_error = std::fmax(averages.stress_error, change * std::fmin(0.25 * one / std::fabs(slip), 2.0));
}

Averages RunObserver::averages(double time, double peak) const {
  Averages averages{.width = smooth_window_, .velocity_error = none, .stress_error = none, .peak_error = none};
  if (sees_origin()) {
    const BestAverage origin = average_at_origin(chain_, time);
    averages = {origin.width / scaled_.scale, origin.velocity_error, origin.stress_error, none};
    widen_errors(averages, time);
  }
  const double c = scaled_.scale;
  for (std::size_t i = 0; i + 1 < schedule_.x_edges.size(); ++i)
    if (middle_of_cell(i) == peak)
      averages.peak_error =
          best_average(chain_, c * peak, c * least_width(i), c * widest_window_, c * time).velocity_error;
  return averages;
}

void RunObserver::add_origin(const Sites& sites, Snapshot& s, double time) const {
  s.slip_velocity_at_origin = s.stress_at_origin = s.slip_at_origin = none;
  if (!sees_origin()) return;
  const double c = scaled_.scale;
  const SmoothAverage origin = average_at_origin(sites, time).average;
  s.slip_velocity_at_origin = origin.velocity;
  s.stress_at_origin = origin.stress;
  s.slip_at_origin = (average_displacement(sites, 0, c * window_, c * time) - first_u_at_origin_) / c;
}

void RunObserver::add_energy(Snapshot& s, const Totals& now) const {
  const double c = scaled_.scale;
  const Flows flows = chain_.flows();
  s.energy = {.elastic = (now.elastic + now.substrate) / c,
              .kinetic = now.kinetic / c,
              .dissipated = (flows.dissipated + flows.outflow) / c,
              .supplied = flows.supplied / c,
              .through_ends = none,
              .shocks = none,
              .residual = none,
              .phonons = s.energy.phonons};
  if (scaled_.loading.acts()) {
    const bool everywhere = scaled_.loading.where == Pulled::everywhere;
    s.energy.loading = now.loading / c;
    const double stress = scaled_.loading.where == Pulled::right ? -chain_.load() : chain_.load();  // -u_x at the end
    (everywhere ? s.loading_force : s.loading_stress) = everywhere ? c * chain_.load() : stress;
  }
  if (!chain_.problem().friction.changes_contacts()) return;
  s.energy.contacts = flows.by_contacts / c;
  s.pore_pressure_at_origin = pore_pressure_at_origin();
}

/// Adds u at the sites and the dislocations, if they are wanted.
void RunObserver::add_sites(Snapshot& s, double time) const {
  const double c = scaled_.scale;
  if (schedule_.displacement) s.displacement = displacements(chain_, c * time);
  if (schedule_.dislocations) s.dislocations = chain::dislocations(chain_, c * time);
  for (double& u : s.displacement) u /= c;
  for (Dislocation& d : s.dislocations) d.x /= c;
  output::sort(s.dislocations);
}

/// (all) The totals of the present step, which a snapshot and the checks of a run both need.
const Totals& RunObserver::totals_now() const {
  if (!totals_ || totals_->time != chain_.time()) totals_ = totals(chain_);
  return *totals_;
}

/// Finds fronts in the profile, and the leading front also from the outermost dislocation if one side is empty.
void RunObserver::find_fronts(Snapshot& s, const Totals& now, const std::vector<double>& velocities) const {
  s.fronts = {none, none, none, none, none};
  const double stress_left = scaled_.stress(scaled_.left), stress_right = scaled_.stress(scaled_.right);
  const bool stressed_left = stress_left >= stress_right;
  if (std::fmin(stress_left, stress_right) == 0) {
    if (const std::optional<std::size_t> site = stressed_left ? now.last_site : now.first_site) {
      const std::vector<Dislocation> found = dislocations_after(chain_, *site, chain_.time());
      s.fronts.leading = (stressed_left ? found.back() : found.front()).x / scaled_.scale;
    }
  }
  // We seek no front where an end cuts the window, because such an average contains phonons that a whole window would
  // average out.
  const double half = std::min(smooth_window_ / 2, (scaled_.right - scaled_.left) / 4);
  std::vector<double> x, speed;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    x.push_back(middle_of_cell(i));
    const bool cut = x[i] - half < scaled_.left || x[i] + half > scaled_.right;
    speed.push_back(cut ? 0 : std::fabs(velocities[i]));
  }
  const output::Observed seen =
      output::observed_fronts(x, speed, schedule_.threshold * std::fabs(s.peak_slip_velocity), x.front(), x.back());
  s.fronts.trailing_observed = stressed_left ? seen.left : seen.right;
  s.fronts.leading_observed = stressed_left ? seen.right : seen.left;
}

/// The present a at position x of the scenario.
double RunObserver::contact_at(double x) const {
  const Grid& grid = chain_.problem().grid;
  if (!chain_.problem().friction.changes_contacts()) return scaled_.contact ? scaled_.contact(x) : 1.0;
  const double site =
      std::clamp((x * scaled_.scale - grid.left) / grid.spacing, 0.0, static_cast<double>(grid.sites - 1));
  const auto nearest = static_cast<std::size_t>(std::lround(site));
  return std::sqrt(chain_.window(nearest, nearest + 1).contact_squared[0]);
}

/// The mean pore pressure p over the window that averages the slip at x = 0.
double RunObserver::pore_pressure_at_origin() const {
  if (!sees_origin()) return none;
  const Grid& grid = chain_.problem().grid;
  const double half = scaled_.scale * window_ / 2;
  const auto from = static_cast<std::size_t>(std::ceil((-half - grid.left) / grid.spacing));
  std::size_t to = from + 1;
  while (to < grid.sites && grid.x(to) <= half) ++to;
  double sum = 0;
  for (const double share : chain_.window(from, to).effective_stress) sum += share;
  return 1 - sum / static_cast<double>(to - from);
}

Balance RunObserver::balance() const {
  const Totals& now = totals_now();
  const Flows flows = chain_.flows();
  const double gone = flows.dissipated + flows.outflow;
  const double all =
      std::max({first_energy_, now.energy(), std::fabs(flows.supplied), std::fabs(gone), std::fabs(flows.by_contacts)});
  const double missing = now.energy() + gone - flows.supplied - flows.by_contacts - first_energy_;
  return {all > 0 ? std::fabs(missing) / all : 0, now.charge - first_charge_, now.dislocations, now.steepest};
}

RunObserver::OriginSlip RunObserver::origin_slip() const {
  const Average now = average(chain_, 0, scaled_.scale * window_, chain_.time());
  return {now.u - first_u_at_origin_, slip_.up_to(chain_.time(), now.velocity), slip_.error(), slip_.samples};
}

}  // namespace slipfront::chain
