#include "pulse/checks/slip_record.hpp"

#include <algorithm>
#include <cmath>

namespace slipfront::pulse {
namespace {

/// Estimates the error of the slip velocity W at x. It is the distance of W from the straight line between the cell
/// centre and the face on the same side as x, plus 1 % of the change of W between the two. Such an error arises if a
/// pulse is narrower than a cell, because the cells then do not resolve it.
double unresolved_at(const View& v, double x, double W) {
  const auto right = std::upper_bound(v.faces.begin() + 1, v.faces.end() - 1, x);
  const auto cell = static_cast<std::size_t>(right - v.faces.begin() - 1);
  if (v.states[cell].empty()) return 0;
  constexpr double interpolated = 0.01;
  const std::size_t face = x < v.centres[cell] ? cell : cell + 1;
  const double at_face = averages_of(v, v.face_states[face], v.faces[face]).W;
  const double at_centre = averages_of(v, v.states[cell], v.centres[cell]).W;
  const double share = (x - v.centres[cell]) / (v.faces[face] - v.centres[cell]);
  return std::fabs(W - std::lerp(at_centre, at_face, share)) + interpolated * std::fabs(at_face - at_centre);
}

}  // namespace

double SlipTwice::error() const {
  const double apart = std::fabs(by_place - by_velocity);
  return std::fmax(apart - sampling, std::fmin(apart, of_velocity));
}

void SlipRecord::sample(const Solver& solver) {
  const View v = solver.view(false);
  const double velocity = averages_of(v, state_at(v, 0), 0).W;
  add(solver.cells().time, velocity, unresolved_at(v, 0, velocity));
}

void SlipRecord::add(double time, double velocity, double doubt) {
  const double elapsed = time - integral_.time;
  size_ += elapsed * (std::fabs(velocity) + std::fabs(integral_.velocity)) / 2;
  doubt_ += elapsed * doubt;
  integral_.add(time, velocity);
}

std::optional<SlipTwice> SlipRecord::compare(const Solver& solver) const {
  if (!can_compare(solver.problem())) return std::nullopt;
  const View v = solver.view();
  return compare(solver.cells().time, solver.slip_at(v, 0), averages_of(v, state_at(v, 0), 0).W);
}

bool SlipRecord::can_compare(const Problem& problem) const {
  return problem.left < 0 && problem.right > 0 && integral_.samples > 8;
}

SlipTwice SlipRecord::compare(double time, double slip, double velocity) const {
  return {slip, integral_.up_to(time, velocity), integral_.error(), doubt_};
}

}  // namespace slipfront::pulse
