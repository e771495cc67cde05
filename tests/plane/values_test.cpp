#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "averages/grid/equations.hpp"
#include "averages/grid/grid_solver.hpp"
#include "averages/loops/steps.hpp"
#include "slipfront/error.hpp"

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

/// The number of loops outside of a point is exact if it is a cubic function of the distance.
TEST(PlaneValues, NumbersOfLoopsFollowACubic) {
  planes::Loops loops;
  loops.rows = 6;
  loops.r = {5, 4, 3.2, 2, 1, 0.5, 0.2};
  const auto number = [](double r) { return 200 - 20 * r - 2 * r * r - 0.3 * r * r * r; };
  for (const double r : loops.r) loops.label.push_back(number(r) - number(5));
  const planes::Ray ray(loops, 0);
  for (double r = 0.25; r < 5; r += 0.125) EXPECT_NEAR(ray.loops_outside(r), number(r) - number(5), 1e-12) << r;
  EXPECT_EQ(ray.loops_outside(6), 0);
  EXPECT_EQ(ray.loops_outside(0.1), loops.label.back());
}

/// Circles have made 2 pi times their areas, each with the number of loops on it.
TEST(PlaneValues, VolumeIsThatOfCircles) {
  for (const std::size_t angles : {1u, 8u}) {
    planes::Loops loops;
    loops.rows = 2;
    loops.angles = angles;
    loops.label = {0, 3, 5};
    for (const double r : {4.0, 2.0, 1.0}) loops.r.insert(loops.r.end(), angles, r);
    EXPECT_NEAR(planes::volume(loops), 2 * std::numbers::pi * std::numbers::pi * (3 * (16 + 4) / 2 + 2 * (4 + 1) / 2),
                1e-11);
  }
}

/// At the boundary of a held region, the slip may be a parabola, and its gradient along the boundary and the action
/// straight lines. The boundary is up to half a cell in front of a face or behind it.
TEST(PlaneValues, AtTheBoundaryOfAHeldRegionAreExactForParabolas) {
  for (const bool along_y : {false, true})
    for (const double sign : {1.0, -1.0})
      for (const double place : {-0.4, -0.1, 0.15, 0.4}) {
        const planes::Cells cells{.nx = 12, .ny = 14, .left = -1, .bottom = 2, .hx = 0.5, .hy = 0.25};
        const double h = cells.spacing(along_y), face = along_y ? cells.y(6) - h / 2 : cells.x(6) - h / 2;
        const double boundary = face + sign * place * h;
        const auto along = [=](double x, double y) { return along_y ? y : x; };
        const auto slip = [=](double s) { return 3 + 0.7 * (s - boundary) + 0.4 * (s - boundary) * (s - boundary); };
        planes::Problem problem;
        problem.slip = [=](double x, double y) { return slip(along(x, y)); };
        problem.fixed = [=](double x, double y) { return sign * (along(x, y) - boundary) < 0 ? 1.0 : 0.0; };
        const planes::Walls walls(problem, cells);
        std::vector<double> slips(cells.size()), actions(cells.size()), straight(cells.size());
        cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
          const double s = along(cells.x(i), cells.y(j));
          slips[cell] = slip(s);
          actions[cell] = 2 * (s - boundary);
          straight[cell] = 5 - 0.3 * s;
        });
        std::vector<double> gradient(cells.size()), action(cells.size()), transverse(cells.size());
        walls.set_gradients(slips, along_y, gradient);
        walls.set_actions(actions, along_y, action);
        walls.set_transverse(straight, along_y, transverse);
        const std::size_t at = along_y ? cells.at(4, 6) : cells.at(6, 4);
        EXPECT_TRUE(walls.at_face(at, along_y));
        EXPECT_NEAR(gradient[at], 0.7 + 0.8 * (face - boundary), 1e-9) << along_y << sign << place;
        EXPECT_NEAR(transverse[at], 5 - 0.3 * face, 1e-12) << along_y << sign << place;
        if (place < 0.2) {
          EXPECT_NEAR(action[at], 2 * (face - boundary), 1e-9) << along_y << sign << place;
        }
      }
}

/// A held region that contains no centre of a cell would have no effect, wherever it is in a cell.
TEST(PlaneValues, HeldRegionsBetweenCentresAreRefused) {
  const planes::Cells cells{.nx = 12, .ny = 14, .left = -1, .bottom = 2, .hx = 0.5, .hy = 0.25};
  for (const double right : {-0.4, 0.0, 0.4})
    for (const double up : {-0.4, 0.4}) {
      planes::Problem problem;
      problem.slip = [](double, double) { return 1.0; };
      problem.fixed = [&](double x, double y) {
        return std::fabs((x - cells.x(6)) / 0.5 - right) < 0.05 && std::fabs((y - cells.y(5)) / 0.25 - up) < 0.05 ? 1.0
                                                                                                                  : 0.0;
      };
      EXPECT_THROW(planes::Walls(problem, cells), slipfront::InputError) << right << " " << up;
    }
}

}  // namespace
