#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <string>

#include "commands.hpp"
#include "computed.hpp"
#include "slipfront/friction/ratio/table.hpp"

namespace slipfront::friction_ratio {

namespace {

using friction::Closure;

/// Largest relative difference from the solver, where the table is certified and where it is not.
struct Worst {
  Logarithms error{};
  double stress = 0, damping = 0;
  std::size_t points = 0;
  void take(const Logarithms& e, double at_stress, double at_damping) {
    ++points;
    if (*std::max_element(e.begin(), e.end()) > *std::max_element(error.begin(), error.end()))
      stress = at_stress, damping = at_damping;
    for (std::size_t m = 0; m < layout::measures; ++m) error[m] = std::fmax(error[m], e[m]);
  }
};

/// Relative differences of the table from the solver; infinite where one of them is no number.
Logarithms differences(Closure closure, double stress, double damping) {
  const Logarithms from_solver = computed(closure, stress, damping);
  Logarithms error{};
  for (std::size_t m = 0; m < layout::measures; ++m) {
    const double ours = evaluate(static_cast<SlipVelocityKind>(m), closure, stress, damping).value;
    error[m] = std::fabs(ours / std::exp(from_solver[m]) - 1);
    if (std::isnan(error[m])) error[m] = HUGE_VAL;
  }
  return error;
}

/// Prints the largest differences. Returns whether they are within what the table states.
bool report(const Worst& w, Closure closure, bool unstable) {
  if (w.points == 0) return true;
  const double allowed = uncertainty(closure, w.damping), largest = *std::max_element(w.error.begin(), w.error.end());
  std::printf(
      "%s%s: %zu points, largest relative difference: origin %.1e, mean %.1e, peak %.1e, time-mean %.1e (at stress "
      "%.4g, damping number %.4g), allowed %.0e\n",
      closure == Closure::paper ? "paper" : "consistent", unstable ? ", unstable range" : "", w.points, w.error[0],
      w.error[1], w.error[2], w.error[3], w.stress, w.damping, allowed);
  return largest <= allowed;
}

}  // namespace

int check(long points) {
  bool good = true;
  for (const Closure closure : closures) {
    Worst worst[2];
    std::string failed;
#pragma omp parallel for schedule(dynamic)
    for (long n = 0; n < points; ++n) {
      std::mt19937_64 random(static_cast<std::uint64_t>(n));
      const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
      const double stress = layout::least_stress * std::pow(layout::most_stress / layout::least_stress, uniform());
      const double damping = std::expm1(uniform() * std::log1p(layout::most_damping));
      try {
        const Logarithms error = differences(closure, stress, damping);
#pragma omp critical
        worst[uncertainty(closure, damping) > 1e-4 ? 1 : 0].take(error, stress, damping);
      } catch (const std::exception& error) {
#pragma omp critical
        failed = error.what();
      }
    }
    for (int u = 0; u < 2; ++u) good = report(worst[u], closure, u == 1) && good;
    if (!failed.empty()) {
      std::printf("failed: %s\n", failed.c_str());
      good = false;
    }
  }
  return good ? 0 : 1;
}

}  // namespace slipfront::friction_ratio
