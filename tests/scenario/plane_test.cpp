#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

using Table = std::vector<std::vector<double>>;

const std::string on_grid =
    "[plane]\nleft = -1\nright = 1\nbottom = 0\ntop = 2\n[initial]\nprofile = \"grid\"\nfile = \"slip.csv\"\n";

Scenario read_grid(const std::string& text, const Table& table, std::vector<std::string>* columns = nullptr) {
  return read_scenario(text, "s.toml", {}, [&](const std::string&, const std::vector<std::string>& names) {
    if (columns) *columns = names;
    return table;
  });
}

Complaint refused_grid(const Table& table, const std::string& text = on_grid) {
  return refused([&] { read_grid(text, table); });
}

/// Slip (1 + x)^2 (3 - y), which rises along x and falls along y.
Table grid(int count) {
  Table table;
  for (int j = count; j >= 0; --j)  // in no order
    for (int i = 0; i <= count; ++i) {
      const double x = -1 + 2.0 * i / count, y = 2.0 * j / count;
      table.push_back({x, y, (1 + x) * (1 + x) * (3 - y)});
    }
  return table;
}

TEST(ScenarioGrid, IsASmoothMonotoneSlip) {
  std::vector<std::string> columns;
  const Scenario s = read_grid(on_grid, grid(20), &columns);
  EXPECT_EQ(columns, (std::vector<std::string>{"x", "y", "slip"}));
  const auto& slip = s.plane->problem.slip;
  EXPECT_DOUBLE_EQ(slip(0, 1), 2);
  for (const double x : {-0.97, -0.31, 0.02, 0.5, 0.96})
    for (const double y : {0.03, 0.77, 1.99})
      EXPECT_NEAR(slip(x, y), (1 + x) * (1 + x) * (3 - y), 0.01) << x << ' ' << y;
  for (double x = -1; x < 0.99; x += 0.01) EXPECT_GE(slip(x + 0.01, 0.55), slip(x, 0.55));
}

TEST(ScenarioGrid, RefusesWhatIsNoGrid) {
  const auto key = [](const Table& table) { return refused_grid(table).key; };
  EXPECT_EQ(key({{-1, 0, 1}, {1, 2, 1}}), "initial.file");
  EXPECT_EQ(refused_grid({{-1, 0, 1}, {1, 0, 1}}).problem, "2 x and 1 y");
  EXPECT_EQ(refused_grid({{-1, 0, 1}, {1, 0, 1}, {-1, 2, 1}}).problem, "x = 1, y = 2 is missing");
  EXPECT_EQ(refused_grid({{-1, 0, 1}, {1, 0, 1}, {1, 0, 1}, {-1, 2, 1}}).problem, "x = 1, y = 0 is given twice");
  EXPECT_EQ(refused_grid({{-1, 0, 1}, {1, 0, -1}, {-1, 2, 1}, {1, 2, 1}}).problem, "row 2: slip = -1");
  EXPECT_EQ(refused_grid({{-1, 0, 1}, {0.5, 0, 1}, {-1, 2, 1}, {0.5, 2, 1}}).problem,
            "the grid has x = -1 to 0.5, y = 0 to 2 and does not cover the plane");
  EXPECT_EQ(refused([&] { read("[initial]\nprofile = \"grid\"\nfile = \"a.csv\"\n"); }).key, "initial.profile");
}

const std::string held =
    "[plane]\nleft = -1\nright = 1\nbottom = -1\ntop = 1\n[initial]\nprofile = \"formula\"\nformula = \"1 - "
    "x^2\"\nhold = true\n";

TEST(ScenarioNucleation, IsReadWithItsDefaults) {
  const plane::Problem p = read(held + "[nucleation]\nradius = 0.2\n").plane->problem;
  EXPECT_TRUE(p.hold);
  ASSERT_TRUE(p.nucleation);
  EXPECT_EQ(p.nucleation->x, 0);
  EXPECT_EQ(p.nucleation->radius, 0.2);
  EXPECT_EQ(p.nucleation->time, 0);
  EXPECT_EQ(p.edges, plane::Edges::free);
  const plane::Problem given = read(held + "[nucleation]\nradius = 0.2\ny = 0.5\ntime = 3\n",
                                    {"plane.edges=absorbing", "plane.wave_speed_ratio=0.5"})
                                   .plane->problem;
  EXPECT_EQ(given.nucleation->y, 1);  // in the coordinates of the problem
  EXPECT_EQ(given.nucleation->time, 3);
  EXPECT_EQ(given.edges, plane::Edges::absorbing);
}

TEST(ScenarioNucleation, Refuses) {
  EXPECT_EQ(refused(held + "[nucleation]\nx = 1\n").key, "nucleation.radius");
  EXPECT_EQ(refused(held + "[nucleation]\nradius = 0.5\nx = 4\n").key, "nucleation.radius");
  const Complaint free = refused(held + "[nucleation]\nradius = 0.5\n", {"initial.hold=false"});
  EXPECT_NE(free.problem.find("nothing holds"), std::string::npos) << free.problem;
  read(held + "[nucleation]\nradius = 0.5\n[friction]\nlaw = \"coulomb\"\ncoefficient = 2\n", {"initial.hold=false"});
  EXPECT_EQ(refused(step + "[nucleation]\nradius = 0.5\n").key, "nucleation");
}

}  // namespace
}  // namespace slipfront::scenario
