#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <string>

#include "commands.hpp"
#include "computed.hpp"
#include "front_computed.hpp"
#include "slipfront/friction/ratio/table.hpp"

namespace slipfront::friction_ratio {

namespace {

using friction::Closure;

/// Largest relative difference of a quantity from the solver, and where it is.
struct Worst {
  double error = 0, stress = 0, damping = 0, threshold = 0;
  void take(double table, double solver, const Worst& at) {
    const double found = std::fabs(table / solver - 1);
    if (!(found <= error)) *this = at, error = std::isnan(found) ? HUGE_VAL : found;
  }
};

/// The front, and both stress drops.
using Differences = std::array<Worst, 1 + front_layout::drops>;

void compare(Closure closure, const Worst& at, Differences& worst) {
  const FrontAndDrops solved = front_and_drops(closure, at.stress, at.damping, {at.threshold});
  worst[0].take(front_ratio(closure, at.stress, at.damping, at.threshold).value, solved.fronts[0], at);
  const FrontAndDrops without_front = front_and_drops(closure, at.stress, at.damping, {});
  for (std::size_t d = 0; d < front_layout::drops; ++d)
    worst[1 + d].take(stress_drop_share(static_cast<Drop>(d), closure, at.stress, at.damping).value,
                      without_front.drops[d], at);
}

/// Prints the largest differences. Returns whether they are within what the tables state.
bool report(const Differences& worst, Closure closure, bool unstable) {
  bool good = true;
  const char* names[] = {"front", "stress drop at the origin", "mean stress drop"};
  for (std::size_t n = 0; n < worst.size(); ++n) {
    const Worst& w = worst[n];
    const double allowed = n == 0 ? front_uncertainty(closure, w.damping) : stress_drop_uncertainty(closure, w.damping);
    std::printf(
        "%s%s, %s: largest relative difference %.1e (at stress %.4g, damping number %.4g, threshold %.2g), "
        "allowed %.0e\n",
        closure == Closure::paper ? "paper" : "consistent", unstable ? ", unstable range" : "", names[n], w.error,
        w.stress, w.damping, w.threshold, allowed);
    good = good && w.error <= allowed;
  }
  return good;
}

}  // namespace

int check_front(long points) {
  bool good = true;
  for (const Closure closure : closures) {
    Differences worst[2];
    std::string failed;
#pragma omp parallel for schedule(dynamic)
    for (long n = 0; n < points; ++n) {
      std::mt19937_64 random(static_cast<std::uint64_t>(n));
      const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
      Worst at;
      at.stress = layout::least_stress * std::pow(layout::most_stress / layout::least_stress, uniform());
      at.damping = std::expm1(uniform() * std::log1p(layout::most_damping));
      at.threshold = std::exp(front_layout::of_threshold().at(2 * uniform() - 1));
      try {
        Differences here;
        compare(closure, at, here);
#pragma omp critical
        for (std::size_t i = 0; i < here.size(); ++i) {
          Worst& w = worst[uncertainty(closure, at.damping) > 1e-3 ? 1 : 0][i];
          if (here[i].error > w.error) w = here[i];
        }
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
