#include <algorithm>
#include <cassert>
#include <optional>
#include <string>
#include <utility>

#include "averages/loops/loops.hpp"
#include "averages/loops/steps.hpp"
#include "lattice/plane/budget.hpp"
#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"

namespace slipfront::plane {
namespace {

constexpr std::size_t samples = 2000;    ///< points of a ray on which the contours are found first
constexpr double outermost_slip = 1e-6;  ///< fraction of the slip at which the outermost line is found

/// The initial slip on a ray from the origin.
struct StartRay {
  const Problem& problem;
  double cosine, sine;
  double end;  ///< distance of the edge of the domain

  StartRay(const Problem& p, double angle) : problem(p), cosine(std::cos(angle)), sine(std::sin(angle)), end(HUGE_VAL) {
    if (cosine > 1e-12) end = std::min(end, p.right / cosine);
    if (cosine < -1e-12) end = std::min(end, p.left / cosine);
    if (sine > 1e-12) end = std::min(end, p.top / sine);
    if (sine < -1e-12) end = std::min(end, p.bottom / sine);
  }
  double slip(double r) const { return problem.slip(r * cosine, r * sine); }
  bool held(double r) const { return problem.fixed && problem.fixed(r * cosine, r * sine) != 0; }
  double at(std::size_t i) const { return end * static_cast<double>(i) / samples; }
  std::string place(double r) const { return "x = " + digits(r * cosine, 4) + ", y = " + digits(r * sine, 4); }
};

InputError refusal(const std::string& key, const std::string& problem, const std::string& allowed) {
  return InputError({.key = key, .problem = problem, .allowed = allowed});
}

/// Distance of the end of the held region around the origin.
double wall_of(const StartRay& ray) {
  std::size_t last = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    if (!ray.held(ray.at(i))) continue;
    if (i > last + 1 || (last == 0 && i > 0 && !ray.held(0)))
      throw refusal("fixed", "the held region at " + ray.place(ray.at(i)) + " is not around the origin",
                    "a star-shaped region around the origin");
    last = i;
  }
  if (!ray.held(0)) return 0;
  return bisected({.holding = ray.at(last), .failing = ray.at(last + 1)}, [&](double r) { return ray.held(r); })
      .failing;
}

/// Checks that the slip never rises along the ray, and falls to 0.
void check_ray(const StartRay& ray, double wall, double top) {
  double before = top;
  for (std::size_t i = 0; i <= samples; ++i) {
    const double r = ray.at(i);
    if (r < wall) continue;
    const double slip = ray.slip(r);
    if (!(slip >= 0 && std::isfinite(slip)))
      throw refusal("slip", "the slip is " + digits(slip) + " at " + ray.place(r), "a finite number >= 0");
    if (slip > before * (1 + 1e-6))
      throw refusal("slip", "the slip rises away from the origin at " + ray.place(r),
                    "a slip that falls in each direction");
    before = slip;
  }
  if (before > outermost_slip * top)
    throw refusal("slip", "the slip is " + digits(before) + " at the edge of the domain, " + ray.place(ray.end),
                  "a slip that falls to 0 inside the domain");
}

/// Distance at which the slip of the ray falls through `level`, outside `wall`.
double distance_of(const StartRay& ray, double wall, double level) {
  const Ends ends = bisected(
      {.holding = wall, .failing = ray.end}, [&](double r) { return ray.slip(r) > level; }, 50);
  return (ends.holding + ends.failing) / 2;
}

void find_ray(const Problem& problem, std::size_t k, double top, Loops& loops) {
  const StartRay ray(problem, loops.angle(k));
  const double wall = wall_of(ray), on_wall = ray.slip(wall);
  if (!(std::fabs(on_wall - top) <= 1e-4 * top))
    throw refusal("slip",
                  "the slip at the held region is " + digits(on_wall) + " at " + ray.place(wall) + ", but " +
                      digits(top) + " elsewhere",
                  "the same slip around the held region");
  check_ray(ray, wall, std::max(top, on_wall));
  loops.wall[k] = wall;
  const double least = std::min(outermost_slip * top, std::numbers::pi / 2 * loops.label[1]);  // below the second line
  for (std::size_t j = 0; j <= loops.rows; ++j) {
    const double level = std::max(2 * std::numbers::pi * loops.label[j], least);
    const bool innermost = j == loops.rows;
    loops.r[j * loops.angles + k] =
        innermost && wall > 0 ? wall : distance_of(ray, wall, innermost ? top * (1 - outermost_slip) : level);
  }
}

}  // namespace

