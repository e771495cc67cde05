// Measures how well the time step of the chain conserves energy: the largest drift for many densities, ends, spacings
// and scales (docs/chain.md, "Stability"). Each run has a stress on the left of x = 0. The stress on the right is zero,
// a third of it, or equal to it. The ends are so near that all waves from x = 0 reach them.
//
// Usage: chain_stability [--mass M0 M1] [--quick] [--only ENDS] [--stress K]... [--spacing H]... [--scale S]...
// With --mass the step is that for mass^2 = M0 a^2 + M1 a k, where k is the largest stress (chain/model/problem.cpp),
// instead of the default. The program prints tables in Markdown, one per spacing: the largest drift over all scales and
// right-hand stresses, with one row per stress and one column per kind of end. Drifts of 1e-2 or more are in bold. A
// run may end early with a NumericsError; a drift that is not a number then counts as infinite.

#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
constexpr double pi = std::numbers::pi;

struct Kind {
  const char* name;
  End ends;
  bool periodic = false;
  std::function<double(double, double)> forcing = {};
  std::function<double(double)> contact = {};
};

struct Mass {
  double fixed, crossing;  // mass^2 = fixed a^2 + crossing a k; if `fixed` is negative, the library chooses the step
};

struct Outcome {
  double drift;
  long steps;
};

Outcome run(const Kind& kind, double stress, double right, double scale, double spacing, Mass mass) {
  ScaledProblem s;
  s.scale = scale;
  s.left = -pi;
  s.right = pi;
  s.stress = [=](double x) { return x < 0 ? stress : right; };
  s.boundary = {.left = kind.ends, .right = kind.ends, .periodic = kind.periodic};
  s.forcing = kind.forcing;
  s.contact = kind.contact;
  s.end = 2 * pi;
  const double a = kind.contact ? 1.2 : 1, h = spacing / (a * std::cosh(train::psi_of_stress(stress / a)));
  s.spacing = h;
  if (mass.fixed >= 0)
    s.step = 1 / std::sqrt(1 / (h * h) + a * a / 12 + (mass.fixed * a * a + mass.crossing * a * stress) / 4);
  Run chain(s, {.times = {0, pi / 2, pi, 3 * pi / 2, 2 * pi}, .x_edges = {s.left, 0, s.right}}, {});
  double drift = 0;
  try {
    chain.go();
    drift = chain.balance().energy_drift;
  } catch (const NumericsError& error) {
    drift = chain.balance().energy_drift;
    if (std::isnan(drift)) drift = std::numeric_limits<double>::infinity();
    std::fprintf(stderr, "%s, stress %g to %g, scale %g, spacing %g: %s\n", kind.name, stress, right, scale, spacing,
                 error.what());
  }
  return {drift, chain.chain().steps()};
}

/// The largest drift of the energy for each stress (rows) and kind of chain (columns).
void print_table(const std::vector<Kind>& kinds, const std::vector<double>& stresses, const std::vector<double>& scales,
                 double spacing, const Mass& mass) {
  std::printf("\nh = %g\n\n| stress |", spacing);
  for (const Kind& kind : kinds) std::printf(" %s |", kind.name);
  std::printf("\n|---|");
  for (std::size_t i = 0; i < kinds.size(); ++i) std::printf("---|");
  std::printf("\n");
  long steps = 0;
  for (const double stress : stresses) {
    std::printf("| %g |", stress);
    for (const Kind& kind : kinds) {
      double worst = 0;
      for (const double scale : scales)
        for (const double share : {0.0, 1.0 / 3, 1.0}) {
          // A ring with a step to zero stress has a second such step at its ends. With equal stresses, nothing moves.
          const Outcome one = run(kind, stress, share * stress, scale, spacing, mass);
          worst = std::fmax(worst, one.drift);
          steps += one.steps;
        }
      std::printf(worst >= 1e-2 ? " **%.0e** |" : " %.0e |", worst);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  std::printf("\nsteps: %ld\n", steps);
}

}  // namespace

int main(int argc, char** argv) {
  Mass mass{-1, 0};
  const char* only = nullptr;
  std::vector<double> spacings, scales, stresses;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--mass") == 0 && i + 2 < argc) {
      mass = {std::stod(argv[i + 1]), std::stod(argv[i + 2])};
      i += 2;
    } else if (std::strcmp(argv[i], "--spacing") == 0 && i + 1 < argc) {
      spacings.push_back(std::stod(argv[++i]));
    } else if (std::strcmp(argv[i], "--scale") == 0 && i + 1 < argc) {
      scales.push_back(std::stod(argv[++i]));
    } else if (std::strcmp(argv[i], "--stress") == 0 && i + 1 < argc) {
      stresses.push_back(std::stod(argv[++i]));
    } else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
      only = argv[++i];
    } else if (std::strcmp(argv[i], "--quick") == 0) {
      stresses = {0.3, 0.855, 1.6, 3, 6};
    } else {
      std::fprintf(stderr,
                   "usage: chain_stability [--mass M0 M1] [--quick] [--only ENDS] [--stress K]... [--spacing H]... "
                   "[--scale S]...\n");
      return 2;
    }
  }
  if (spacings.empty()) spacings = {default_spacing, 0.5};
  if (stresses.empty()) stresses = {0.3, 0.5, 0.7, 0.855, 1.03, 1.3, 1.6, 2, 2.5, 3, 4, 6};
  if (scales.empty()) scales = {100, 300, 900};
  const auto wave = [](double x) { return 1 + 0.2 * std::sin(2 * x); };
  const auto push = [](double x, double t) { return 0.5 * std::cos(2 * x) * std::cos(3 * t); };
  std::vector<Kind> kinds{{"fixed", End::fixed},
                          {"ring", End::fixed, true},
                          {"free", End::free},
                          {"absorbing", End::absorbing},
                          {"fixed, F", End::fixed, false, push},
                          {"fixed, a", End::fixed, false, {}, wave}};
  if (only != nullptr) std::erase_if(kinds, [&](const Kind& kind) { return std::strcmp(kind.name, only) != 0; });
  for (const double spacing : spacings) {
    print_table(kinds, stresses, scales, spacing, mass);
  }
}
