#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

#include "foundation/archive.hpp"
#include "foundation/text/digits.hpp"
#include "plane/averaged/loops.hpp"
#include "plane/averaged/observe.hpp"
#include "plane/averaged/steps.hpp"
#include "plane/budget.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/averaged.hpp"

namespace slipfront::plane {

using std::numbers::pi;

namespace {
constexpr std::size_t fewest = 4;  ///< rows that the interpolation between them needs
}

struct AveragedSolver::Parts {
  Problem problem;
  Loops loops;
  std::optional<LoopSteps> steps;
  double volume_at_start, elastic_at_start = 0;
  /// The initial slip in the cells of the last field, because a formula takes longer than all else.
  struct SlipAtStart {
    int nx = 0, ny = 0;
    std::vector<double> slip;
  } start;

  double slip_now(const Point& at) const {
    return 2 * pi * Ray(loops, std::atan2(at.y, at.x)).loops_outside(std::hypot(at.x, at.y));
  }

  Parts(const Problem& p, const Resolution& resolution)
      : problem(p),
        loops(initial_loops(problem, static_cast<std::size_t>(resolution.loops),
                            static_cast<std::size_t>(resolution.angles))),
        steps(std::in_place, problem, loops),
        volume_at_start(volume(loops)) {
    steps->look();
    elastic_at_start = energy(loops, steps->equations()).elastic;
  }

  /// The front must stay inside the domain, because the averaged solver has no boundary there.
  void check_front() const {
    for (std::size_t k = 0; k < loops.angles; ++k) {
      const double x = loops.r[k] * std::cos(loops.angle(k)), y = loops.r[k] * std::sin(loops.angle(k));
      if (x > problem.left && x < problem.right && y > problem.bottom && y < problem.top) continue;
      throw NumericsError("t = " + digits(loops.time) + ", x = " + digits(x, 4) + ", y = " + digits(y, 4) +
                          ": the front has reached the edge of the domain, where the averaged solver ends");
    }
  }
  /// A loop that shrinks to a point vanishes, and its energy leaves as waves. We remove the innermost cells as they
  /// reach the origin.
  void remove_vanished() {
    while (loops.innermost_vanishes()) {
      if (loops.rows <= fewest)
        throw NumericsError("t = " + digits(loops.time) + ": nearly all dislocation lines have shrunk and vanished");
      const LoopEnergy before = energy(loops, steps->equations());
      loops.remove_innermost();
      steps.emplace(problem, loops);
      steps->look();
      const LoopEnergy now = energy(loops, steps->equations());
      if (loops.vanished == 0) loops.vanished_since = loops.time;
      loops.vanished += before.elastic + before.kinetic - now.elastic - now.kinetic;
    }
  }
};

AveragedSolver::AveragedSolver(const Problem& problem, const Resolution& resolution) {
  if (problem.hold || problem.nucleation)
    throw InputError({.key = problem.hold ? "hold" : "nucleation",
                      .problem = "the averaged equations on a plane begin with free lines everywhere"});
  if (!problem.friction.definition().state.empty())
    throw InputError({.key = "friction",
                      .value = std::string(problem.friction.name()),
                      .problem = "the averaged equations on a plane do not follow the state of friction",
                      .allowed = "a law without state variables"});
  if (problem.friction.steep_at_rest())
    throw InputError({.key = "friction",
                      .value = std::string(problem.friction.name()),
                      .problem = "the averaged equations on a plane do not follow friction that holds slip at rest",
                      .allowed = "a law whose force rises smoothly from rest"});
  if (problem.edges != Edges::free)
    throw InputError({.key = "edges",
                      .problem = "the averaged equations on a plane end where the front reaches an edge",
                      .allowed = "free edges, which the front does not reach"});
  assert(resolution.loops >= 4 && (resolution.angles == 1 || resolution.angles >= 8));
  parts_ = std::make_unique<Parts>(problem, resolution);
}

AveragedSolver::~AveragedSolver() = default;

const Problem& AveragedSolver::problem() const { return parts_->problem; }
double AveragedSolver::time() const { return parts_->loops.time; }
long AveragedSolver::steps() const { return parts_->loops.steps; }

bool AveragedSolver::advance_to(double time, const std::function<bool()>& interrupted) {
  Parts& p = *parts_;
  while (p.loops.time < time) {
    p.steps->take(time);
    p.check_front();
    p.remove_vanished();
    if (interrupted && interrupted()) break;
  }
  if (p.loops.time < time) return false;
  p.steps->look();
  constexpr double noise = 1e-6;  // fraction of the energy at the start
  check_budget(energies(), noise * p.elastic_at_start, time, "friction is too strong for this number of cells");
  return true;
}

StepsAhead AveragedSolver::steps_ahead(double duration) const { return parts_->steps->ahead(duration); }

std::vector<double> AveragedSolver::slip(const std::vector<Point>& points) const {
  std::vector<double> slips;
  slips.reserve(points.size());
  for (const Point& at : points) slips.push_back(parts_->slip_now(at) - parts_->problem.slip(at.x, at.y));
  return slips;
}

std::vector<double> AveragedSolver::velocity(const std::vector<Point>& points) const {
  const std::vector<double> w = slip_velocities(parts_->loops, parts_->steps->equations());
  std::vector<double> velocities;
  velocities.reserve(points.size());
  for (const Point& at : points)
    velocities.push_back(Ray(parts_->loops, std::atan2(at.y, at.x)).at(w, std::hypot(at.x, at.y)));
  return velocities;
}

Field AveragedSolver::field(int nx, int ny) const {
  const Problem& p = parts_->problem;
  Parts::SlipAtStart& start = parts_->start;
  const std::vector<double> w = slip_velocities(parts_->loops, parts_->steps->equations());
  Field field{.time = time(), .nx = nx, .ny = ny, .slip = {}, .velocity = {}};
  std::vector<double> at_start;
  const bool known = start.nx == nx && start.ny == ny;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const Point at{p.left + (p.right - p.left) * (i + 0.5) / nx, p.bottom + (p.top - p.bottom) * (j + 0.5) / ny};
      if (!known) at_start.push_back(p.slip(at.x, at.y));
      const Ray ray(parts_->loops, std::atan2(at.y, at.x));
      const double r = std::hypot(at.x, at.y);
      field.slip.push_back(2 * pi * ray.loops_outside(r));
      field.velocity.push_back(ray.at(w, r));
    }
  if (!known) start = {nx, ny, std::move(at_start)};
  for (std::size_t i = 0; i < field.slip.size(); ++i) field.slip[i] -= start.slip[i];
  return field;
}

