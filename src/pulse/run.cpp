#include "slipfront/pulse/run.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "foundation/bytes.hpp"
#include "foundation/clock.hpp"
#include "foundation/step_budget.hpp"
#include "foundation/text/digits.hpp"
#include "output/further_scalars.hpp"
#include "pulse/checkpoint.hpp"
#include "pulse/checks/checks.hpp"
#include "pulse/checks/slip_record.hpp"
#include "pulse/observe/energy.hpp"
#include "pulse/observe/observe.hpp"
#include "pulse/observe/trailing_characteristic.hpp"
#include "pulse/solver.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {
/// The part of a checkpoint that describes the run at one time.
struct SavedState {
  Cells cells = {};
  double trailing_characteristic = 0;
  SlipRecord slip = {};
};

namespace {

/// Expected number of steps. Each output time adds two, because a step must end on it and the step before is shortened.
double expected_steps(const Solver& start, const output::Schedule& schedule) {
  return start.expected_steps(schedule.times.back()) + 2 * static_cast<double>(schedule.times.size());
}

void put(bytes::Writer& writer, const SavedState& state, const friction::Friction& friction) {
  checkpoint::put(writer, state.cells, friction);
  checkpoint::put_number(writer, "trailing_characteristic", state.trailing_characteristic);
  state.slip.save(writer);
}

SavedState get_state(bytes::Reader& reader, const friction::Friction& friction) {
  SavedState state{.cells = checkpoint::get_cells(reader, friction), .trailing_characteristic = 0, .slip = {}};
  state.trailing_characteristic = checkpoint::get_number(reader, "trailing_characteristic");
  state.slip.restore(reader);
  return state;
}

}  // namespace

struct Run::Parts {
  output::Schedule schedule;
  Solver solver;
  StepBudget budget;
  TrailingCharacteristic trailing_characteristic;
  double stepping_seconds = 0;
  StoredEnergy first_energy;
  SlipRecord slip;  ///< at x = 0
  std::vector<output::Snapshot> snapshots;
  /// The last state that does not depend on the end of the run, and whether the present state does. The last steps do,
  /// because the last one must end there. A run to a later end continues from this state.
  std::optional<SavedState> before_end;
  bool aimed_at_end = false;
  std::optional<output::Findings> final_findings;  ///< findings of a finished run

  Parts(Problem problem, output::Schedule given)
      : schedule(std::move(given)),
        solver(std::move(problem)),
        budget(expected_steps(solver, schedule), schedule.times.back()),
        trailing_characteristic(solver),
        first_energy(stored_energy(solver)) {}

  bool finished() const { return snapshots.size() == schedule.times.size(); }
  output::Findings findings() const { return Checks(solver, first_energy, slip, snapshots).findings(); }
  bool advance_to(double target, const std::function<bool()>& interrupted);
  void take_snapshot();
  SavedState state() const { return {solver.cells(), trailing_characteristic.position(), slip}; }
  void restore(SavedState saved);
  /// Call this after each step of the last stretch before the end.
  void look_at_end();
};

/// Copies into the arrays of the last state, so that a step allocates nothing.
void Run::Parts::look_at_end() {
  if (aimed_at_end) return;
  if (!before_end) before_end.emplace();
  before_end->cells = solver.cells();
  before_end->trailing_characteristic = trailing_characteristic.position();
  before_end->slip = slip;
}

void Run::Parts::restore(SavedState saved) {
  slip = saved.slip;
  solver.restore(std::move(saved.cells));
  trailing_characteristic.restore(solver, saved.trailing_characteristic);
}

Run::Run(Problem problem, output::Schedule schedule)
    : parts_(std::make_unique<Parts>(std::move(problem), std::move(schedule))) {}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  Parts& p = *parts_;
  bytes::Reader reader(saved);
  if (snapshots.size() > p.schedule.times.size()) checkpoint::refuse();
  const friction::Friction& friction = p.solver.problem().friction;
  SavedState saved_state = get_state(reader, friction);
  const double end = checkpoint::get_number(reader, "end");
  p.aimed_at_end = checkpoint::get_number(reader, "aimed_at_end") != 0;
  if (p.aimed_at_end) p.before_end = get_state(reader, friction);
  reader.end();
  if (end != p.schedule.times.back() && p.aimed_at_end) {
    saved_state = *std::exchange(p.before_end, std::nullopt);
    p.aimed_at_end = false;
    while (!snapshots.empty() && snapshots.back().time > saved_state.cells.time) snapshots.pop_back();
  }
  p.restore(std::move(saved_state));
  p.snapshots = std::move(snapshots);
}

Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;

const Solver& Run::solver() const { return parts_->solver; }
const output::Schedule& Run::schedule() const { return parts_->schedule; }
const std::vector<output::Snapshot>& Run::snapshots() const { return parts_->snapshots; }
const StepBudget& Run::budget() const { return parts_->budget; }
double Run::stepping_seconds() const { return parts_->stepping_seconds; }
bool Run::finished() const { return parts_->finished(); }

std::string Run::saved() const {
  bytes::Writer writer;
  const friction::Friction& friction = solver().problem().friction;
  put(writer, parts_->state(), friction);
  checkpoint::put_number(writer, "end", parts_->schedule.times.back());
  checkpoint::put_number(writer, "aimed_at_end", parts_->aimed_at_end ? 1 : 0);
  if (parts_->aimed_at_end) put(writer, *parts_->before_end, friction);
  return std::move(writer).text();
}

std::optional<SlipTwice> Run::slip_twice() const { return parts_->slip.compare(solver()); }

std::vector<std::string> Run::warnings() const {
  return parts_->final_findings ? parts_->final_findings->sentences : parts_->findings().sentences;
}

void Run::Parts::take_snapshot() {
  output::Snapshot s = observe(solver, schedule.x_edges, trailing_characteristic, schedule.threshold);
  const StoredEnergy stored = stored_energy(solver);
  output::Energy& e = s.energy;
  const double released =
      (first_energy.isolated - stored.isolated + e.through_ends) + first_energy.interaction - stored.interaction;
  e.shocks = released + first_energy.kinetic + e.supplied - e.dissipated - e.kinetic;
  output::add_further_scalars(s, schedule);
  snapshots.push_back(std::move(s));
}

bool Run::Parts::advance_to(double target, const std::function<bool()>& interrupted) {
  double before = solver.cells().time;
  const bool last = snapshots.size() + 1 == schedule.times.size();
  if (last) look_at_end();
  const auto after_step = [&] {
    const Cells& cells = solver.cells();
    trailing_characteristic.advance(solver, cells.time - before);
    before = cells.time;
    // We sample implicit steps more often: one costs as much as ten samples, an explicit step only as much as a few.
    const bool begins = cells.steps < 64, is_explicit = cells.face_momentum.empty();
    if (cells.steps % (is_explicit ? begins ? 4 : 16 : begins ? 1 : 2) == 0) slip.sample(solver);
    aimed_at_end = aimed_at_end || (last && solver.aimed_at_time());
    if (last) look_at_end();
    if (budget.exhausted(cells.steps))
      throw budget.error(cells.time, cells.steps, solver.reason_of_short_steps(),
                         "fewer pulse.cells, an earlier time.end or slipfront chain may help");
    return interrupted && interrupted();
  };
  const auto begun = Clock::now();
  const bool reached = solver.advance_to(target, after_step);
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
    throw NumericsError("t = " + digits(p.solver.cells().time) + ": " + p.final_findings->worst);
  return true;
}

}  // namespace slipfront::pulse
