#include "slipfront/chain/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "chain/explicit/contact_field.hpp"
#include "foundation/bytes.hpp"
#include "foundation/ranks.hpp"
#include "foundation/text/digits.hpp"
#include "output/further_scalars.hpp"
#include "slipfront/chain/smooth.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::chain {
namespace {

using output::Snapshot;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t format = 0x636861696e000006;  // "chain", version 6

/// In the window of velocities and stresses (smooth_average): their ripple is some 0.1 % then.
constexpr double dislocations_in_window = 8;

/// The train's spacing just left of x = 0, or anywhere if it is empty there.
double spacing_of_train(const ScaledProblem& s) {
  for (const double x : {-1e-9 * (s.right - s.left), s.left, s.right})
    if (const double k = s.stress(x); k > 0) return 2 * std::numbers::pi / k / s.scale;
  return (s.right - s.left) / 16;
}

/// Whether the forcing is too weak to make pairs of dislocations and antidislocations: for that it has to lift u out of
/// a well, |F| >= 1 in the chain's units.
bool weak_forcing(const ScaledProblem& s) {
  constexpr int places = 256, times = 16;
  if (!(s.end > 0)) return false;
  double most = 0;
  for (int i = 0; i <= places; ++i)
    for (int k = 0; k <= times; ++k)
      most = std::fmax(most, std::fabs(s.forcing(s.left + (s.right - s.left) * i / places, s.end * k / times)));
  return most < 0.1 * s.scale;
}

/// Antidislocations come in at free ends and are made by a strong force; a slope of a(x) drives one stream through
/// another.
double crossing_stress(const ScaledProblem& s) {
  const bool free = !s.boundary.periodic && (s.boundary.left != End::fixed || s.boundary.right != End::fixed);
  if (!free && !s.contact && (!s.forcing || weak_forcing(s))) return 0;
  constexpr int samples = 4096;
  double most = 0;
  for (int i = 0; i <= samples; ++i) most = std::fmax(most, s.stress(s.left + (s.right - s.left) * i / samples));
  return most;
}

[[noreturn]] void refuse_saved() {
  throw InputError({.key = "resume",
                    .problem = "the saved state is of another version or scenario",
                    .allowed = "a file of this version and scenario, written by slipfront chain"});
}

/// The first level behind `level` at which rates are sampled: one somewhere in each `every` levels. A train passes x =
/// 0 with a period of its own, and regular samples, of any pattern, can see the same phase of it again and again.
long sample_after(long level, long every) {
  const auto sample = [every](long n) {
    std::uint64_t z = static_cast<std::uint64_t>(n) * 0x9e3779b97f4a7c15u;  // splitmix64, of the number of the sample
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return n * every + static_cast<long>((z ^ (z >> 31)) % static_cast<std::uint64_t>(every));
  };
  const long n = level / every;
  return sample(n) > level ? sample(n) : sample(n + 1);
}

/// Dislocations are wider than that; what has more has blown up.
constexpr double most_dislocations_a_site = 8;

}  // namespace

Problem problem_of(const ScaledProblem& s, double share_of_machine) {
  if (!(s.scale > 0) || !std::isfinite(s.scale))
    throw InputError({.key = "chain.scale", .value = digits(s.scale), .problem = "out of range", .allowed = "> 0"});
  const double length = s.scale * (s.right - s.left);
  Problem p;
  // A ring has one site less than ends: the last is the first again.
  const double intervals = std::ceil(length / s.spacing - 1e-9);
  if (!(intervals >= 1 && intervals < 1e15))
    throw InputError({.key = "chain.spacing",
                      .value = digits(s.spacing),
                      .problem = "does not divide a chain of length " + digits(length),
                      .allowed = "> 0, for 1 to 1e15 sites"});
  p.grid.left = s.scale * s.left;
  p.grid.sites = static_cast<std::size_t>(intervals) + (s.boundary.periodic ? 0 : 1);
  p.grid.spacing = s.boundary.periodic ? length / intervals : s.spacing;
  p.model = s.model;
  p.boundary = s.boundary;
  p.friction = s.friction.scaled_by(s.scale);
  if (s.forcing) p.forcing = [f = s.forcing, c = s.scale](double x, double t) { return f(x / c, t / c) / c; };
  p.steady_forcing = s.steady_forcing;
  if (s.contact) p.contact = [a = s.contact, c = s.scale](double x) { return a(x / c); };
  p.crossing_stress = crossing_stress(s);
  p.step = s.step;
  p.loading = s.loading;
  p.loading.stiffness /= s.loading.where == Pulled::everywhere ? s.scale * s.scale : s.scale;
  p.substrate = s.substrate;
  p.implicit = s.implicit || s.loading.acts();
  p.tolerance = s.tolerance;
  p.longest = s.scale * s.end;
  p.boundary.left_stress = s.stress(s.left);
  p.boundary.right_stress = s.stress(s.right);
  check(p, share_of_machine);
  return p;
}

