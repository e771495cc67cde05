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
namespace {

/// Expected number of steps. Each output time adds two, because a step must end on it and the step before is shortened.
double expected_steps(const Solver& start, const output::Schedule& schedule) {
  return start.expected_steps(schedule.times.back()) + 2 * static_cast<double>(schedule.times.size());
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
};

Run::Run(Problem problem, output::Schedule schedule)
    : parts_(std::make_unique<Parts>(std::move(problem), std::move(schedule))) {}

Run::Run(Problem problem, output::Schedule schedule, std::string_view saved, std::vector<output::Snapshot> snapshots)
    : Run(std::move(problem), std::move(schedule)) {
  Parts& p = *parts_;
  bytes::Reader reader(saved);
  if (snapshots.size() > p.schedule.times.size()) checkpoint::refuse();
  Cells cells = checkpoint::get_cells(reader, p.solver.problem().friction);
  const double trailing_characteristic = checkpoint::get_number(reader, "trailing_characteristic");
  p.slip.restore(reader);
  reader.end();
  p.solver.restore(std::move(cells));
  p.trailing_characteristic.restore(p.solver, trailing_characteristic);
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
  checkpoint::put(writer, solver().cells(), solver().problem().friction);
  checkpoint::put_number(writer, "trailing_characteristic", parts_->trailing_characteristic.position());
  parts_->slip.save(writer);
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
  const auto after_step = [&] {
    const Cells& cells = solver.cells();
    trailing_characteristic.advance(solver, cells.time - before);
    before = cells.time;
    // We sample implicit steps more often: one costs as much as ten samples, an explicit step only as much as a few.
    const bool begins = cells.steps < 64, is_explicit = cells.face_momentum.empty();
    if (cells.steps % (is_explicit ? begins ? 4 : 16 : begins ? 1 : 2) == 0) slip.sample(solver);
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
