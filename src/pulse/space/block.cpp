#include "pulse/space/block.hpp"

#include <algorithm>

namespace slipfront::pulse {

std::vector<Block> blocks_of(const std::vector<double>& charge, Edge left, Edge right) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < charge.size(); ++i) {
    if (charge[i] == 0) continue;
    const bool opens = i == 0 || charge[i - 1] == 0;
    if (opens) blocks.push_back({i, i, i > 0 ? Edge::free : left, Edge::free});
    blocks.back().end = i + 1;
  }
  blocks.back().right = right;
  return blocks;
}

void middles(const std::vector<Block>& blocks, const std::vector<double>& faces, std::vector<double>& centres) {
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = (faces[i] + faces[i + 1]) / 2;
  for (const Block& block : blocks)
    for (std::size_t i = block.begin + 1; i + 1 < block.end; ++i) {
      const double* f = faces.data() + i;
      const bool inside = i >= block.begin + 2 && i + 2 < block.end;
      const double smooth = inside ? (150 * (f[0] + f[1]) - 25 * (f[-1] + f[2]) + 3 * (f[-2] + f[3])) / 256
                                   : (9 * (f[0] + f[1]) - (f[-1] + f[2])) / 16;
      // Next to a much wider cell, as at a shock, the smooth value could be outside the cell.
      const double middle = centres[i], quarter = (f[1] - f[0]) / 4;
      centres[i] = std::clamp(smooth, middle - quarter, middle + quarter);
    }
}

}  // namespace slipfront::pulse
