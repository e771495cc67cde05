// Makes src/friction_ratio/coefficients.cpp from the pulse solver, and checks the table against it at random points.
//   friction_ratio_table make > src/friction_ratio/coefficients.cpp
//   friction_ratio_table check POINTS        exit code 1 where the table is off by more than it says

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "../src/friction_ratio/layout.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction_ratio/solve.hpp"
#include "slipfront/friction_ratio/table.hpp"
#include "slipfront/rupture/relations.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction_ratio;
using modulation::Closure;
using Values = std::array<double, layout::measures>;  ///< ln of W over the frictionless W(0)

constexpr Closure closures[layout::closures] = {Closure::consistent, Closure::paper};

Values logarithms(const Question& question) {
  const SlipVelocities w = solve(question);
  const double unit = rupture::from_stress(question.stress).slip_velocity;
  return {std::log(w.origin / unit), std::log(w.mean / unit), std::log(w.peak / unit)};
}

/// Where closure "paper" is unstable: the median of a few coarse runs, which the instability has not yet spoilt.
Values median_of_coarse_runs(Question question) {
  std::vector<Values> found;
  for (const int cells : {120, 150, 180, 210, 240, 270, 300}) {
    question.cells = cells;
    try {
      const Values v = logarithms(question);
      if (std::isfinite(v[0] + v[1] + v[2])) found.push_back(v);
    } catch (const NumericsError&) {
    }
  }
  if (found.empty()) throw NumericsError("no run of closure paper came through");
  Values median{};
  for (std::size_t m = 0; m < layout::measures; ++m) {
    std::sort(found.begin(), found.end(), [m](const Values& a, const Values& b) { return a[m] < b[m]; });
    median[m] = found[found.size() / 2][m];
  }
  return median;
}

/// Cells that keep the error of the solver below 3e-5: more where it meets its switch to implicit steps, and where the
/// stress is high and friction young.
int cells_for(double damping) { return damping < 30 || (damping >= 1000 && damping < 1e5) ? 800 : 400; }

/// Closure "paper" would lose more to its instability with 800 cells than it gains, and some runs of 400 fail
/// (docs/friction_ratio.md).
Values by_paper(double stress, double damping) {
  for (const int cells : {400, 360, 330}) try {
      return logarithms({stress, damping, Closure::paper, cells});
    } catch (const NumericsError&) {
    }
  return logarithms({stress, damping, Closure::paper, 300});
}

Values computed(Closure closure, double stress, double damping) {
  if (uncertainty(closure, damping) > 1e-3) return median_of_coarse_runs({stress, damping, closure});
  Values values = closure == Closure::paper ? by_paper(stress, damping)
                                            : logarithms({stress, damping, closure, cells_for(damping)});
  if (damping == 0) values[0] = 0;
  return values;
}

double node(std::size_t i, std::size_t count) {
  return std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(count - 1));
}

/// Coefficients of the Chebyshev polynomial through `count` values at `node`s: value(i) at node i.
template <class Value>
double coefficient(std::size_t k, std::size_t count, const Value& value) {
  const std::size_t last = count - 1;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double half = i == 0 || i == last ? 0.5 : 1;
    sum += half * value(i) *
           std::cos(std::numbers::pi * static_cast<double>(i * k % (2 * last)) / static_cast<double>(last));
  }
  return sum * (k == 0 || k == last ? 1.0 : 2.0) / static_cast<double>(last);
}

