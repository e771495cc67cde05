#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::chain;
using std::numbers::pi;

struct StabilityCase {
  double left, right, scale;
  End ends;
  bool periodic = false;
  Model model = Model::sine_gordon;
};

std::string name_of(const StabilityCase& c) {
  const char* ends = c.periodic ? "ring" : c.ends == End::free ? "free" : c.ends == End::fixed ? "fixed" : "absorbing";
  return std::to_string(c.left) + " to " + std::to_string(c.right) + ", scale " + std::to_string(c.scale) + ", " + ends;
}

/// The drift of the energy of a step of stress, ends so near that what leaves the step meets them.
double drift_of(const StabilityCase& c, double end = 2 * pi) {
  ScaledProblem s;
  s.scale = c.scale;
  s.left = -end / 2;
  s.right = end / 2;
  s.stress = [c](double x) { return x < 0 ? c.left : c.right; };
  s.boundary = {.left = c.ends, .right = c.ends, .periodic = c.periodic};
  s.model = c.model;
  s.spacing = (c.model == Model::lattice ? 0.3 : default_spacing) / std::cosh(train::psi_of_stress(c.left));
  Run run(s, {.times = {0, end}, .x_edges = {s.left, 0, s.right}}, {});
  run.go();
  return run.balance().energy_drift;
}

/// Trains dense and dilute, run into each other and into their mirror images: no wave grows. At the step of the linear
/// limit all but the lattice end with up to 20 times the energy more in the cases tried. The points are of the map that
/// bench/chain_stability makes (docs/chain.md).
TEST(ChainStability, EnergyDoesNotGrow) {
  for (const StabilityCase& c :
       {StabilityCase{2, 0, 1000, End::fixed}, StabilityCase{0.855, 0.179, 500, End::free},
        StabilityCase{1.5, 0, 400, End::free}, StabilityCase{6, 1, 200, End::free},
        StabilityCase{3, 0.5, 300, End::free}, StabilityCase{0.3, 0.1, 300, End::free},
        StabilityCase{1.6, 0, 300, End::fixed, true}, StabilityCase{4, 4.0 / 3, 100, End::fixed, true},
        StabilityCase{1.3, 0, 300, End::absorbing}, StabilityCase{3, 1, 100, End::absorbing},
        StabilityCase{0.855, 0, 100, End::free, false, Model::lattice}})
    EXPECT_LT(drift_of(c), 5e-3) << name_of(c);
}

}  // namespace
