#include "stretch.hpp"

#include <algorithm>

namespace slipfront::pulse {

std::vector<Stretch> stretches_of(const std::vector<double>& charge, Edge left, Edge right) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < charge.size(); ++i) {
    if (charge[i] == 0) continue;
    const bool opens = i == 0 || charge[i - 1] == 0;
    if (opens) stretches.push_back({i, i, i > 0 ? Edge::free : left, Edge::free});
    stretches.back().end = i + 1;
  }
  stretches.back().right = right;
  return stretches;
}

void middles(const std::vector<Stretch>& stretches, const std::vector<double>& faces, std::vector<double>& centres) {
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = (faces[i] + faces[i + 1]) / 2;
  for (const Stretch& stretch : stretches)
    for (std::size_t i = stretch.begin + 1; i + 1 < stretch.end; ++i) {
      const double* f = faces.data() + i;
      const bool inside = i >= stretch.begin + 2 && i + 2 < stretch.end;
      const double smooth = inside ? (150 * (f[0] + f[1]) - 25 * (f[-1] + f[2]) + 3 * (f[-2] + f[3])) / 256
                                   : (9 * (f[0] + f[1]) - (f[-1] + f[2])) / 16;
      // Beside much wider cells, as at a shock, that would be outside the cell.
      const double middle = centres[i], quarter = (f[1] - f[0]) / 4;
      centres[i] = std::clamp(smooth, middle - quarter, middle + quarter);
    }
}

}  // namespace slipfront::pulse