Loops initial_loops(const Problem& problem, std::size_t rows, std::size_t angles) {
  if (!(problem.left < 0 && problem.right > 0 && problem.bottom < 0 && problem.top > 0))
    throw refusal("left", "the origin is not inside the domain", "left < 0 < right and bottom < 0 < top");
  Loops loops;
  loops.rows = rows;
  loops.angles = angles;
  const StartRay first(problem, 0);
  const double top = first.slip(wall_of(first));
  if (!(top > 0)) throw refusal("slip", "there is no slip around the origin", "a slip > 0 there");
  const double number = top / (2 * std::numbers::pi), count = static_cast<double>(rows);
  loops.label.resize(rows + 1);
  // Narrow cells at the front, where the density varies as a logarithm, and at the top of a slip without a held region.
  const bool held = wall_of(first) > 0;
  for (std::size_t j = 0; j <= rows; ++j) {
    const double share = static_cast<double>(j) / count;
    loops.label[j] = number * share * share * (held ? 1 : 3 - 2 * share);
  }
  loops.wall.assign(angles, 0);
  loops.r.assign((rows + 1) * angles, 0);
  loops.momentum.assign(rows * angles, 0);
  loops.s.assign(rows * angles, 0.3);
  for (std::size_t k = 0; k < angles; ++k) find_ray(problem, k, top, loops);
  return loops;
}

using std::numbers::pi;

namespace {

constexpr std::size_t fewest = 4;  ///< rows that the interpolation between them needs

class AveragedSolver : public Solver {
 public:
  AveragedSolver(const Problem& p, const Resolution& resolution)
      : problem_(p),
        loops_(initial_loops(problem_, static_cast<std::size_t>(resolution.loops),
                             static_cast<std::size_t>(resolution.angles))),
        steps_(std::in_place, problem_, loops_),
        volume_at_start_(volume(loops_)) {
    steps_->look();
    elastic_at_start_ = energy(loops_, steps_->equations()).elastic;
  }

  const Problem& problem() const override { return problem_; }
  double time() const override { return loops_.time; }
  long steps() const override { return loops_.steps; }

  bool advance_to(double time, const std::function<bool()>& interrupted) override {
    while (loops_.time < time) {
      steps_->take(time);
      check_front();
      remove_vanished();
      if (interrupted && interrupted()) break;
    }
    if (loops_.time < time) return false;
    steps_->look();
    constexpr double noise = 1e-6;  // fraction of the energy at the start
    check_budget(energies(), noise * elastic_at_start_, time, "friction is too strong for this number of cells");
    return true;
  }

  StepsAhead steps_ahead(double duration) const override { return steps_->ahead(duration); }

  std::vector<double> slip(const std::vector<Point>& points) const override {
    std::vector<double> slips;
    slips.reserve(points.size());
    for (const Point& at : points) slips.push_back(slip_now(at) - problem_.slip(at.x, at.y));
    return slips;
  }

  std::vector<double> velocity(const std::vector<Point>& points) const override {
    const std::vector<double> w = slip_velocities(loops_, steps_->equations());
    std::vector<double> velocities;
    velocities.reserve(points.size());
    for (const Point& at : points)
      velocities.push_back(Ray(loops_, std::atan2(at.y, at.x)).at(w, std::hypot(at.x, at.y)));
    return velocities;
  }

  Field field(int nx, int ny) const override {
    const Problem& p = problem_;
    SlipAtStart& start = start_;
    const std::vector<double> w = slip_velocities(loops_, steps_->equations());
    Field field{.time = time(), .nx = nx, .ny = ny, .slip = {}, .velocity = {}};
    std::vector<double> at_start;
    const bool known = start.nx == nx && start.ny == ny;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const Point at{p.left + (p.right - p.left) * (i + 0.5) / nx, p.bottom + (p.top - p.bottom) * (j + 0.5) / ny};
        if (!known) at_start.push_back(p.slip(at.x, at.y));
        const Ray ray(loops_, std::atan2(at.y, at.x));
        const double r = std::hypot(at.x, at.y);
        field.slip.push_back(2 * pi * ray.loops_outside(r));
        field.velocity.push_back(ray.at(w, r));
      }
    if (!known) start = {nx, ny, std::move(at_start)};
    for (std::size_t i = 0; i < field.slip.size(); ++i) field.slip[i] -= start.slip[i];
    return field;
  }