Run::Start Run::start(const ScaledProblem& s, double share_of_machine) {
  Problem problem = problem_of(s, share_of_machine);
  StaticTrain train([s](double x) { return s.stress(std::clamp(x / s.scale, s.left, s.right)); }, problem.grid,
                    s.boundary.periodic, problem.contact);
  if (s.boundary.periodic) {  // as many dislocations as the stress asks for
    const std::size_t n = problem.grid.sites;
    const double once_around = train(0, 1).u[0] - train(n - 1, n).u[0];
    const double share = static_cast<double>(n) / std::max<double>(1, static_cast<double>(n) - 1);
    problem.boundary.charge = std::lround(once_around * share / (2 * std::numbers::pi));
  }
  return {std::move(problem), std::move(train)};
}

/// All ranks throw the same error together.
Run::Start Run::start(const ScaledProblem& scaled, const Execution& execution) {
  if (!execution.ranks) return start(scaled, 1.0);
  std::optional<Start> made;
  execution.ranks->together([&] { made = start(scaled, execution.ranks->share_of_machine()); });
  return *std::move(made);
}

Run::Run(ScaledProblem scaled, output::Schedule schedule, const Execution& execution, const Start& start)
    : scaled_(std::move(scaled)),
      schedule_(std::move(schedule)),
      chain_(
          start.problem, [&](std::size_t begin, std::size_t end) { return start.train(begin, end); }, execution) {
  look_at_start();
}

Run::Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution)
    : Run(scaled, std::move(schedule), execution, start(scaled, execution)) {}

double Run::middle_of_cell(std::size_t i) const { return (schedule_.x_edges[i] + schedule_.x_edges[i + 1]) / 2; }

double Run::centre_of_cell(std::size_t i) const {
  const double half = width_of_cell(i) / 2 * (1 + 1e-9);  // the window stays on the chain
  const double centre = middle_of_cell(i);
  const Grid& grid = chain_.problem().grid;  // a ring's last site is a spacing before its end
  return std::clamp(centre, scaled_.left + half, grid.x(grid.sites - 1) / scaled_.scale - half);
}

double Run::width_of_cell(std::size_t i) const {
  const double cell = schedule_.x_edges[i + 1] - schedule_.x_edges[i];
  return std::min(std::max(cell, spacing_of_train(scaled_)), (scaled_.right - scaled_.left) * (1 - 1e-6));
}

void Run::look_at_start() {
  const double length = scaled_.right - scaled_.left;
  window_ = scaled_.window > 0 ? scaled_.window : std::min(spacing_of_train(scaled_), length / 4);
  smooth_window_ =
      scaled_.window > 0 ? scaled_.window : std::min(dislocations_in_window * spacing_of_train(scaled_), length / 4);
  const double levels = schedule_.times.back() * scaled_.scale / chain_.dt();
  work_every_ = std::max(32L, 32 * std::lround(levels / 200 / 32));
  // The slip velocity at x = 0 of so few sites can be followed even where one dislocation passes.
  if (chain_.problem().grid.sites < 5000) work_every_ = std::clamp(work_every_ / 16, 2L, 32L);
  const double c = scaled_.scale;
  for (std::size_t i = 0; i + 1 < schedule_.x_edges.size(); ++i)
    first_u_.push_back(average(chain_, c * centre_of_cell(i), c * width_of_cell(i), 0).u);
  const Grid& grid = chain_.problem().grid;
  if (scaled_.left + window_ / 2 <= 0 && grid.x(grid.sites - 1) / scaled_.scale - window_ / 2 >= 0)
    first_u_at_origin_ = average(chain_, 0, c * window_, 0).u;
  else
    first_u_at_origin_ = none;
  const Totals t = totals(chain_);
  first_energy_ = t.energy();
  first_charge_ = t.charge;
  first_dislocations_ = t.dislocations;
  driving_force_ = driving_force();
  sample();
}

/// Rates that are integrated over time. Where nothing takes energy but what the chain meters there is no need of them.
void Run::sample() {
  if (chain_.problem().friction.acts() && !chain_.meters_friction()) work_.sample(totals(chain_));
  if (std::isnan(first_u_at_origin_)) return;
  const double time = chain_.time(), velocity = average(chain_, 0, scaled_.scale * window_, time).velocity;
  slip_.add(time, velocity);
}

