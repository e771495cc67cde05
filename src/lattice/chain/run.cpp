#include "slipfront/lattice/chain/run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lattice/chain/events/event_log.hpp"
#include "lattice/chain/run_checks.hpp"
#include "lattice/chain/run_observer.hpp"
#include "lattice/chain/scaled_start.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/archive.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {
namespace {

using output::Snapshot;

std::unique_ptr<Chain> chain_of(const ScaledProblem& scaled, const Execution& execution) {
  const ScaledStart start = scaled_start(scaled, execution);
  return make_chain(start.problem, std::cref(start.train), execution);
}

}  // namespace

Run::Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution)
    : scale_(scaled.scale),
      schedule_(std::move(schedule)),
      chain_(chain_of(scaled, execution)),
      observer_(std::make_unique<RunObserver>(scaled, schedule_, *chain_)),
      outputs_(std::make_unique<EventOutputs>(schedule_.per_event)) {}

Run::Run(const ScaledProblem& scaled, output::Schedule schedule, const Execution& execution, std::string_view saved,
         std::vector<Snapshot> snapshots)
    : Run(scaled, std::move(schedule), execution) {
  outputs_->set_all(std::move(snapshots));
  restore(*this, saved);
}

Run::~Run() = default;

void Run::archive(Archive& a) {
  a.same(std::string("chain"));
  a(*observer_, *outputs_, *chain_);
  const auto dt = chain_->constant_step();
  a.require(outputs_->scheduled() <= schedule_.times.size());
  a.require(!dt || static_cast<double>(chain_->steps()) < schedule_.times.back() * scale_ / *dt + 1);
}

const std::vector<Snapshot>& Run::snapshots() const { return outputs_->all(); }
bool Run::finished() const { return outputs_->scheduled() == schedule_.times.size(); }
double Run::window() const { return observer_->window(); }
std::vector<double> Run::sites() const {
  const Grid& grid = chain_->problem().grid;
  std::vector<double> x(grid.sites);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = grid.x(j) / scale_;
  return x;
}

output::PathSettings Run::path_settings() const {
  // A dislocation and an antidislocation that meet are invisible for up to 2 widths over c, if they are slow.
  constexpr double widths = 4;
  const Problem& problem = chain_->problem();
  const double length = static_cast<double>(problem.grid.sites) * problem.grid.spacing;
  return {.ring_length = problem.boundary.periodic ? length / scale_ : 0, .meeting_time = widths / scale_};
}

Balance Run::balance() const { return observer_->balance(); }

Averages Run::averages() const {
  const Snapshot& last = snapshots().back();
  return observer_->averages(last.time, last.peak_position);
}

bool Run::advance_to(double time, const std::function<bool()>& interrupted) {
  // Work for a tenth of a second or so, at first for less. The steps at which a run stops change no bits.
  const auto sites = static_cast<double>(chain_->problem().grid.sites);
  const long longest = 32 * std::max(1L, std::lround(2e8 / 32 / sites));
  for (long most = std::clamp(std::lround(1e7 / sites), 1L, 32L); !chain_->reached(time);
       most = std::min(2 * most, longest)) {
    const long before = chain_->steps(), to_sample = observer_->steps_to_sample();
    chain_->advance_to(time, std::min(to_sample, most));
    // Without a constant step each step is a sample. The motion inside a step is none: samples must not depend on the
    // output times, so that a run to a later end can continue this one.
    if (chain_->constant_step() ? chain_->steps() - before == to_sample : chain_->between_steps()) {
      observer_->sample();
      bool wanted = false;
      chain_->ranks().together([&] { wanted = outputs_->wants(chain_->event_in_progress()); });
      if (wanted) outputs_->add(observer_->snapshot(this->time()));
    }
    if (interrupted && interrupted()) return false;
  }
  return true;
}

bool Run::go(const std::function<bool()>& interrupted) {
  const RunChecks checks(*observer_, snapshots());
  while (!finished()) {
    const double time = schedule_.times[outputs_->scheduled()];
    if (!advance_to(time * scale_, interrupted)) return false;
    Snapshot snapshot = observer_->snapshot(time);
    chain_->ranks().together([&] { outputs_->add_scheduled(std::move(snapshot)); });
    if (!finished()) refuse_wrong(checks.findings());
  }
  final_findings_ = checks.findings();
  refuse_wrong(*final_findings_);
  return true;
}

