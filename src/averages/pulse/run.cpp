#include "slipfront/averages/pulse/run.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "averages/pulse/one_train.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/time_steps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "system/archive.hpp"
#include "system/machine.hpp"

namespace slipfront::pulse {
namespace {

/// Expected number of steps. Each output time adds two, because a step must end on it and the step before is shortened.
double steps_to_end(const Motion& start, const output::Schedule& schedule) {
  return start.expected_steps(schedule.times.back()) + 2 * static_cast<double>(schedule.times.size());
}

/// The motion with as many trains at one position as there are, or with one.
std::unique_ptr<Motion> motion_of(Problem problem, bool many) {
  problem.many_trains = many;
  if (many) return std::make_unique<ManyTrains>(std::move(problem));
  return std::make_unique<OneTrain>(std::move(problem));
}

}  // namespace

/// A motion, and the one that takes over from it.
class Motions {
 public:
  explicit Motions(Problem problem) : many_(problem.many_trains) {
    const bool follows_many = many_ && ManyTrains::can_follow(problem);
    now_ = motion_of(std::move(problem), follows_many);
  }

  Motion& operator*() const { return *now_; }
  Motion* operator->() const { return now_.get(); }
  /// Whether many trains at one position are asked for.
  bool may_be_many() const { return many_; }

  bool advance_to(double target, const output::Schedule& schedule, const std::function<bool()>& after_step) {
    bool stopped = false;
    const auto stops = [&] { return stopped = after_step(); };
    while (true) {
      now_->advance_to(target, stops);
      if (!now_->problem().many_trains) return now_->time() >= target;
      const auto& many = static_cast<const ManyTrains&>(*now_);
      if (!many.is_over()) return now_->time() >= target;
      now_ = one_train_after(many, schedule);
      if (stopped) return false;
    }
  }
  void archive(Archive& a) {
    a.same(many_);
    bool many = now_->problem().many_trains;
    a(many);
    if (a.reads() && many != now_->problem().many_trains) now_ = motion_of(now_->problem(), many);
    a(*now_);
  }

 private:
  bool many_;
  std::unique_ptr<Motion> now_;
};

struct Run::Impl {
  output::Schedule schedule;
  Motions motion;
  StepBudget budget;
  double stepping_seconds = 0;
  std::vector<output::Snapshot> snapshots;
  /// Whether the present state depends on the end of the run. The last steps do, because the last one must end there.
  bool aimed_at_end = false;
  /// The last state that does not depend on it, in the last stretch before the end. A run to a later end continues from
  /// that state.
  std::string before_end;
  std::optional<output::Findings> final_findings;  ///< findings of a finished run

  Impl(Problem problem, output::Schedule given)
      : schedule(std::move(given)),
        motion(std::move(problem)),
        budget(steps_to_end(*motion, schedule), schedule.times.back()) {}

  bool finished() const { return snapshots.size() == schedule.times.size(); }
  output::Findings findings() const { return motion->findings(snapshots); }
  bool advance_to(double target, const std::function<bool()>& interrupted);
  void take_snapshot();
  void archive(Archive& a);
  /// Call this after each step of the last stretch before the end.
  void look_at_end() {
    if (aimed_at_end) return;
    Archive a = Archive::to(before_end);
    a(motion);
  }
};

Run::Run(Problem problem, output::Schedule schedule)
    : parts_(std::make_unique<Impl>(std::move(problem), std::move(schedule))) {}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  Impl& p = *parts_;
  p.snapshots = std::move(snapshots);
  restore(p, saved);
}

void Run::Impl::archive(Archive& a) {
  double end = schedule.times.back();
  a(motion, end, aimed_at_end);
  if (aimed_at_end) a(before_end);
  a.require(snapshots.size() <= schedule.times.size());
  if (!a.reads() || !aimed_at_end || end == schedule.times.back()) return;
  restore(motion, before_end);
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
double Run::expected_steps() const { return parts_->budget.expected(); }
double Run::stepping_seconds() const { return parts_->stepping_seconds; }
bool Run::finished() const { return parts_->finished(); }

void Run::archive(Archive& a) { parts_->archive(a); }

std::optional<SlipTwice> Run::slip_twice() const { return parts_->motion->slip_twice(); }

std::vector<std::string> Run::warnings() const {
  return parts_->final_findings ? parts_->final_findings->sentences : parts_->findings().sentences;
}

void Run::Impl::take_snapshot() {
  output::Snapshot s = motion->observe(schedule);
  if (motion.may_be_many() && s.profile.trains.empty())
    for (const double k : s.profile.k) s.profile.trains.push_back(k > 0 ? 1 : 0);
  output::complete(s, schedule);
  snapshots.push_back(std::move(s));
}

bool Run::Impl::advance_to(double target, const std::function<bool()>& interrupted) {
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
  const bool reached = motion.advance_to(target, schedule, after_step);
  stepping_seconds += seconds_since(begun);
  return reached;
}

bool Run::go(const std::function<bool()>& interrupted) {
  Impl& p = *parts_;
  while (!p.finished()) {
    if (!p.advance_to(p.schedule.times[p.snapshots.size()], interrupted)) return false;
    p.take_snapshot();
  }
  p.final_findings = p.findings();
  if (p.final_findings->wrong_results())
    throw NumericsError("t = " + digits(p.motion->time()) + ": " + p.final_findings->worst);
  return true;
}

namespace {

using Error = ErrorRule;
using output::Value;

/// C of f = C w; NaN for other laws.
double viscous_coefficient(const Run& run) { return run.problem().friction.linear_coefficient().value_or(none); }

constexpr std::string_view not_viscous = "friction is not viscous";
constexpr std::string_view no_crossing =
    "no dislocations have overtaken others, or pulse.trains = \"many\" makes them a train of their own";

constexpr output::Quantity<Report> of_run[] = {
    {{"closure", "how friction is averaged", "", "Eqs. 7"},
     [](const Report& e) -> Value { return name_of(e.run.problem().friction.closure()); },
     output::Kind::text},
    {{"friction_coefficient", "C of viscous friction", "", "Eqs. 7", not_viscous},
     [](const Report& e) -> Value { return viscous_coefficient(e.run); }},
    {{"damping_number", "Gamma = C t of viscous friction", "", "Eqs. 7", not_viscous},
     [](const Report& e) -> Value { return viscous_coefficient(e.run) * e.run.time(); }},
    {{"first_crossing_time", "time at which dislocations first overtake each other", "b / (c A)", "docs/pulse.md",
      no_crossing, Error::change},
     [](const Report& e) -> Value { return e.run.crossing_time(); }},
    {{"first_crossing_position", "x at which they do; averages are approximate behind it", "b / A", "docs/pulse.md",
      no_crossing, Error::position},
     [](const Report& e) -> Value { return e.run.crossing_position(); }},
    {{"conservation_error", "relative error of the number of dislocations", "", "Eq. 7"},
     [](const Report& e) -> Value { return e.run.conservation_error(); }},
    {{"cells", "cells in the domain at t = 0; others come in and leave through its ends", "", ""},
     [](const Report& e) -> Value { return static_cast<long>(e.run.problem().cells); }},
    {output::step_count, [](const Report& e) -> Value { return e.run.steps(); }},
    {{"solve_seconds", "seconds of the time steps only", "", ""},
     [](const Report& e) -> Value { return e.run.stepping_seconds(); },
     output::Kind::of_machine},
    {output::wall_time, [](const Report& e) -> Value { return e.spent.wall; }, output::Kind::of_machine},
};

}  // namespace

std::span<const output::Quantity<Report>> quantities() { return of_run; }

}  // namespace slipfront::pulse