Run::Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution, std::string_view saved,
         std::vector<Snapshot> snapshots)
    : Run(scaled, std::move(schedule), execution) {
  bytes::Reader reader(saved);
  if (reader.get<std::uint64_t>() != format || snapshots.size() > schedule_.times.size()) refuse_saved();
  for (double* value : {&work_.supplied, &work_.dissipated, &work_.time, &work_.supplied_rate, &work_.dissipated_rate,
                        &slip_.time, &slip_.velocity, &slip_.integral, &slip_.early_time, &slip_.early_velocity,
                        &slip_.coarse_integral, &slip_.spread})
    *value = reader.get<double>();
  slip_.samples = static_cast<long>(reader.get<std::int64_t>()) - 1;
  if (chain_.implicit()) {
    chain_.continue_implicit(reader.vector());
    reader.end();
    snapshots_ = std::move(snapshots);
    return;
  }
  const std::vector<double> flows = reader.vector();
  Levels levels;
  levels.level = static_cast<long>(reader.get<std::int64_t>());
  levels.now = reader.vector();
  levels.before = reader.vector();
  const std::vector<std::string_view> variables = remembered(chain_.problem());
  levels.memory.resize(variables.size() * levels.now.size());
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const bool known = reader.text() == variables[v];
    const std::vector<double> values = reader.vector();
    if (!known || values.size() != levels.now.size()) refuse_saved();
    for (std::size_t j = 0; j < values.size(); ++j) levels.memory[variables.size() * j + v] = values[j];
  }
  reader.end();
  const double last = schedule_.times.back() * scaled_.scale / chain_.dt();
  if (!(levels.level >= 0 && static_cast<double>(levels.level) < last + 1))
    throw InputError({.key = "resume",
                      .value = std::to_string(levels.level) + " steps",
                      .problem = "beyond the end of the run",
                      .allowed = "a file that slipfront chain wrote for this scenario"});
  chain_ = Chain(chain_.problem(), levels, execution);
  chain_.continue_flows(flows);
  snapshots_ = std::move(snapshots);
}

std::string Run::saved() const {
  bytes::Writer writer;
  writer.put(format);
  for (const double value :
       {work_.supplied, work_.dissipated, work_.time, work_.supplied_rate, work_.dissipated_rate, slip_.time,
        slip_.velocity, slip_.integral, slip_.early_time, slip_.early_velocity, slip_.coarse_integral, slip_.spread})
    writer.put(value);
  writer.put(static_cast<std::int64_t>(slip_.samples + 1));
  if (chain_.implicit()) {
    writer.put(chain_.implicit_state());
    return std::move(writer).text();
  }
  writer.put(chain_.flow_sums());
  const Levels levels = chain_.levels();
  writer.put(static_cast<std::int64_t>(levels.level));
  writer.put(levels.now);
  writer.put(levels.before);
  const std::vector<std::string_view> variables = remembered(chain_.problem());
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::vector<double> values;
    for (std::size_t j = v; j < levels.memory.size(); j += variables.size()) values.push_back(levels.memory[j]);
    writer.put_text(variables[v]);
    writer.put(values);
  }
  return std::move(writer).text();
}

bool Run::advance(const std::function<bool()>& interrupted) {
  // Work for a tenth of a second or so; where a run stops in between changes no bits.
  const auto sites = static_cast<double>(chain_.problem().grid.sites);
  const long most = 32 * std::max(1L, std::lround(2e8 / 32 / sites));
  const auto target = std::lround(schedule_.times[snapshots_.size()] * scaled_.scale / chain_.dt());
  while (chain_.level() < target) {
    const long level = chain_.level(), next = sample_after(level, work_every_);
    can_checkpoint_ = false;
    chain_.advance(std::min({target, next, level + most}) - level);
    can_checkpoint_ = true;
    if (chain_.level() == next) sample();
    if (interrupted && interrupted()) return false;
  }
  return true;
}

bool Run::go(const std::function<bool()>& interrupted) {
  while (!finished()) {
    if (!(chain_.implicit() ? proceed(interrupted) : advance(interrupted))) return false;
    take();
    if (!finished()) refuse(findings());
  }
  final_findings_ = findings();
  refuse(*final_findings_);
  return true;
}

