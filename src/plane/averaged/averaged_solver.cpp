#include <algorithm>
#include <string>

#include "foundation/bytes.hpp"
#include "foundation/text/digits.hpp"
#include "plane/averaged/loops.hpp"
#include "plane/averaged/observe.hpp"
#include "plane/averaged/steps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/averaged.hpp"

namespace slipfront::plane {

using std::numbers::pi;

struct AveragedSolver::Parts {
  Problem problem;
  Loops loops;
  LoopSteps steps;
  double volume_at_start, elastic_at_start = 0;

  Parts(const Problem& p, const Resolution& resolution)
      : problem(p),
        loops(initial_loops(problem, static_cast<std::size_t>(resolution.loops),
                            static_cast<std::size_t>(resolution.angles))),
        steps(problem, loops),
        volume_at_start(volume(loops)) {
    steps.look();
    elastic_at_start = energy(loops, steps.equations()).elastic;
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
  /// A loop that shrinks to a point vanishes, which distances from the origin cannot describe.
  void check_middle() const {
    const std::size_t inner = loops.rows * loops.angles;
    for (std::size_t k = 0; k < loops.angles; ++k)
      if (!(loops.r[inner + k] > 1e-3 * loops.r[k]))
        throw NumericsError("t = " + digits(loops.time) +
                            ": the innermost dislocation line has shrunk to the origin and vanishes");
  }
};

AveragedSolver::AveragedSolver(const Problem& problem, const Resolution& resolution) {
  if (problem.friction.state_size() > 0)
    throw InputError({.key = "friction.law",
                      .value = std::string(problem.friction.name()),
                      .problem = "the averaged equations on a plane do not follow the state of friction",
                      .allowed = "a law without state variables"});
  if (!problem.viscous && problem.friction.steep_at_rest())
    throw InputError({.key = "friction.law",
                      .value = std::string(problem.friction.name()),
                      .problem = "the averaged equations on a plane do not follow friction that holds slip at rest",
                      .allowed = "a law whose force rises smoothly from rest"});
  const bool enough = resolution.loops >= 4 && (resolution.angles == 1 || resolution.angles >= 8);
  if (!enough)
    throw InputError({.key = "resolution",
                      .value = std::to_string(resolution.loops) + " x " + std::to_string(resolution.angles),
                      .problem = "too few cells for the interpolation between them",
                      .allowed = "at least 4 loops, and 1 angle or at least 8"});
  parts_ = std::make_unique<Parts>(problem, resolution);
}

AveragedSolver::~AveragedSolver() = default;

double AveragedSolver::time() const { return parts_->loops.time; }
long AveragedSolver::steps() const { return parts_->loops.steps; }

bool AveragedSolver::advance_to(double time, const std::function<bool()>& interrupted) {
  Parts& p = *parts_;
  while (p.loops.time < time) {
    p.steps.take(time);
    p.check_front();
    p.check_middle();
    if (interrupted && interrupted()) break;
  }
  if (p.loops.time < time) return false;
  p.steps.look();
  check_budget();
  return true;
}

/// Coarse cells lose some energy while the front begins to move, but none may come from nothing.
void AveragedSolver::check_budget() const {
  constexpr double most = 0.1;
  const Energies e = energies();
  const double excess = e.kinetic + e.elastic + e.dissipated - e.supplied;
  const double largest = std::max({e.kinetic, std::fabs(e.elastic), e.dissipated, std::fabs(e.supplied)});
  if (excess > most * largest)
    throw NumericsError("t = " + digits(time()) + ": the energy is " + digits(100 * excess / largest, 3) +
                        " % larger than at the start; friction is too strong for this number of cells");
}

std::vector<double> AveragedSolver::slip(const std::vector<Point>& points) const {
  std::vector<double> slips;
  for (const Point& at : points) {
    const std::vector<double> faces = along_ray(parts_->loops, parts_->loops.r, std::atan2(at.y, at.x));
    const double count = loops_outside(parts_->loops, faces, std::hypot(at.x, at.y));
    slips.push_back(2 * pi * count - parts_->problem.slip(at.x, at.y));
  }
  return slips;
}

std::vector<double> AveragedSolver::velocity(const std::vector<Point>& points) const {
  const Loops& loops = parts_->loops;
  const std::vector<double> w = slip_velocities(loops, parts_->steps.equations());
  std::vector<double> velocities;
  for (const Point& at : points) {
    const double angle = std::atan2(at.y, at.x), r = std::hypot(at.x, at.y);
    const std::vector<double> faces = along_ray(loops, loops.r, angle), ray = along_ray(loops, w, angle);
    double velocity = 0;
    for (std::size_t row = 0; row < loops.rows; ++row) {
      if (r > faces[row] || r <= faces[row + 1]) continue;
      const double middle = (faces[row] + faces[row + 1]) / 2;
      const std::size_t next = r > middle ? (row > 0 ? row - 1 : row) : std::min(row + 1, loops.rows - 1);
      const double there = (faces[next] + faces[next + 1]) / 2;
      velocity = next == row ? ray[row] : ray[row] + (ray[next] - ray[row]) * (r - middle) / (there - middle);
    }
    velocities.push_back(velocity);
  }
  return velocities;
}

Field AveragedSolver::field(int nx, int ny) const {
  const Problem& p = parts_->problem;
  std::vector<Point> points;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      points.push_back({p.left + (p.right - p.left) * (i + 0.5) / nx, p.bottom + (p.top - p.bottom) * (j + 0.5) / ny});
  return {.time = time(), .nx = nx, .ny = ny, .slip = slip(points), .velocity = velocity(points)};
}

double AveragedSolver::potency() const { return volume(parts_->loops) - parts_->volume_at_start; }

double AveragedSolver::potency_rate() const {
  const Loops& loops = parts_->loops;
  const LoopEquations& equations = parts_->steps.equations();
  double rate = 0;
  for (std::size_t i = 0; i < loops.cells(); ++i)
    rate += 2 * pi * equations.velocity()[i] * equations.middle(i) * loops.charge(i / loops.angles) * loops.turn();
  return rate;
}

double AveragedSolver::front() const {
  const Loops& loops = parts_->loops;
  return *std::max_element(loops.r.begin(), loops.r.begin() + static_cast<std::ptrdiff_t>(loops.angles));
}

Energies AveragedSolver::energies() const {
  const Loops& loops = parts_->loops;
  const LoopEnergy now = energy(loops, parts_->steps.equations());
  return {.kinetic = now.kinetic,
          .elastic = now.elastic - parts_->elastic_at_start,
          .dissipated = loops.dissipated,
          .supplied = loops.supplied};
}

std::string AveragedSolver::saved() const {
  const Loops& loops = parts_->loops;
  bytes::Writer writer;
  writer.put(loops.time);
  writer.put(static_cast<std::int64_t>(loops.steps));
  for (const double value : {loops.limit, loops.power, loops.supply, loops.dissipated, loops.supplied})
    writer.put(value);
  for (const auto* values : {&loops.r, &loops.momentum, &loops.s, &loops.loss}) writer.put(*values);
  return std::move(writer).text();
}

void AveragedSolver::resume(std::string_view saved) {
  Loops& loops = parts_->loops;
  bytes::Reader reader(saved);
  Loops read = loops;
  read.time = reader.get<double>();
  read.steps = static_cast<long>(reader.get<std::int64_t>());
  for (double* value : {&read.limit, &read.power, &read.supply, &read.dissipated, &read.supplied})
    *value = reader.get<double>();
  for (auto* values : {&read.r, &read.momentum, &read.s, &read.loss}) *values = reader.vector();
  reader.end();
  if (read.r.size() != loops.r.size() || read.momentum.size() != loops.momentum.size() ||
      read.s.size() != loops.s.size() || read.loss.size() != loops.loss.size())
    throw InputError({.key = "resume",
                      .problem = "the saved state has another number of cells",
                      .allowed = "a file of the same scenario"});
  loops = read;
  parts_->steps.look();  // for observers
  loops = read;
}

}  // namespace slipfront::plane
