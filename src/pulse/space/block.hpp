#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace slipfront::pulse {

/// What lies beyond an end of a row of cells.
enum class Edge {
  free,       ///< no dislocations: no pressure, and the edge moves
  continued,  ///< the same train as in the last cell
  wall,       ///< nothing passes; the last dislocation may leave it
  ring,       ///< the other end
};

/// Whether a train whose last cell has this width stands at the wall or has left it and ends in a free edge.
inline Edge edge_at_wall(double x, double wall, double width) {
  return std::fabs(x - wall) <= 1e-13 * std::fabs(wall) + 1e-6 * width ? Edge::wall : Edge::free;
}

/// Neighbouring cells or faces, without `end`.
struct CellRange {
  std::size_t begin, end;
  bool empty() const { return begin >= end; }
};

/// Cells in a row with dislocations in them; between two blocks lies a gap, a cell without any, whose faces are free
/// edges.
struct Block {
  std::size_t begin, end;  ///< cells
  Edge left, right;
};
/// The cells that a block and a stretch have in common.
inline CellRange common(const Block& block, CellRange stretch) {
  const std::size_t begin = std::max(block.begin, stretch.begin);
  return {begin, std::max(begin, std::min(block.end, stretch.end))};
}
std::vector<Block> blocks_of(const std::vector<double>& charge, Edge left, Edge right);

/// x at the middle of each cell in s, from the faces: sixth order inside a block, fourth and second in its last
/// cells; within the middle half of the cell.
void middles(const std::vector<Block>& blocks, const std::vector<double>& faces, std::vector<double>& centres);

}  // namespace slipfront::pulse