/// Averages over the output cells, their peak, and the energy of phonons.
Snapshot Run::profile_at(double time) const {
  const double c = scaled_.scale;
  Snapshot s{};
  s.time = time;
  std::size_t peak = 0;
  for (std::size_t i = 0; i < first_u_.size(); ++i) {
    const double u = average(chain_, c * centre_of_cell(i), c * width_of_cell(i), c * time).u;
    const double cell = schedule_.x_edges[i + 1] - schedule_.x_edges[i], middle = middle_of_cell(i);
    const double wide = std::max(2 * cell, smooth_window_);
    const SmoothAverage a = smooth_average(chain_, c * middle, c * wide, c * time);
    s.profile.k.push_back(a.stress);
    s.profile.W.push_back(a.velocity);
    // Where others than dislocations of one sign move, waves or antidislocations too, U is none of theirs.
    const bool of_one_sign = std::fabs(a.velocity) < a.stress;
    s.profile.U.push_back(a.stress < train::smallest_stress ? 0 : of_one_sign ? a.velocity / a.stress : none);
    s.profile.H.push_back(a.energy);
    s.profile.slip.push_back((u - first_u_[i]) / c);
    // At an end the window is cut: what it makes even there is no phonons.
    const bool whole = middle - wide / 2 >= scaled_.left && middle + wide / 2 <= scaled_.right;
    const double contact = contact_at(middle);
    if (whole) s.energy.phonons += cell * (a.energy - energy_of_train(a.stress, a.velocity, contact));
    if (std::fabs(a.velocity) > std::fabs(s.profile.W[peak])) peak = i;
  }
  s.peak_slip_velocity = s.profile.W[peak];
  s.peak_position = middle_of_cell(peak);
  return s;
}

/// From the profile, which stands, and from the outermost dislocation where one side is empty.
void Run::find_fronts(Snapshot& s) const {
  s.fronts = {none, none, none, none, none};
  const double stress_left = scaled_.stress(scaled_.left), stress_right = scaled_.stress(scaled_.right);
  const bool stressed_left = stress_left >= stress_right;
  if (std::fmin(stress_left, stress_right) == 0) {
    const auto all = chain::dislocations(chain_);
    if (!all.empty()) s.fronts.leading = (stressed_left ? all.back() : all.front()).x / scaled_.scale;
  }
  // At an end the window is cut, and phonons show that a whole one averages away: no front is seen there.
  const double half = std::min(smooth_window_ / 2, (scaled_.right - scaled_.left) / 4);
  std::vector<double> x, speed;
  for (std::size_t i = 0; i < s.profile.W.size(); ++i) {
    x.push_back(middle_of_cell(i));
    const bool cut = x[i] - half < scaled_.left || x[i] + half > scaled_.right;
    speed.push_back(cut ? 0 : std::fabs(s.profile.W[i]));
  }
  const output::Observed seen =
      output::observed_fronts(x, speed, schedule_.threshold * std::fabs(s.peak_slip_velocity), x.front(), x.back());
  s.fronts.trailing_observed = stressed_left ? seen.left : seen.right;
  s.fronts.leading_observed = stressed_left ? seen.right : seen.left;
}

void Run::take() {
  const double time = schedule_.times[snapshots_.size()], c = scaled_.scale;
  Snapshot s = profile_at(time);
  s.slip_velocity_at_origin = s.stress_at_origin = s.slip_at_origin = none;
  if (!std::isnan(first_u_at_origin_)) {
    const SmoothAverage origin = smooth_average(chain_, 0, c * smooth_window_, c * time);
    s.slip_velocity_at_origin = origin.velocity;
    s.stress_at_origin = origin.stress;
    s.slip_at_origin = (average(chain_, 0, c * window_, c * time).u - first_u_at_origin_) / c;
  }
  const Totals now = totals(chain_);
  if (static_cast<double>(now.dislocations) >
      most_dislocations_a_site * static_cast<double>(chain_.problem().grid.sites))
    throw NumericsError("The chain diverged: more than " + digits(most_dislocations_a_site) +
                        " dislocations per site at t = " + digits(time));
  find_fronts(s);
  const Chain::Flows flows = chain_.flows();
  Work work = work_;
  if (work.started) work.sample(now);
  s.energy = {.elastic = (now.elastic + now.substrate) / c,
              .kinetic = now.kinetic / c,
              .dissipated = (work.dissipated + flows.dissipated + flows.outflow) / c,
              .supplied = flows.supplied / c,
              .through_ends = none,
              .shocks = none,
              .phonons = s.energy.phonons};
  if (scaled_.loading.acts()) s.further["energy_loading"] = now.loading / c;
  if (chain_.problem().friction.contacts().act()) {
    s.further["energy_contacts"] = flows.by_contacts / c;
    s.further["pore_pressure_at_origin"] = pore_pressure_at_origin();
  }
  output::add_further_scalars(s, schedule_);
  snapshots_.push_back(std::move(s));
}

}  // namespace slipfront::chain