std::vector<Line> AveragedSolver::lines() const {
  constexpr std::size_t fewest_points = 64;
  const Loops& loops = parts_->loops;
  const std::size_t points = std::max(loops.angles, fewest_points);
  Line front{.number = 1, .points = {}};
  for (std::size_t k = 0; k <= points; ++k) {
    const double angle = 2 * pi * static_cast<double>(k % points) / static_cast<double>(points);
    const double r = Ray(loops, angle).face(0);
    front.points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return {front};
}

double AveragedSolver::potency() const { return volume(parts_->loops) - parts_->volume_at_start; }

double AveragedSolver::potency_rate() const {
  const Loops& loops = parts_->loops;
  const LoopEquations& equations = parts_->steps->equations();
  double rate = 0;
  for (std::size_t i = 0; i < loops.cells(); ++i)
    rate += 2 * pi * equations.velocity()[i] * equations.middle(i) * loops.charge(i / loops.angles) * loops.turn();
  return rate;
}

double AveragedSolver::front(double y_scale) const {
  const Loops& loops = parts_->loops;
  double farthest = 0;
  for (std::size_t k = 0; k < loops.angles; ++k)
    farthest =
        std::fmax(farthest, loops.r[k] * std::hypot(std::cos(loops.angle(k)), y_scale * std::sin(loops.angle(k))));
  return farthest;
}

Energies AveragedSolver::energies() const {
  const Loops& loops = parts_->loops;
  const LoopEnergy now = energy(loops, parts_->steps->equations());
  return {.kinetic = now.kinetic,
          .elastic = now.elastic - parts_->elastic_at_start,
          .dissipated = loops.dissipated,
          .supplied = loops.supplied,
          .vanished = loops.vanished,
          .radiated = 0};
}

std::vector<std::string> AveragedSolver::warnings() const {
  const Loops& loops = parts_->loops;
  if (loops.vanished == 0) return {};
  return {"dislocation lines have shrunk to the origin since t = " + digits(loops.vanished_since, 4) +
          ". In the full equation they pass through each other there and return with the opposite sign, which these "
          "averages do not follow: results are wrong closer to the origin than " +
          digits(loops.time - loops.vanished_since, 4)};
}

void AveragedSolver::archive(Archive& a) {
  Parts& p = *parts_;
  Loops now = p.loops;
  std::size_t rows = now.rows;
  a(rows);
  while (now.rows > std::max(rows, fewest)) now.remove_innermost();
  a.require(now.rows == rows);
  a(now.time, now.steps, now.limit, now.power, now.supply, now.dissipated, now.supplied, now.vanished,
    now.vanished_since);
  a.fixed(now.r, now.momentum, now.s, now.loss);
  if (!a.reads()) return;
  p.loops = now;
  p.steps.emplace(p.problem, p.loops);
  p.loops.loss = now.loss;
  p.steps->look();  // for observers
  p.loops = now;
}

}  // namespace slipfront::plane
