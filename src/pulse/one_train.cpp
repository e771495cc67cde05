#include "pulse/one_train.hpp"

#include <cmath>
#include <utility>

#include "pulse/checks/checks.hpp"
#include "pulse/observe/observe.hpp"

namespace slipfront::pulse {

OneTrain::OneTrain(Problem problem)
    : solver_(std::move(problem)), trailing_characteristic_(solver_), first_energy_(stored_energy(solver_)) {}

OneTrain::OneTrain(Problem problem, Start start) : OneTrain(std::move(problem)) {
  const double trailing = std::isnan(start.trailing_front) ? trailing_characteristic_.position() : start.trailing_front;
  solver_.restore(std::move(start.cells));
  trailing_characteristic_.restore(solver_, trailing);
  slip_ = start.slip;
  warnings_ = std::move(start.warnings);
}

bool OneTrain::advance_to(double target, const std::function<bool()>& after_step) {
  double before = time();
  return solver_.advance_to(target, [&] {
    const Cells& cells = solver_.cells();
    trailing_characteristic_.advance(solver_, cells.time - before);
    before = cells.time;
    // We sample implicit steps more often: one costs as much as ten samples, an explicit step only as much as a few.
    const bool begins = cells.steps < 64, is_explicit = cells.face_momentum.empty();
    if (cells.steps % (is_explicit ? begins ? 4 : 16 : begins ? 1 : 2) == 0) slip_.sample(solver_);
    return after_step();
  });
}

void OneTrain::archive(Archive& a) {
  double position = trailing_characteristic_.position();
  a(solver_, position, slip_, warnings_);
  if (a.reads()) trailing_characteristic_.restore(solver_, position);
}

output::Snapshot OneTrain::observe(const output::Schedule& schedule) const {
  output::Snapshot s = pulse::observe(solver_, schedule.x_edges, trailing_characteristic_, schedule.threshold);
  const StoredEnergy stored = stored_energy(solver_);
  output::Energy& e = s.energy;
  const double released =
      (first_energy_.isolated - stored.isolated + e.through_ends) + first_energy_.interaction - stored.interaction;
  e.residual = released + first_energy_.kinetic + e.supplied - e.dissipated - e.kinetic;
  if (!std::isnan(crossing_time())) e.shocks = e.residual;
  return s;
}

output::Findings OneTrain::findings(const std::vector<output::Snapshot>& snapshots) const {
  output::Findings found = Checks(solver_, first_energy_, slip_, snapshots).findings();
  found.sentences.insert(found.sentences.end(), warnings_.begin(), warnings_.end());
  return found;
}

}  // namespace slipfront::pulse
