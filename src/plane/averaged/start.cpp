#include <algorithm>
#include <string>

#include "foundation/math/roots.hpp"
#include "foundation/text/digits.hpp"
#include "plane/averaged/loops.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {
namespace {

constexpr std::size_t samples = 2000;  ///< points of a ray on which the contours are found first
constexpr double whole = 1e-6;         ///< fraction of the slip at which the outermost line is found

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
  if (before > whole * top)
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
  const double least = std::min(whole * top, std::numbers::pi / 2 * loops.label[1]);  // below the second line
  for (std::size_t j = 0; j <= loops.rows; ++j) {
    const double level = std::max(2 * std::numbers::pi * loops.label[j], least);
    const bool innermost = j == loops.rows;
    loops.r[j * loops.angles + k] =
        innermost && wall > 0 ? wall : distance_of(ray, wall, innermost ? top * (1 - whole) : level);
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

}  // namespace slipfront::plane
