#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "plane/averaged/observe.hpp"
#include "plane/grid/observe.hpp"

namespace {

namespace planes = slipfront::plane;

/// A value at the centre of a cell is that of the cell, up to the last one, and half-way between two centres their
/// mean.
TEST(PlaneValues, OfTheGridAreInterpolated) {
  const planes::Cells cells{.nx = 6, .ny = 5, .left = -1, .bottom = 2, .hx = 0.5, .hy = 0.25};
  std::vector<double> values(cells.size());
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    values[cell] = std::sin(1.3 * static_cast<double>(i)) + std::exp(0.7 * static_cast<double>(j));
  });
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    const planes::Point at = cells.centre(cell);
    EXPECT_NEAR(planes::value_at(values, cells, at), values[cell], 1e-13) << i << " " << j;
    if (i + 1 < cells.nx) {
      EXPECT_NEAR(planes::value_at(values, cells, {at.x + 0.25, at.y}), (values[cell] + values[cell + 1]) / 2, 1e-13);
    }
    if (j + 1 < cells.ny) {
      EXPECT_NEAR(planes::value_at(values, cells, {at.x, at.y + 0.125}),
                  (values[cell] + values[cell + cells.stride()]) / 2, 1e-13);
    }
  });
}

/// Values that are linear in the distance are exact between the centres of the outermost and the innermost cell.
TEST(PlaneValues, OfLoopsAreInterpolatedAlongARay) {
  planes::Loops loops;
  loops.rows = 5;
  loops.label = {0, 1, 2, 3, 4, 5};
  loops.r = {5, 4, 3.2, 2, 1, 0.5};
  std::vector<double> values;
  for (std::size_t row = 0; row < loops.rows; ++row) values.push_back((loops.r[row] + loops.r[row + 1]) / 2);
  const planes::Ray ray(loops, 0);
  for (double r = 0.75; r <= 4.5; r += 0.125) EXPECT_NEAR(ray.at(values, r), r, 1e-14);
  EXPECT_EQ(ray.at(values, 4.9), 4.5);
  EXPECT_EQ(ray.at(values, 0.6), 0.75);
  EXPECT_EQ(ray.at(values, 5.1), 0);
  EXPECT_EQ(ray.at(values, 0.4), 0);
}

}  // namespace
