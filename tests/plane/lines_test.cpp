#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <vector>

#include "lattice/plane/direct/sites.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

Sites square(double side, double scale) {
  Problem p;
  p.left = p.bottom = -side / 2;
  p.right = p.top = side / 2;
  return make_sites(p, scale, 0.4);
}

template <class U>
std::vector<double> at_sites(const Sites& sites, const U& value) {
  std::vector<double> u(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) u[sites.at(i, j)] = value(sites.x(i), sites.y(j));
  return u;
}

double length_of(const Line& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.points.size(); ++i)
    length += std::hypot(line.points[i].x - line.points[i - 1].x, line.points[i].y - line.points[i - 1].y);
  return length;
}

// u = 20 - 10 r is an odd multiple of pi on three circles.
TEST(PlaneLines, AConeHasCircles) {
  const Sites sites = square(5, 10);
  const std::vector<Line> lines =
      lines_of(at_sites(sites, [](double x, double y) { return 20 - 10 * std::hypot(x, y); }), sites);
  std::set<int> numbers;
  for (const Line& line : lines) {
    const double radius = 2 - (2 * line.number - 1) * pi / 10;
    if (line.number <= 0) continue;  // in the corners u is negative
    numbers.insert(line.number);
    ASSERT_GT(line.points.size(), 10U);
    EXPECT_EQ(line.points.front().x, line.points.back().x);
    EXPECT_EQ(line.points.front().y, line.points.back().y);
    for (const Point& point : line.points) EXPECT_NEAR(std::hypot(point.x, point.y), radius, 1e-3) << line.number;
    EXPECT_NEAR(length_of(line) / (2 * pi * radius), 1, 0.01) << line.number;
  }
  EXPECT_EQ(numbers, (std::set<int>{1, 2, 3}));
}

// u = pi + x y has a saddle: lines of other numbers end at the edges, two in each pair of opposite corners.
TEST(PlaneLines, LinesEndAtTheEdges) {
  const Sites sites = square(10, 1);
  const std::vector<Line> lines = lines_of(at_sites(sites, [](double x, double y) { return pi + x * y; }), sites);
  const double edge = 5 - sites.hx / 2;  // the outermost sites
  std::multiset<int> numbers;
  for (const Line& line : lines) {
    if (line.number == 1) continue;  // the axes, which cross
    numbers.insert(line.number);
    for (const Point& point : line.points) EXPECT_NEAR(point.x * point.y, 2 * pi * (line.number - 1), 0.2);
    for (const Point& end : {line.points.front(), line.points.back()})
      EXPECT_NEAR(std::fmax(std::fabs(end.x), std::fabs(end.y)), edge, 1e-9);
  }
  for (const int number : {-2, -1, 0, 2, 3, 4}) EXPECT_EQ(numbers.count(number), 2U) << number;
}

TEST(PlaneLines, AFlatStateHasNone) {
  const Sites sites = square(10, 1);
  EXPECT_TRUE(lines_of(at_sites(sites, [](double, double) { return 6 * pi; }), sites).empty());
}

}  // namespace
}  // namespace slipfront::plane