int make() {
  constexpr std::size_t total = layout::closures * layout::pieces * layout::y_nodes * layout::u_nodes;
  std::vector<Values> values(total);
  std::string failed;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < total; ++n) {
    const std::size_t j = n % layout::u_nodes, i = n / layout::u_nodes % layout::y_nodes;
    const std::size_t piece = n / (layout::u_nodes * layout::y_nodes) % layout::pieces;
    const Closure closure = closures[n / (total / layout::closures)];
    const double stress = i == 0 ? layout::most_stress
                          : i == layout::y_nodes - 1
                              ? layout::least_stress
                              : layout::stress_of(layout::of_stress().at(node(i, layout::y_nodes)));
    const double damping = j == 0 ? layout::ends[piece + 1]
                           : j == layout::u_nodes - 1
                               ? layout::ends[piece]
                               : std::expm1(layout::of_piece(piece).at(node(j, layout::u_nodes)));
    try {
      values[n] = computed(closure, stress, damping);
    } catch (const std::exception& error) {
#pragma omp critical
      failed = "stress " + std::to_string(stress) + ", damping number " + std::to_string(damping) + ": " + error.what();
    }
  }
  if (!failed.empty()) {
    std::fprintf(stderr, "friction_ratio_table: %s\n", failed.c_str());
    return 1;
  }
  std::puts("// Made by tools/friction_ratio_table.cpp. Do not edit.\n");
  std::puts("#include \"coefficients.hpp\"\n\nnamespace slipfront::friction_ratio {\n\n// clang-format off");
  std::puts("const layout::Table coefficients = {{");
  for (std::size_t c = 0; c < layout::closures; ++c) {
    std::puts("{{");
    for (std::size_t m = 0; m < layout::measures; ++m) {
      std::puts("{{");
      for (std::size_t p = 0; p < layout::pieces; ++p) {
        std::fputs("{{", stdout);
        for (std::size_t a = 0; a < layout::y_nodes; ++a) {
          std::fputs("{{", stdout);
          for (std::size_t b = 0; b < layout::u_nodes; ++b) {
            const auto along = [&](std::size_t i) {
              const auto value = [&](std::size_t j) {
                return values[((c * layout::pieces + p) * layout::y_nodes + i) * layout::u_nodes + j][m];
              };
              return coefficient(b, layout::u_nodes, value);
            };
            std::printf("%.6e%s", coefficient(a, layout::y_nodes, along), b + 1 < layout::u_nodes ? "," : "");
          }
          std::fputs(a + 1 < layout::y_nodes ? "}},\n" : "}}", stdout);
        }
        std::puts("}},");
      }
      std::puts("}},");
    }
    std::puts("}},");
  }
  std::puts("}};\n// clang-format on\n\n}  // namespace slipfront::friction_ratio");
  return 0;
}

/// Largest relative difference from the solver, where the table is certified and where it is not.
struct Worst {
  Values error{};
  double stress = 0, damping = 0;
  std::size_t points = 0;
  void take(const Values& e, double at_stress, double at_damping) {
    ++points;
    if (*std::max_element(e.begin(), e.end()) > *std::max_element(error.begin(), error.end()))
      stress = at_stress, damping = at_damping;
    for (std::size_t m = 0; m < layout::measures; ++m) error[m] = std::fmax(error[m], e[m]);
  }
};

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
        const Values from_solver = computed(closure, stress, damping);
        Values error{};
        for (std::size_t m = 0; m < layout::measures; ++m)
          error[m] = std::fabs(
              evaluate(static_cast<Measure>(m), closure, stress, damping).value / std::exp(from_solver[m]) - 1);
#pragma omp critical
        worst[uncertainty(closure, damping) > 1e-4 ? 1 : 0].take(error, stress, damping);
      } catch (const std::exception& error) {
#pragma omp critical
        failed = error.what();
      }
    }
    for (int u = 0; u < 2; ++u) {
      const Worst& w = worst[u];
      if (w.points == 0) continue;
      const double allowed = uncertainty(closure, w.damping),
                   largest = *std::max_element(w.error.begin(), w.error.end());
      std::printf(
          "%s%s: %zu points, largest relative difference: origin %.1e, mean %.1e, peak %.1e (at stress %.4g, damping "
          "number %.4g), allowed %.0e\n",
          closure == Closure::paper ? "paper" : "consistent",
          u == 0                      ? ""
          : closure == Closure::paper ? ", unstable range"
                                      : ", about the corner",
          w.points, w.error[0], w.error[1], w.error[2], w.stress, w.damping, allowed);
      good = good && largest <= allowed;
    }
    if (!failed.empty()) {
      std::printf("failed: %s\n", failed.c_str());
      good = false;
    }
  }
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "make") return make();
  if (argc == 3 && std::string_view(argv[1]) == "check" && std::atol(argv[2]) > 0) return check(std::atol(argv[2]));
  std::fputs("friction_ratio_table make | check POINTS\n", stderr);
  return 2;
}