std::vector<output::SlipEvent> Run::events() const {
  std::vector<output::SlipEvent> events = chain_->events();
  for (output::SlipEvent& e : events) {
    for (double* number : {&e.onset, &e.duration, &e.slip, &e.largest_slip, &e.origin, &e.length}) *number /= scale_;
    if (chain_->problem().loading.where == Pulled::everywhere)
      for (double* force : {&e.load, &e.stress_drop}) *force *= scale_;
  }
  return events;
}

output::FrontRecords Run::fronts() const {
  output::FrontRecords fronts = chain_->fronts();
  for (double& x : fronts.x) x /= scale_;
  for (output::FrontRecord& event : fronts.events) {
    for (double& time : event.arrival) time /= scale_;
    for (double& force : event.traction) force *= scale_;
  }
  return fronts;
}

std::vector<std::string> Run::warnings() const {
  return (final_findings_ ? *final_findings_ : RunChecks(*observer_, snapshots()).findings()).sentences;
}

void Run::refuse_wrong(const output::Findings& found) const {
  if (found.wrong_results()) throw NumericsError("t = " + digits(time()) + ": " + found.worst);
}

namespace {

using output::EventSeries;
using output::Value;

const Grid& grid_of(const Report& e) { return e.run.chain().problem().grid; }

double site_updates_per_second(const Report& e) {
  const double updates = static_cast<double>(grid_of(e).sites) * static_cast<double>(e.spent.steps);
  return e.spent.stepping > 0 ? updates / e.spent.stepping : 0;
}

bool is_loaded(const Report& e) { return e.run.chain().problem().loading.acts(); }

constexpr std::string_view few_events = "there are fewer than two slip events", no_event = "no slip event is complete";

constexpr output::Quantity<Report> of_run[] = {
    {output::scale_factor, [](const Report& e) -> Value { return e.run.scale(); }},
    {output::slip_window, [](const Report& e) -> Value { return e.run.window(); }},
    {output::velocity_window, [](const Report& e) -> Value { return e.averages.width; }},
    {{"event_count", "number of slip events", "", "Eq. 1", "no springs load the chain"},
     [](const Report& e) -> Value {
       return is_loaded(e) ? static_cast<double>(output::series_of(e.run.events()).count) : none;
     }},
    {{"event_recurrence_time", "median time between onsets of slip events", "b / (c A)", "Eq. 1", few_events},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).recurrence_time; }},
    {{"event_median_stress_drop", "median stress drop of slip events", "", "Eq. 1", no_event},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).stress_drop; },
     output::Kind::result,
     [](const Report& e) { return output::unit_of_load(e.run.chain().problem().loading.where != Pulled::everywhere); }},
    {{"event_median_peak_velocity", "median peak velocity of slip events", "c A / pi", "Eq. 1", no_event},
     [](const Report& e) -> Value { return output::series_of(e.run.events()).peak_velocity; }},
    {{"dislocations", "number of dislocations at the end", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.dislocations; }},
    {{"energy_drift", "relative error of the balance of energy and work since t = 0", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.energy_drift; }},
    {{"charge_error", "dislocations that left through the ends; 0 if these are fixed or periodic", "", "Eq. 1"},
     [](const Report& e) -> Value { return e.balance.charge_error; }},
    {{"sites", "number of sites", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(grid_of(e).sites); }},
    {{"spacing", "spacing of the sites, in the chain's own x", "", ""},
     [](const Report& e) -> Value { return grid_of(e).spacing; }},
    {output::step_count, [](const Report& e) -> Value { return e.run.chain().steps(); }},
    {{"ranks", "number of processes", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.spent.ranks); },
     output::Kind::of_machine},
    {{"threads", "threads of each rank", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.spent.threads); },
     output::Kind::of_machine},
    {{"site_updates_per_second", "site updates per second, including output", "", ""},
     [](const Report& e) -> Value { return site_updates_per_second(e); },
     output::Kind::of_machine},
    {output::wall_time, [](const Report& e) -> Value { return e.spent.wall; }, output::Kind::of_machine},
};

}  // namespace

std::span<const output::Quantity<Report>> quantities() { return of_run; }

}  // namespace slipfront::chain
