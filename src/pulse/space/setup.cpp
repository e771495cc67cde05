#include "pulse/space/setup.hpp"

#include <cmath>

namespace slipfront::pulse {
namespace {

/// The edge of the cells at an end of the domain. At a wall, the equations find out whether the train touches it.
Edge edge_at(const Problem& problem, End end, bool free) {
  if (problem.periodic) return Edge::ring;
  if (end == End::fixed) return Edge::wall;
  return free || end == End::free ? Edge::free : Edge::continued;
}

}  // namespace

bool is_steep(const friction::Friction& f) { return f.acts() && f.steep_at_rest() && !f.sticks(); }

bool takes_friction_by_cells(const Problem& problem) {
  const friction::Friction& f = problem.friction;
  return f.state_size() > 0 || (is_steep(f) && !problem.periodic);
}

Setup setup_of(const Problem& problem, const Cells& cells, FreeEdges free) {
  Setup s;
  s.charge = cells.charge;
  s.left = edge_at(problem, problem.left_end, free.left);
  s.right = edge_at(problem, problem.right_end, free.right);
  s.left_wall = problem.left;
  s.right_wall = problem.right;
  if (problem.friction.state_size() == 0) s.friction = problem.friction;  // else CellFriction has it
  s.friction_apart = takes_friction_by_cells(problem);
  s.forcing = problem.forcing;
  s.contact = problem.contact;
  if (problem.periodic) {
    const auto on_ring = [left = problem.left, period = problem.right - problem.left](double x) {
      return x - std::floor((x - left) / period) * period;
    };
    if (s.forcing) s.forcing = [on_ring, f = s.forcing](double x, double t) { return f(on_ring(x), t); };
    if (s.contact) s.contact = [on_ring, f = s.contact](double x) { return f(on_ring(x)); };
  }
  return s;
}

}  // namespace slipfront::pulse
