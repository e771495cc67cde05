#pragma once

#include <cstddef>
#include <vector>

namespace slipfront::pulse {

/// Cells in a row with dislocations in them; between two stretches lies a gap, a cell without any, whose faces are free
/// edges.
struct Stretch {
  std::size_t begin, end;  ///< cells
  bool left_free, right_free;
};
std::vector<Stretch> stretches_of(const std::vector<double>& charge, bool left_free, bool right_free);

/// x at the middle of each cell in s, from the faces: sixth order inside a stretch, fourth and second in its last
/// cells.
void middles(const std::vector<Stretch>& stretches, const std::vector<double>& faces, std::vector<double>& centres);

}  // namespace slipfront::pulse
