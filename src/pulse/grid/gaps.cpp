#include "pulse/grid/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slipfront::pulse {

double gaps_close_in(const Problem& problem, const Cells& cells, const double* rates) {
  const ConstValues rate(rates, cells.size());
  double least = HUGE_VAL;
  if (problem.left_end == End::fixed && rate.left_edge() < 0)
    least = std::fmax((problem.left - cells.left_edge()) / rate.left_edge(), 0.0);
  if (problem.right_end == End::fixed) {
    double speed = rate.left_edge();
    for (std::size_t i = 0; i < cells.size(); ++i) speed += rate.width(i);
    if (speed > 0) least = std::fmin(least, std::fmax((problem.right - cells.left_face(cells.size())) / speed, 0.0));
  }
  if (least == 0) least = HUGE_VAL;  // at the wall
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] == 0 && rate.width(i) < 0) least = std::fmin(least, -cells.width(i) / rate.width(i));
  return least;
}

namespace {

/// Whether the edges of a gap have met, to a millionth of the cells next to it.
bool gap_has_closed(const Cells& cells, std::size_t i) {
  return cells.charge[i] == 0 && cells.width(i) <= 1e-6 * std::fmin(cells.width(i - 1), cells.width(i + 1));
}

/// Cells next to a closed gap become neighbours. Cells are small at free edges; in the dense state that grows where two
/// edges have met they would only shorten the steps, and are joined.
void close_gap(Cells& cells, std::size_t i) {
  cells.width(i - 1) += cells.width(i) / 2;
  cells.width(i + 1) += cells.width(i) / 2;
  cells.width(i) = 0;
  cells.erase(i);
  std::vector<double> sorted = cells.charge;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double enough = 0.4 * *middle;
  const auto small = [&](std::size_t j) { return cells.charge[j] > 0 && cells.charge[j] < enough; };
  for (std::size_t j = i; j < cells.size() && small(j); ++j)
    while (small(j) && j + 1 < cells.size() && cells.charge[j + 1] > 0) cells.join(j + 1, j);
  std::size_t j = i;
  while (j > 0 && small(j - 1)) {
    --j;
    while (small(j) && j > 0 && cells.charge[j - 1] > 0) {
      cells.join(j - 1, j);
      --j;  // the index of the joined cell
    }
  }
}

}  // namespace

/// Closes gaps from right to left. The first and the last cell are never gaps: layout and saved runs begin and end with
/// stress, and no end drops a cell next to a gap.
bool close_gaps(Cells& cells) {
  bool closed = false;
  for (std::size_t i = cells.size() - 1; i-- > 1;) {
    if (!gap_has_closed(cells, i)) continue;
    close_gap(cells, i);
    i = std::min(i, cells.size() - 1);  // joining may have removed cells on both sides
    closed = true;
  }
  if (closed) cells.face_momentum.clear();
  return closed;
}

}  // namespace slipfront::pulse