  std::vector<Line> lines() const override {
    constexpr std::size_t fewest_points = 64;
    const Loops& loops = loops_;
    const std::size_t points = std::max(loops.angles, fewest_points);
    Line front{.number = 1, .points = {}};
    for (std::size_t k = 0; k <= points; ++k) {
      const double angle = 2 * pi * static_cast<double>(k % points) / static_cast<double>(points);
      const double r = Ray(loops, angle).face(0);
      front.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return {front};
  }

  double potency() const override { return volume(loops_) - volume_at_start_; }

  double potency_rate() const override {
    const Loops& loops = loops_;
    const LoopEquations& equations = steps_->equations();
    double rate = 0;
    for (std::size_t i = 0; i < loops.cells(); ++i)
      rate += 2 * pi * equations.velocity()[i] * equations.middle(i) * loops.charge(i / loops.angles) * loops.turn();
    return rate;
  }

  double front(double y_scale) const override {
    const Loops& loops = loops_;
    double farthest = 0;
    for (std::size_t k = 0; k < loops.angles; ++k)
      farthest =
          std::fmax(farthest, loops.r[k] * std::hypot(std::cos(loops.angle(k)), y_scale * std::sin(loops.angle(k))));
    return farthest;
  }

  Energies energies() const override {
    const Loops& loops = loops_;
    const LoopEnergy now = energy(loops, steps_->equations());
    return {.kinetic = now.kinetic,
            .elastic = now.elastic - elastic_at_start_,
            .dissipated = loops.dissipated,
            .supplied = loops.supplied,
            .vanished = loops.vanished,
            .radiated = 0};
  }

  std::vector<std::string> warnings() const override {
    const Loops& loops = loops_;
    if (loops.vanished == 0) return {};
    return {"dislocation lines have shrunk to the origin since t = " + digits(loops.vanished_since, 4) +
            ". In the full equation they pass through each other there and return with the opposite sign, which these "
            "averages do not follow: results are wrong closer to the origin than " +
            digits(loops.time - loops.vanished_since, 4)};
  }

  void archive(Archive& a) override {
    Loops now = loops_;
    std::size_t rows = now.rows;
    a(rows);
    while (now.rows > std::max(rows, fewest)) now.remove_innermost();
    a.require(now.rows == rows);
    a(now.time, now.steps, now.limit, now.power, now.supply, now.dissipated, now.supplied, now.vanished,
      now.vanished_since);
    a.fixed(now.r, now.momentum, now.s, now.loss);
    if (!a.reads()) return;
    loops_ = now;
    steps_.emplace(problem_, loops_);
    loops_.loss = now.loss;
    steps_->look();  // for observers
    loops_ = now;
  }

 private:
  Problem problem_;
  Loops loops_;
  std::optional<LoopSteps> steps_;
  double volume_at_start_, elastic_at_start_ = 0;
  /// The initial slip in the cells of the last field, because a formula takes longer than all else.
  mutable struct SlipAtStart {
    int nx = 0, ny = 0;
    std::vector<double> slip;
  } start_;

  double slip_now(const Point& at) const {
    return 2 * pi * Ray(loops_, std::atan2(at.y, at.x)).loops_outside(std::hypot(at.x, at.y));
  }

  /// The front must stay inside the domain, because the averaged solver has no boundary there.
  void check_front() const {
    for (std::size_t k = 0; k < loops_.angles; ++k) {
      const double x = loops_.r[k] * std::cos(loops_.angle(k)), y = loops_.r[k] * std::sin(loops_.angle(k));
      if (x > problem_.left && x < problem_.right && y > problem_.bottom && y < problem_.top) continue;
      throw NumericsError("t = " + digits(loops_.time) + ", x = " + digits(x, 4) + ", y = " + digits(y, 4) +
                          ": the front has reached the edge of the domain, where the averaged solver ends");
    }
  }
  /// A loop that shrinks to a point vanishes, and its energy leaves as waves. We remove the innermost cells as they
  /// reach the origin.
  void remove_vanished() {
    while (loops_.innermost_vanishes()) {
      if (loops_.rows <= fewest)
        throw NumericsError("t = " + digits(loops_.time) + ": nearly all dislocation lines have shrunk and vanished");
      const LoopEnergy before = energy(loops_, steps_->equations());
      loops_.remove_innermost();
      steps_.emplace(problem_, loops_);
      steps_->look();
      const LoopEnergy now = energy(loops_, steps_->equations());
      if (loops_.vanished == 0) loops_.vanished_since = loops_.time;
      loops_.vanished += before.elastic + before.kinetic - now.elastic - now.kinetic;
    }
  }
};

}  // namespace

std::unique_ptr<Solver> loops_solver(const Problem& problem, const Resolution& resolution) {
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
  return std::make_unique<AveragedSolver>(problem, resolution);
}

}  // namespace slipfront::plane
