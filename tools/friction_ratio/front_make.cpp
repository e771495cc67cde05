#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "commands.hpp"
#include "computed.hpp"
#include "front_computed.hpp"
#include "nodes.hpp"

namespace slipfront::friction_ratio {

namespace {

using front_layout::drops, front_layout::ends, front_layout::of_threshold, front_layout::pieces,
    front_layout::threshold_nodes, front_layout::u_nodes, front_layout::unit;

/// Number of nodes in y: the front's or the stress drop's. Then indices of closure, Sigma-, piece and node in the
/// piece.
using Node = std::tuple<std::size_t, std::size_t, std::size_t, std::size_t, std::size_t>;
using Solved = std::map<Node, FrontAndDrops>;

double stress_at(std::size_t y_nodes, std::size_t i) {
  if (i == 0) return layout::most_stress;
  if (i == y_nodes - 1) return layout::least_stress;
  return layout::stress_of(layout::of_stress().at(node(i, y_nodes)));
}

double damping_at(std::size_t piece, std::size_t j) {
  if (j == 0) return ends[piece + 1];
  if (j == u_nodes - 1) return ends[piece];
  return std::expm1(layout::Range{std::log1p(ends[piece]), std::log1p(ends[piece + 1])}.at(node(j, u_nodes)));
}

std::vector<double> thresholds() {
  std::vector<double> all;
  for (std::size_t k = 0; k < threshold_nodes; ++k)
    all.push_back(std::exp(of_threshold().at(node(k, threshold_nodes))));
  return all;
}

/// Solves at all nodes. Returns an error message, or an empty text.
std::string solve_all(Solved& solved) {
  for (const std::size_t y_nodes : {front_layout::front_y_nodes, front_layout::drop_y_nodes})
    for (std::size_t c = 0; c < front_layout::closures; ++c)
      for (std::size_t i = 0; i < y_nodes; ++i)
        for (std::size_t p = 0; p < pieces; ++p)
          for (std::size_t j = 0; j < u_nodes; ++j) solved[{y_nodes, c, i, p, j}] = {};
  std::vector<Solved::value_type*> work;
  for (auto& entry : solved) work.push_back(&entry);
  std::string failed;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < work.size(); ++n) {
    const auto [y_nodes, c, i, p, j] = work[n]->first;
    const double stress = stress_at(y_nodes, i), damping = damping_at(p, j);
    try {
      work[n]->second = front_and_drops(friction_ratio::closures[c], stress, damping,
                                        y_nodes == front_layout::front_y_nodes ? thresholds() : std::vector<double>{});
    } catch (const std::exception& error) {
#pragma omp critical
      failed = "stress " + std::to_string(stress) + ", damping number " + std::to_string(damping) + ": " + error.what();
    }
  }
  return failed;
}

/// Prints the coefficients of all pieces. `value(i, p, j)` is the function at a node.
template <class Value>
void print_pieces(std::FILE* file, std::size_t y_nodes, const Value& value) {
  for (std::size_t p = 0; p < pieces; ++p)
    for (std::size_t a = 0; a < y_nodes; ++a) {
      for (std::size_t b = 0; b < u_nodes; ++b) {
        const double found = coefficient(a, y_nodes, [&](std::size_t i) {
          return coefficient(b, u_nodes, [&](std::size_t j) { return value(i, p, j); });
        });
        std::fprintf(file, "%ld,", std::lround(found / unit));
      }
      std::fputc('\n', file);
    }
}

void print_fronts(const Solved& solved) {
  std::FILE* const file = table_file("front_coefficients");
  for (std::size_t c = 0; c < front_layout::closures; ++c)
    for (std::size_t k = 0; k < threshold_nodes; ++k)
      print_pieces(file, front_layout::front_y_nodes, [&](std::size_t i, std::size_t p, std::size_t j) {
        return coefficient(k, threshold_nodes, [&](std::size_t t) {
          return front_layout::from_ratio(solved.at({front_layout::front_y_nodes, c, i, p, j}).fronts[t]);
        });
      });
  std::fclose(file);
}

void print_drops(const Solved& solved) {
  std::FILE* const file = table_file("drop_coefficients");
  for (std::size_t c = 0; c < front_layout::closures; ++c)
    for (std::size_t d = 0; d < drops; ++d)
      print_pieces(file, front_layout::drop_y_nodes, [&](std::size_t i, std::size_t p, std::size_t j) {
        return std::log(solved.at({front_layout::drop_y_nodes, c, i, p, j}).drops[d]);
      });
  std::fclose(file);
}

}  // namespace

int make_front() {
  Solved solved;
  const std::string failed = solve_all(solved);
  if (!failed.empty()) {
    std::fprintf(stderr, "friction_ratio_table: %s\n", failed.c_str());
    return 1;
  }
  print_fronts(solved);
  print_drops(solved);
  return 0;
}

}  // namespace slipfront::friction_ratio
