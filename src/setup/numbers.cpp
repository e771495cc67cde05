#include "slipfront/setup/numbers.hpp"

#include <cmath>
#include <numbers>

#include "slipfront/setup/problem.hpp"

namespace slipfront::setup {
namespace {

constexpr double pi = std::numbers::pi;

void add_rate_and_state(const scenario::Scenario& s, Numbers& n) {
  const double f0 = s.friction.parameter("strength"), a = s.friction.parameter("direct_effect"),
               b = s.friction.parameter("evolution_effect"), slip = s.friction.parameter("characteristic_slip");
  if (a > 0) n.strength_over_direct_effect = f0 / a;
  if (!(b > a && slip > 0)) return;  // steady sliding is stable
  const double v = s.loading.acts() ? s.loading.velocity : 0;
  const double critical = (b - a) / slip * (1 + (a > 0 ? v * v / (a * slip) : 0));
  n.critical_stiffness = critical;
  const bool everywhere = s.loading.acts() && s.loading.where == chain::Pulled::everywhere;
  const double stiffness = everywhere ? s.loading.stiffness : 0;
  if (everywhere) n.stiffness_ratio = stiffness / critical;
  if (stiffness < critical) n.nucleation_length = 2 * pi / std::sqrt(critical - stiffness);
}

}  // namespace

Numbers numbers_of(const scenario::Scenario& s) {
  Numbers n;
  if (s.friction.name() == "rate-and-state") add_rate_and_state(s, n);
  if (s.plane) return n;
  const pulse::Problem problem = stated_problem(s);
  n.length = problem.right - problem.left;
  if (!s.substrate) return n;
  constexpr int samples = 10000;  // midpoint rule
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += s.stress(problem.left + *n.length * (i + 0.5) / samples);
  n.dislocations = sum / samples * *n.length / (2 * pi);
  return n;
}

}  // namespace slipfront::setup
