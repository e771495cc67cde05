#include "solve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "math/interpolation.hpp"
#include "slipfront/theory/rupture/relations.hpp"

namespace slipfront::friction_ratio {
namespace {

using std::numbers::pi;

std::vector<Point> points_of(const pulse::Solver::View& view, double stress) {
  const double charge = view.charge_faces.back();
  const auto point = [&](double x, const State& state, double charge_left) {
    const double initial_left = charge + stress * std::fmin(x, 0) / (2 * pi);
    return Point{x, pulse::averages_of(view, state, x).W, 2 * pi * (initial_left - charge_left)};
  };
  std::vector<Point> points{point(view.faces[0], view.face_states[0], 0)};
  for (std::size_t i = 0; i < view.centres.size(); ++i) {
    points.push_back(point(view.centres[i], view.states[i], pulse::charge_left_of(view, view.centres[i])));
    points.push_back(point(view.faces[i + 1], view.face_states[i + 1], view.charge_faces[i + 1]));
  }
  return points;
}

double slip_weighted_mean_of(const std::vector<Point>& points) {
  double moment = 0, slip = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    moment += (a.W * a.slip + b.W * b.slip) * (b.x - a.x);
    slip += (a.slip + b.slip) * (b.x - a.x);
  }
  return moment / slip;
}

/// How far from x = 0 the cells reach, in units of V T. The moving part ends at the trailing edge, V T. At late times,
/// when slip diffuses, it ends far inside this edge.
double late_reach(double damping_number) { return std::fmin(1.02, 9 / std::sqrt(damping_number)); }

pulse::Solver solver_of(const Question& question, double reach_over_front) {
  const double reach = reach_over_front * rupture::from_stress(question.stress).rupture_velocity;
  return pulse::Solver({.stress = [stress = question.stress](double x) { return x < 0 ? stress : 0.0; },
                        .forcing = {},
                        .friction = friction::viscous(question.damping_number, question.closure),
                        .left = -reach,
                        .right = reach,
                        .cells = question.cells});
}

SlipVelocities velocities_of(const pulse::Solver& solver, double stress, double time) {
  const pulse::Solver::View view = solver.view();
  const std::vector<Point> points = points_of(view, stress);
  const double slip = 2 * pi * (view.charge_faces.back() - pulse::charge_left_of(view, 0));
  return {pulse::averages_of(view, pulse::state_at(view, 0), 0).W, slip_weighted_mean_of(points), peak_of(points),
          slip / time};
}

}  // namespace

// A parabola through three points gives the maximum. Cells
// past that maximum do not count: the last few cells at the free edge of a strongly damped pulse are not resolved.
double peak_of(const std::vector<Point>& points) {
  auto top = std::find_if(points.begin() + 1, points.end() - 2, [](const Point& p) { return p.x >= 0; });
  while (top != points.begin() + 1 && top[-1].W > top->W) --top;
  while (top != points.end() - 2 && top[1].W > top->W) ++top;
  top = std::max_element(points.begin() + 1, top + 1, [](const Point& a, const Point& b) { return a.W < b.W; });
  const auto [slope, curve] =
      parabola_through(top[-1].x - top->x, top[-1].W - top->W, top[1].x - top->x, top[1].W - top->W);
  return curve < 0 ? top->W - slope * slope / (4 * curve) : top->W;
}

SlipVelocities solve(const Question& question) {
  pulse::Solver solver = solver_of(question, late_reach(question.damping_number));
  solver.advance_to(1);
  return velocities_of(solver, question.stress, 1);
}

Pulse solve_pulse(const Question& question) {
  double damping = question.damping_number;
  if (question.closure == friction::Closure::paper) {
    // This closure has less friction on the stressed side, by pi^2 / (4 E K), so the foot of the front spreads farther.
    const rupture::Relations r = rupture::from_stress(question.stress);
    const double K = pi * std::cosh(r.psi) / question.stress;
    damping *= pi * pi / (4 * K * K / r.velocity_ratio);
  }
  pulse::Solver solver = solver_of(question, late_reach(damping));
  solver.advance_to(1);
  const pulse::Solver::View view = solver.view();
  return {points_of(view, question.stress), pulse::averages_of(view, pulse::state_at(view, 0), 0).k,
          2 * pi * (view.charge_faces.back() - pulse::charge_left_of(view, 0))};
}

std::vector<SlipVelocities> solve_each(double stress, friction::Closure closure, int cells,
                                       const std::vector<double>& damping_numbers) {
  pulse::Solver solver =
      solver_of({stress, damping_numbers.back(), closure, cells}, late_reach(damping_numbers.back()));
  std::vector<SlipVelocities> found;
  for (const double damping : damping_numbers) {
    const double time = damping / damping_numbers.back();
    solver.advance_to(time);
    found.push_back(velocities_of(solver, stress, time));
  }
  return found;
}

}  // namespace slipfront::friction_ratio
