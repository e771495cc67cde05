#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace slipfront::pulse {

/// Boundary condition at an end of a row of cells.
enum class Edge {
  free,       ///< no dislocations: no pressure, and the edge moves
  continued,  ///< the train in the last cell continues
  wall,       ///< a wall that no dislocation passes; the last dislocation may move away from it
  ring,       ///< the other end of the row
};

/// Returns Edge::wall if the end of a train, at x, touches the wall, and Edge::free if the train has moved away from
/// it. `width` is that of the last cell.
inline Edge edge_at_wall(double x, double wall, double width) {
  return std::fabs(x - wall) <= 1e-13 * std::fabs(wall) + 1e-6 * width ? Edge::wall : Edge::free;
}

/// A range of neighbouring cells or faces. It does not include `end`.
struct CellRange {
  std::size_t begin, end;
  bool empty() const { return begin >= end; }
};

/// A row of cells with dislocations. Between two blocks is a gap, one cell without dislocations, whose faces are free
/// edges.
struct Block {
  std::size_t begin, end;  ///< cells
  Edge left, right;
};
/// The cells that a block and a stretch of cells have in common.
inline CellRange common(const Block& block, CellRange stretch) {
  const std::size_t begin = std::max(block.begin, stretch.begin);
  return {begin, std::max(begin, std::min(block.end, stretch.end))};
}
std::vector<Block> blocks_of(const std::vector<double>& charge, Edge left, Edge right);

/// Finds x at the middle of each cell in s, from the faces: sixth order inside a block, fourth and second order in its
/// last cells. The result is within the middle half of the cell.
void middles(const std::vector<Block>& blocks, const std::vector<double>& faces, std::vector<double>& centres);

}  // namespace slipfront::pulse
