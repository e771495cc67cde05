#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;

pulse::Problem tanh_step(int cells, friction::Closure closure) {
  return {.stress = [](double x) { return 0.179 + 0.676 * (1 - std::tanh(x)) / 2; },
          .forcing = {},
          .friction = friction::viscous(0.5, closure),
          .left = -7.5,
          .right = 5.5,
          .corner = HUGE_VAL,
          .cells = cells};
}

/// The case "tanh width 1, C = 0.5" of docs/pulse.md to t = 2 pi. The label shows the resulting W(0).
void pulse_tanh(benchmark::State& state) {
  const pulse::Problem problem = tanh_step(static_cast<int>(state.range(0)), friction::Closure::consistent);
  double W = 0;
  long steps = 0;
  for (auto _ : state) {
    pulse::Solver solver(problem);
    solver.advance_to(2 * std::numbers::pi);
    W = train::averages(state_at(solver.view(), 0)).W;
    steps = solver.cells().steps;
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * steps * 5);
  state.SetLabel("W(0) = " + std::to_string(W) + ", cell stages a second");
}
BENCHMARK(pulse_tanh)->Arg(50)->Arg(75)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

/// The state of a cell from its conserved quantities, which is the costliest part of a cell. The first guess has an
/// error of 1 %, as from one stage to the next.
void solve_state(benchmark::State& state) {
  const auto c = modulation::lagrangian_state({0.1, 0.05});
  for (auto _ : state) benchmark::DoNotOptimize(modulation::solve_state(c, 0.0505));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(solve_state);

/// Friction so strong that the pulse diffuses and the steps are implicit.
void pulse_overdamped(benchmark::State& state) {
  const double gamma = static_cast<double>(state.range(0));
  pulse::Problem problem{.stress = [](double x) { return x < 0 ? 0.855 : 0.0; },
                         .forcing = {},
                         .friction = friction::viscous(gamma / (2 * std::numbers::pi)),
                         .left = -20 / std::sqrt(gamma),
                         .right = 20 / std::sqrt(gamma),
                         .cells = 100};
  long steps = 0;
  for (auto _ : state) {
    pulse::Solver solver(problem);
    solver.advance_to(2 * std::numbers::pi);
    steps = solver.cells().steps;
  }
  state.SetLabel(std::to_string(steps) + " steps");
}
BENCHMARK(pulse_overdamped)->Arg(1000)->Arg(1000000)->Arg(100000000)->Unit(benchmark::kMillisecond);

constexpr const char* step_of_stress = "[initial]\nprofile = 'step'\nstress_left = 0.855\nstress_right = 0\n";

struct LawCase {
  const char* name;
  std::vector<std::string> friction;  ///< keys and values
};
const std::vector<LawCase>& law_cases() {
  static const std::vector<std::string> places{
      "strength=0.05",      "reference_velocity=0.05", "characteristic_slip=0.05",
      "direct_effect=0.01", "evolution_effect=0.015",  "law=rate-and-state"};
  static const std::vector<LawCase> cases = [] {
    std::vector<std::string> by_slip = places;
    by_slip.emplace_back("state=slip");
    return std::vector<LawCase>{
        {"viscous", {"law=viscous", "coefficient=0.1"}},
        {"rate-and-state", places},
        {"rate-and-state, slip law", by_slip},
        {"slip-weakening", {"law=slip-weakening", "strength=0.08", "residual=0.02", "characteristic_slip=0.1"}},
        {"slip-weakening, weak", {"law=slip-weakening", "strength=0.04", "residual=0", "characteristic_slip=0.05"}},
        {"formula", {"law=formula", "formula=0.5*w/(1+w)"}},
        {"formula, steep", {"law=formula", "formula=0.1*sqrt(w)"}},
        {"formula, n-shaped", {"law=formula", "formula=0.1*(w/0.05)/(1+(w/0.05)^2)"}},
        {"n-shaped", {"law=n-shaped", "coefficient=0.1", "velocity=0.05"}},
        {"coulomb", {"law=coulomb", "coefficient=0.03"}},
        {"power", {"law=power", "coefficient=0.1", "exponent=0.5"}}};
  }();
  return cases;
}

/// A step of stress with 400 cells to t = 2 pi with each kind of friction.
void pulse_laws(benchmark::State& state) {
  const LawCase& law = law_cases()[static_cast<std::size_t>(state.range(0))];
  std::vector<std::string> settings{"pulse.cells=400"};
  for (const std::string& setting : law.friction) settings.push_back("friction." + setting);
  const scenario::Scenario scenario = scenario::read_scenario(step_of_stress, "step", settings, {});
  const pulse::Problem problem = scenario::pulse_problem(scenario);
  double slip = 0;
  long steps = 0;
  for (auto _ : state) {
    pulse::Solver solver(problem);
    solver.advance_to(scenario.end);
    slip = solver.slip_at(solver.view(), 0);
    steps = solver.cells().steps;
  }
  state.SetLabel(std::string(law.name) + ": slip(0) = " + std::to_string(slip) + ", " + std::to_string(steps) +
                 " steps");
}
BENCHMARK(pulse_laws)->DenseRange(0, 10)->Unit(benchmark::kMillisecond);

}  // namespace
