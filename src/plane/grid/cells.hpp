#pragma once
/// \file
/// The cells of the averaged solver on a fixed grid. Arrays have ghost cells around the domain. A face has the index of
/// the cell to its right, or above it.

#include <cstddef>
#include <vector>

#include "slipfront/plane/problem.hpp"

namespace slipfront::plane {

struct Cells {
  static constexpr std::size_t ghosts = 3;
  std::size_t nx = 0, ny = 0;
  double left = 0, bottom = 0;
  double hx = 0, hy = 0;

  std::size_t stride() const { return nx + 2 * ghosts; }
  std::size_t size() const { return stride() * (ny + 2 * ghosts); }
  std::size_t at(std::size_t i, std::size_t j) const { return (j + ghosts) * stride() + i + ghosts; }
  double x(std::size_t i) const { return left + (static_cast<double>(i) + 0.5) * hx; }
  double y(std::size_t j) const { return bottom + (static_cast<double>(j) + 0.5) * hy; }
  Point centre(std::size_t cell) const {
    const std::size_t column = cell % stride(), row = cell / stride();
    return {left + (static_cast<double>(column) - ghosts + 0.5) * hx,
            bottom + (static_cast<double>(row) - ghosts + 0.5) * hy};
  }
  /// Distance in an array from a cell to the next one, along x or y.
  std::size_t step(bool along_y) const { return along_y ? stride() : 1; }
  double spacing(bool along_y) const { return along_y ? hy : hx; }

  bool at_edge(std::size_t i, std::size_t j) const { return i == 0 || j == 0 || i + 1 == nx || j + 1 == ny; }

  /// Calls act(i, j, cell) for each cell of the domain.
  template <class Act>
  void each(const Act& act) const {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) act(i, j, at(i, j));
  }
  /// Copies the outermost cells into the ghost cells, as a mirror does: no stress acts at the edges.
  template <class Value>
  void mirror(std::vector<Value>& values) const {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t g = 0; g < ghosts; ++g) {
        values[at(0, j) - 1 - g] = values[at(g, j)];
        values[at(nx - 1, j) + 1 + g] = values[at(nx - 1 - g, j)];
      }
    for (std::size_t g = 0; g < ghosts; ++g)
      for (std::size_t i = 0; i < stride(); ++i) {
        values[(ghosts - 1 - g) * stride() + i] = values[(ghosts + g) * stride() + i];
        values[(ghosts + ny + g) * stride() + i] = values[(ghosts + ny - 1 - g) * stride() + i];
      }
  }
};

}  // namespace slipfront::plane
