#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "computed.hpp"
#include "corners.hpp"
#include "nodes.hpp"

namespace slipfront::friction_ratio {

namespace {

/// The closure, stress and damping number of one run of the solver.
struct Node {
  friction::Closure closure;
  double stress, damping;
  auto operator<=>(const Node&) const = default;
};
using Solved = std::map<Node, Logarithms>;

/// The indices of an entry of the table.
struct Place {
  std::size_t closure, measure, piece, i, j;
};

Node node_at(const layout::Corners& corners, const Place& p) {
  const layout::Corner& corner = corners[p.closure][p.measure];
  const auto ends = layout::ends_at(corner, node(p.i, layout::y_nodes)).value;
  const double low = ends[p.piece], high = ends[p.piece + 1];
  const double x = layout::x_at(node(p.j, layout::u_nodes), layout::by_root(corner, p.piece));
  const double u = p.j == 0 ? high : p.j == layout::u_nodes - 1 ? low : std::lerp(low, high, x);
  return {closures[p.closure], stress_node(p.i), std::fmin(std::expm1(u), layout::most_damping)};
}

/// All nodes, each once. Measures share the nodes that do not depend on a corner.
Solved nodes_of(const layout::Corners& corners) {
  Solved all;
  for (std::size_t c = 0; c < layout::closures; ++c)
    for (std::size_t m = 0; m < layout::measures; ++m)
      for (std::size_t p = 0; p < layout::pieces; ++p)
        for (std::size_t i = 0; i < layout::y_nodes; ++i)
          for (std::size_t j = 0; j < layout::u_nodes; ++j) all[node_at(corners, {c, m, p, i, j})] = {};
  return all;
}

/// Solves at all nodes. Returns an error message, or an empty text.
std::string solve_all(Solved& solved) {
  std::vector<Solved::value_type*> work;
  for (auto& entry : solved) work.push_back(&entry);
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
  return failed;
}

void print_row(std::FILE* file, const double* numbers, std::size_t size) {
  for (std::size_t n = 0; n < size; ++n) std::fprintf(file, "%.6e,", numbers[n]);
  std::fputc('\n', file);
}

/// The coefficient of T_a(y) T_b(u) in a piece of the table.
double coefficient_at(const Solved& solved, const layout::Corners& corners, const Place& p, std::size_t a,
                      std::size_t b) {
  return coefficient(a, layout::y_nodes, [&](std::size_t i) {
    return coefficient(b, layout::u_nodes, [&](std::size_t j) {
      return solved.at(node_at(corners, {p.closure, p.measure, p.piece, i, j}))[p.measure];
    });
  });
}

void print_table(const Solved& solved, const layout::Corners& corners) {
  std::FILE* const file = table_file("coefficients");
  for (std::size_t c = 0; c < layout::closures; ++c)
    for (std::size_t m = 0; m < layout::measures; ++m)
      for (std::size_t p = 0; p < layout::pieces; ++p)
        for (std::size_t a = 0; a < layout::y_nodes; ++a) {
          std::array<double, layout::u_nodes> row;
          for (std::size_t b = 0; b < layout::u_nodes; ++b)
            row[b] = coefficient_at(solved, corners, {c, m, p, 0, 0}, a, b);
          print_row(file, row.data(), row.size());
        }
  std::fclose(file);
}

void print_corners(const layout::Corners& corners) {
  std::FILE* const file = table_file("corners");
  for (const auto& of_closure : corners)
    for (const layout::Corner& corner : of_closure) print_row(file, corner.data(), corner.size());
  std::fclose(file);
}

}  // namespace

int make() {
  const layout::Corners found = find_corners();
  Solved solved = nodes_of(found);
  const std::string failed = solve_all(solved);
  if (!failed.empty()) {
    std::fprintf(stderr, "friction_ratio_table: %s\n", failed.c_str());
    return 1;
  }
  print_table(solved, found);
  print_corners(found);
  return 0;
}

}  // namespace slipfront::friction_ratio
