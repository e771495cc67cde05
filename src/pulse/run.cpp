#include "slipfront/pulse/run.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "foundation/archive.hpp"
#include "foundation/clock.hpp"
#include "foundation/step_budget.hpp"
#include "foundation/text/digits.hpp"
#include "pulse/contours/many_trains.hpp"
#include "pulse/motion.hpp"
#include "pulse/one_train.hpp"
#include "slipfront/error.hpp"
#include "slipfront/output/quantities.hpp"

namespace slipfront::pulse {
namespace {

/// Expected number of steps. Each output time adds two, because a step must end on it and the step before is shortened.
double expected_steps(const Motion& start, const output::Schedule& schedule) {
  return start.expected_steps(schedule.times.back()) + 2 * static_cast<double>(schedule.times.size());
}

std::unique_ptr<Motion> motion_of(Problem problem) {
  if (problem.many_trains) return std::make_unique<ManyTrains>(std::move(problem));
  return std::make_unique<OneTrain>(std::move(problem));
}

}  // namespace

struct Run::Parts {
  output::Schedule schedule;
  std::unique_ptr<Motion> motion;
  StepBudget budget;
  double stepping_seconds = 0;
  std::vector<output::Snapshot> snapshots;
  /// Whether the present state depends on the end of the run. The last steps do, because the last one must end there.
  bool aimed_at_end = false;
  /// The last state that does not depend on it, in the last stretch before the end. A run to a later end continues from
  /// that state.
  std::string before_end;
  std::optional<output::Findings> final_findings;  ///< findings of a finished run

  Parts(Problem problem, output::Schedule given)
      : schedule(std::move(given)),
        motion(motion_of(std::move(problem))),
        budget(expected_steps(*motion, schedule), schedule.times.back()) {}

  bool finished() const { return snapshots.size() == schedule.times.size(); }
  output::Findings findings() const { return motion->findings(snapshots); }
  bool advance_to(double target, const std::function<bool()>& interrupted);
  void take_snapshot();
  void archive(Archive& a);
  /// Call this after each step of the last stretch before the end.
  void look_at_end() {
    if (aimed_at_end) return;
    Archive a = Archive::to(before_end);
    a(*motion);
  }
};

Run::Run(Problem problem, output::Schedule schedule)
    : parts_(std::make_unique<Parts>(std::move(problem), std::move(schedule))) {}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  Parts& p = *parts_;
  p.snapshots = std::move(snapshots);
  restore(p, saved);
}

void Run::Parts::archive(Archive& a) {
  double end = schedule.times.back();
  a(*motion, end, aimed_at_end);
  if (aimed_at_end) a(before_end);
  a.require(snapshots.size() <= schedule.times.size());
  if (!a.reads() || !aimed_at_end || end == schedule.times.back()) return;
  restore(*motion, before_end);
  aimed_at_end = false;
  while (!snapshots.empty() && snapshots.back().time > motion->time()) snapshots.pop_back();
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

const Solver& Run::solver() const {
  if (problem().many_trains) throw std::logic_error("Run::solver: the run follows many trains");
  return static_cast<const OneTrain&>(*parts_->motion).solver();
}
const Problem& Run::problem() const { return parts_->motion->problem(); }
double Run::time() const { return parts_->motion->time(); }
long Run::steps() const { return parts_->motion->steps(); }
double Run::crossing_time() const { return parts_->motion->crossing_time(); }
double Run::crossing_position() const { return parts_->motion->crossing_position(); }
double Run::conservation_error() const { return parts_->motion->conservation_error(); }
const output::Schedule& Run::schedule() const { return parts_->schedule; }
const std::vector<output::Snapshot>& Run::snapshots() const { return parts_->snapshots; }
const StepBudget& Run::budget() const { return parts_->budget; }
double Run::stepping_seconds() const { return parts_->stepping_seconds; }
bool Run::finished() const { return parts_->finished(); }

std::string Run::saved() const { return slipfront::saved(*parts_); }

std::optional<SlipTwice> Run::slip_twice() const { return parts_->motion->slip_twice(); }

std::vector<std::string> Run::warnings() const {
  return parts_->final_findings ? parts_->final_findings->sentences : parts_->findings().sentences;
}

void Run::Parts::take_snapshot() {
  output::Snapshot s = motion->observe(schedule);
  output::complete(s, schedule);
  snapshots.push_back(std::move(s));
}

bool Run::Parts::advance_to(double target, const std::function<bool()>& interrupted) {
  const bool last = snapshots.size() + 1 == schedule.times.size();
  if (last) look_at_end();
  const auto after_step = [&] {
    aimed_at_end = aimed_at_end || (last && motion->aimed_at_target());
    if (last) look_at_end();
    if (budget.exhausted(motion->steps()))
      throw budget.error(motion->time(), motion->steps(), motion->reason_of_short_steps(),
                         "fewer cells, an earlier end or a run of the chain may help");
    return interrupted && interrupted();
  };
  const auto begun = Clock::now();
  const bool reached = motion->advance_to(target, after_step);
  stepping_seconds += seconds_since(begun);
  return reached;
}

bool Run::go(const std::function<bool()>& interrupted) {
  Parts& p = *parts_;
  while (!p.finished()) {
    if (!p.advance_to(p.schedule.times[p.snapshots.size()], interrupted)) return false;
    p.take_snapshot();
  }
  p.final_findings = p.findings();
  if (p.final_findings->wrong_results())
    throw NumericsError("t = " + digits(p.motion->time()) + ": " + p.final_findings->worst);
  return true;
}

}  // namespace slipfront::pulse
