// Makes src/friction_ratio/coefficients.cpp from the pulse solver, and checks the table against it at random points.
//   friction_ratio_table make > src/friction_ratio/coefficients.cpp
//   friction_ratio_table check POINTS        exit code 1 where the table is off by more than it says

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <string_view>
#include <utility>
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

/// u, on a grid of ln(1 + Gamma), where the second derivative of `y` jumps up most.
std::size_t sharpest(const std::vector<double>& y) {
  std::size_t at = 0;
  double jump = 0;
  for (std::size_t n = 8; n + 8 < y.size(); ++n) {
    const double found = y[n + 2] - 2 * y[n + 1] + 2 * y[n - 1] - y[n - 2];
    if (found > jump) jump = found, at = n;
  }
  return at;
}

/// Where the parabola through y[from - 4], y[from - 2], y[from] meets that through y[to], y[to + 2], y[to + 4], counted
/// from `from`.
double meeting(const std::vector<double>& y, std::size_t from, std::size_t to) {
  const auto parabola = [&](const double* v, int direction, double x) {  // v[0], v[2 direction], v[4 direction]
    const double a = v[0], b = v[2 * direction], c = v[4 * direction];
    const double s = x / 2;
    return a + s * (b - a) + s * (s - 1) / 2 * (c - 2 * b + a);
  };
  const double width = static_cast<double>(to - from);
  double low = 0, high = width;
  const auto above = [&](double x) { return parabola(&y[from], -1, -x) > parabola(&y[to], 1, x - width); };
  const bool left_above = above(low);
  for (int n = 0; n < 40; ++n) (above((low + high) / 2) == left_above ? low : high) = (low + high) / 2;
  return low;
}

/// ln(1 + Gamma) at the corners of ln W(0), whose slope turns there, and of the peak, where one top overtakes another.
/// Closure "consistent"; "paper" has none below Gamma = 3.
struct CornersAt {
  double origin, peak;
};
CornersAt corners_at(double stress) {
  constexpr double step = 0.004, first = 0.15, last = 1.5;
  std::vector<double> dampings, origin, peak;
  for (double u = first; u < last; u += step) dampings.push_back(std::expm1(u));
  for (const SlipVelocities& w : solve_each(stress, Closure::consistent, 3200, dampings)) {
    origin.push_back(std::log(w.origin));
    peak.push_back(std::log(w.peak));
  }
  const std::size_t near_peak = sharpest(peak);
  return {first + step * static_cast<double>(sharpest(origin)),
          first + step * (static_cast<double>(near_peak - 2) + meeting(peak, near_peak - 2, near_peak + 2))};
}

double stress_node(std::size_t i) {
  if (i == 0) return layout::most_stress;
  if (i == layout::y_nodes - 1) return layout::least_stress;
  return layout::stress_of(layout::of_stress().at(node(i, layout::y_nodes)));
}

layout::Corners find_corners() {
  std::array<CornersAt, layout::y_nodes> found;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < layout::y_nodes; ++i) found[i] = corners_at(stress_node(i));
  layout::Corners corners{};
  for (std::size_t i = 0; i < layout::corner_terms; ++i) {
    const auto term = [&](double CornersAt::*u) {
      return coefficient(i, layout::y_nodes, [&](std::size_t n) { return found[n].*u; });
    };
    corners[0][static_cast<std::size_t>(Measure::origin)][i] = term(&CornersAt::origin);
    corners[0][static_cast<std::size_t>(Measure::peak)][i] = term(&CornersAt::peak);
  }
  return corners;
}

void print(const std::vector<double>& numbers) {
  for (std::size_t n = 0; n < numbers.size(); ++n) std::printf("%s%.6e", n == 0 ? "{{" : ",", numbers[n]);
  std::fputs("}}", stdout);
}

int make() {
  struct Node {
    Closure closure;
    double stress, damping;
    auto operator<=>(const Node&) const = default;
  };
  const layout::Corners corners = find_corners();
  const auto node_at = [&](std::size_t c, std::size_t m, std::size_t piece, std::size_t i, std::size_t j) {
    const auto ends = layout::ends_at(corners[c][m], node(i, layout::y_nodes)).value;
    const double x = layout::x_at(node(j, layout::u_nodes), layout::by_root(corners[c][m], piece));
    const double u = j == 0                     ? ends[piece + 1]
                     : j == layout::u_nodes - 1 ? ends[piece]
                                                : std::lerp(ends[piece], ends[piece + 1], x);
    return Node{closures[c], stress_node(i), std::fmin(std::expm1(u), layout::most_damping)};
  };
  std::map<Node, Values> values;  // measures share the nodes that no corner moves
  for (std::size_t c = 0; c < layout::closures; ++c)
    for (std::size_t m = 0; m < layout::measures; ++m)
      for (std::size_t p = 0; p < layout::pieces; ++p)
        for (std::size_t i = 0; i < layout::y_nodes; ++i)
          for (std::size_t j = 0; j < layout::u_nodes; ++j) values[node_at(c, m, p, i, j)] = {};
  std::vector<std::pair<const Node, Values>*> work;
  for (auto& entry : values) work.push_back(&entry);
  std::string failed;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < work.size(); ++n) {
    const Node& at = work[n]->first;
    try {
      work[n]->second = computed(at.closure, at.stress, at.damping);
    } catch (const std::exception& error) {
#pragma omp critical
      failed = "stress " + std::to_string(at.stress) + ", damping number " + std::to_string(at.damping) + ": " +
               error.what();
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
          std::vector<double> row;
          for (std::size_t b = 0; b < layout::u_nodes; ++b)
            row.push_back(coefficient(a, layout::y_nodes, [&](std::size_t i) {
              return coefficient(b, layout::u_nodes, [&](std::size_t j) { return values[node_at(c, m, p, i, j)][m]; });
            }));
          print(row);
          std::puts(a + 1 < layout::y_nodes ? "," : "}},");
        }
      }
      std::puts("}},");
    }
    std::puts("}},");
  }
  std::puts("}};\n\nconst layout::Corners corners = {{");
  for (const auto& of_closure : corners) {
    std::puts("{{");
    for (const layout::Corner& corner : of_closure) {
      print({corner.begin(), corner.end()});
      std::puts(",");
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
          closure == Closure::paper ? "paper" : "consistent", u == 0 ? "" : ", unstable range", w.points, w.error[0],
          w.error[1], w.error[2], w.stress, w.damping, allowed);
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
