#include "averages/pulse/solver.hpp"

#include <utility>

#include "averages/pulse/grid/layout.hpp"
#include "averages/pulse/steps/stepper.hpp"
#include "averages/pulse/view/view.hpp"
#include "slipfront/error.hpp"

namespace slipfront::pulse {

/// The parts refer to each other, so that they do not move when the solver does.
struct Solver::Impl {
  Problem problem;
  Start start;
  InitialGrid initial;
  Stepper stepper;
  Cells cells;

  explicit Impl(Problem given)
      : problem(std::move(given)),
        start(start_of(problem)),
        initial(problem, start.cells, start.free),
        stepper(problem, initial),
        cells(std::move(start.cells)) {
    cells.state = stepper.state_grid().initial();
    stepper.rebuild(cells);
  }
};

double Solver::memory_needed(int cells) {
  constexpr double each = 66;  // doubles of a cell: states, fluxes, the stages of a step and its Jacobian
  return sizeof(double) * each * cells;
}

double Solver::disk_needed(int cells) {
  constexpr double each = 12;  // doubles of a cell in the two saved states, including the edges of x
  return sizeof(double) * each * cells;
}

Solver::Solver(Problem problem) : parts_(std::make_unique<Impl>(std::move(problem))) {}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

const Problem& Solver::problem() const { return parts_->problem; }
const Cells& Solver::cells() const { return parts_->cells; }

void Solver::restore(Cells cells) {
  if (!parts_->initial.fits(cells, parts_->cells.state.size()))
    throw InputError(
        {.key = "resume",
         .value = std::to_string(cells.size()) + " cells",
         .problem = "does not fit the scenario",
         .allowed = "cells of this scenario, " + std::to_string(parts_->initial.faces.size() - 1) + " at first"});
  parts_->cells = std::move(cells);
  parts_->stepper.rebuild(parts_->cells);
}

void Solver::archive(Archive& a) {
  std::string states = "state:";
  for (const std::string& name : problem().friction.state_names()) states += " " + name;
  a.same(states);
  if (!a.reads()) return a(parts_->cells);
  Cells saved;
  a(saved);
  restore(std::move(saved));
}

bool Solver::advance_to(double time, const std::function<bool()>& interrupted) {
  while (cells().time < time) {
    parts_->stepper.step(parts_->cells, time);
    if (interrupted && interrupted()) break;
  }
  return cells().time >= time;
}

bool Solver::aimed_at_time() const { return parts_->stepper.aimed_at_time(); }

double Solver::expected_steps(double duration) const { return parts_->stepper.expected_steps(cells(), duration); }
std::string Solver::reason_of_short_steps() const { return parts_->stepper.reason_of_short_steps(cells()); }

Solver::View Solver::view(bool densities) const {
  return view_of(problem(), cells(), parts_->stepper.equations(), densities);
}

State Solver::state_in(std::size_t cell) const {
  return problem().contact ? view().states[cell] : pulse::state_in(cells(), cell);
}

double Solver::slip_at(const View& view, double x) const { return pulse::slip_at(parts_->initial, cells(), view, x); }

}  // namespace slipfront::pulse
