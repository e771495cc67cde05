#pragma once
/// \file
/// The sites of the direct solver and what acts on each. Lengths and times are stretched by the scale.

#include <cstddef>
#include <vector>

#include "slipfront/plane/problem.hpp"

namespace slipfront::plane {

/// Arrays have two ghost sites at each side of each row, and two ghost rows below and above.
struct Sites {
  static constexpr std::size_t ghosts = 2;
  std::size_t nx = 0, ny = 0;
  double scale = 1;
  double left = 0, bottom = 0;  ///< edges of the domain, in units of the scenario
  double hx = 0, hy = 0;        ///< spacings, stretched

  std::vector<double> contact2;  ///< a^2; empty: 1
  std::vector<double> viscous;   ///< C / scale; empty: none
  std::vector<double> moves;     ///< 1, or 0 where the interface is held; empty: 1

  std::size_t stride() const { return nx + 2 * ghosts; }
  std::size_t size() const { return stride() * (ny + 2 * ghosts); }
  std::size_t at(std::size_t i, std::size_t j) const { return (j + ghosts) * stride() + i + ghosts; }
  double x(std::size_t i) const { return left + (static_cast<double>(i) + 0.5) * hx / scale; }
  double y(std::size_t j) const { return bottom + (static_cast<double>(j) + 0.5) * hy / scale; }
};

/// Numbers of sites along x and y that are at most `spacing` widths of a dislocation apart. \throws InputError for
/// numbers out of range.
struct Counts {
  double nx, ny;
};
Counts count_sites(const Problem& problem, double scale, double spacing);

/// The sites of a problem, at most `spacing` widths of a dislocation apart. \throws InputError for numbers out of
/// range.
Sites make_sites(const Problem& problem, double scale, double spacing);

/// Lines at rest whose mean is the initial slip: at each site the train whose density is the gradient of the slip.
struct Start {
  std::vector<double> u;
  double largest_density = 0;  ///< largest gradient of the slip, in local units
};
/// \throws InputError for a slip that is negative or not finite.
Start lines_at_rest(const Problem& problem, const Sites& sites);

}  // namespace slipfront::plane
