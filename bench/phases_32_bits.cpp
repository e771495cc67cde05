// Compares a chain with phases of 32 bits with the chain in doubles (docs/chain.md, "Phases in 32 bits"): speed,
// differences and energy. Usage: phases_32_bits [LARGEST_SCALE], by default 1000.
//
// Problems: a train at rest with a step of stress 0.855 into an empty interface, to t = 2 pi, and a kink with U = 0.5.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/averages.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "math/constants.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;

/// The state of a chain at one time.
struct Seen {
  double slip, energy;
  std::vector<Dislocation> dislocations;
};

struct Course {
  std::vector<Seen> seen;
  double drift = 0;  ///< largest |energy + dissipated - energy at the start| over the latter
};

Course follow(Problem p, bool phases_of_32_bits, const MotionOf& start, long steps, double width) {
  p.phases_of_32_bits = phases_of_32_bits;
  ExplicitChain chain(p, start);
  const auto see = [&] {
    return Seen{average_displacement(chain, 0, width, chain.time()), totals(chain).energy(), dislocations(chain)};
  };
  Course c{{see()}};
  constexpr long outputs = 32;
  for (long i = 1; i <= outputs; ++i) {
    chain.advance(steps * i / outputs - chain.steps());
    c.seen.push_back(see());
    const double now = c.seen.back().energy + chain.flows().dissipated;
    c.drift = std::fmax(c.drift, std::fabs(now / c.seen[0].energy - 1));
  }
  return c;
}

/// Prints the largest differences from doubles over all outputs.
void compare(const std::string& name, const Problem& p, const MotionOf& start, long steps, double width, double scale) {
  const Course exact = follow(p, false, start, steps, width), c = follow(p, true, start, steps, width);
  double slip = 0, energy = 0, any = 0;
  const double final_slip = std::fabs(exact.seen.back().slip - exact.seen[0].slip);
  for (std::size_t i = 0; i < c.seen.size(); ++i) {
    const Seen &a = c.seen[i], &b = exact.seen[i];
    slip = std::fmax(slip, std::fabs(a.slip - b.slip) / final_slip);
    energy = std::fmax(energy, std::fabs(a.energy / b.energy - 1));
    if (a.dislocations.size() != b.dislocations.size()) any = INFINITY;
    for (std::size_t k = 0; std::isfinite(any) && k < a.dislocations.size(); ++k)
      any = std::fmax(any, std::fabs(a.dislocations[k].x - b.dislocations[k].x) / scale);
  }
  std::printf("%-28s %8ld %8.1e %8.1e %8.1e %8.1e (%7.1e)\n", name.c_str(), steps, slip, any, energy, c.drift,
              exact.drift);
  std::fflush(stdout);
}

Problem problem(double left, double right, double C) {
  Problem p;
  p.grid = {left, default_spacing, static_cast<std::size_t>((right - left) / default_spacing) + 1};
  p.boundary.left = p.boundary.right = End::fixed;
  if (C > 0) p.friction = friction::viscous(C);
  return p;
}

double step_of_stress(double x) { return x < 0 ? 0.855 : 0.0; }

void follow_step(double scale, double C) {
  const Problem p = problem(-6 * scale, 6 * scale, C / scale);
  const std::string name = "step, scale " + std::to_string(std::lround(scale)) + (C > 0 ? ", viscous" : "");
  compare(name, p, StaticTrain(step_of_stress, p.grid), std::lround(turn * scale / chosen_step(p)), turn / 0.855,
          scale);
}

void follow_kink(long steps) {
  constexpr double U = 0.5;
  const double path = U * default_spacing * static_cast<double>(steps), g = 1 / std::sqrt(1 - U * U);
  const Problem p = problem(-100, path + 100, 0);
  const auto kink = [&](std::size_t begin, std::size_t end) {
    Motion m;
    for (std::size_t j = begin; j < end; ++j) {
      const double x = p.grid.x(j);
      m.u.push_back(4 * std::atan(std::exp(-g * x)));
      m.velocity.push_back(2 * g * U / std::cosh(g * x));
    }
    return m;
  };
  compare("kink", p, kink, steps, 10, path);
}

/// Prints site updates a second. Doubles and phases take turns; the least time of each counts.
void print_speeds(std::size_t sites, double C) {
  const double reach = default_spacing * static_cast<double>(sites) / 2;
  Problem p = problem(-reach, reach, C);
  const StaticTrain train(step_of_stress, p.grid);
  ExplicitChain doubles(p, train);
  p.phases_of_32_bits = true;
  ExplicitChain phases(p, train);
  const long steps = 32 * std::max(1L, 1000000 / static_cast<long>(sites));
  const auto rate = [&](double time) { return static_cast<double>(steps) * static_cast<double>(sites) / time / 1e9; };
  double least[] = {INFINITY, INFINITY};
  for (int run = 0; run < 41; ++run)
    for (const int i : {0, 1}) {
      const auto start = std::chrono::steady_clock::now();
      (i == 0 ? doubles : phases).advance(steps);
      least[i] = std::min(least[i], std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  std::printf("%8zu sites, %-9s %8.2f %8.2f (%4.2f)\n", sites, C > 0 ? "viscous" : "", rate(least[0]), rate(least[1]),
              least[0] / least[1]);
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 1000;
  std::printf("G site updates a second on one core: doubles, phases (ratio)\n");
  for (const std::size_t sites : {1400u, 10000u, 1000000u})
    for (const double C : {0.0, 1e-3}) print_speeds(sites, C);
  std::printf(
      "\nLargest differences from doubles over 32 outputs: slip over the final slip, position of any dislocation over\n"
      "the scale or the path, energy; and the largest error of the energy budget (that of doubles)\n%-28s %8s %8s %8s "
      "%8s %8s\n",
      "", "steps", "slip", "any", "energy", "budget");
  for (const double scale : {100.0, 300.0, 1000.0, 3000.0})
    for (const double C : {0.0, 0.5})
      if (scale <= largest) follow_step(scale, C);
  for (const long steps : {1000, 10000, 100000}) follow_kink(steps);
}
