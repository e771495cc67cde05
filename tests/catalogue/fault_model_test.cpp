#include "events/catalogue/fault_model.hpp"

#include <gtest/gtest.h>

#include <string>

namespace {

using namespace slipfront::catalogue;

/// A model of two rows of three subfaults on a plane that strikes east and dips 30 degrees. Its rows are written in the
/// given order.
std::string model(const std::string& layers, const std::string& positions, const std::string& top,
                  const std::string& rows) {
  return "% FINITE-SOURCE RUPTURE MODEL\n% Event : Plane 01/01/2000 [test]\n% Loc : LAT = 0 LON = 0 DEP = 5\n"
         "% Mech : STRK = 90 DIP = 30 RAKE = 45 Htop = " +
         top +
         " km\n% Rupt : avTr = 1 s avVr = 2 km/s\n"
         "% Invs : Nx = 3 Nz = 2\n% Invs : Dx = 2 km Dz = 2 km\n" +
         layers + "% ---\n" + positions + "% Nsbfs = 6 subfaults\n% LAT LON X==EW Y==NS Z SLIP\n" + rows;
}

const std::string upper = " 0 0.00000 0 0 4 1\n 0 0.01799 2 0 4 2\n 0 0.03597 4 0 4 3\n";
const std::string lower =
    " -0.01558 0.00000 0 -1.7321 5 4\n -0.01558 0.01799 2 -1.7321 5 5\n -0.01558 0.03597 4 -1.7321 5 6\n";

TEST(FaultModel, SortsSubfaultsIntoRowsWhateverTheirOrder) {
  const std::string shuffled = " -0.01558 0.03597 4 -1.7321 5 6\n" + upper.substr(upper.find('\n') + 1) +
                               lower.substr(0, lower.find(" -0.01558 0.03597")) + upper.substr(0, upper.find('\n') + 1);
  for (const std::string& rows : {upper + lower, shuffled}) {
    const FaultModel m = read_fault_model(model("", "", "999", rows), "m.fsp");
    ASSERT_EQ(m.segments.size(), 1u);
    const FaultSegment& s = m.segments[0];
    EXPECT_EQ(s.along_strike, 3u);
    EXPECT_EQ(s.down_dip, 2u);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(s.patches[i].slip, static_cast<double>(i + 1));
    double sum = 0;
    for (const Subfault& f : m.observation.subfaults) sum += f.moment_share;
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_EQ(m.rake, 45);
  }
}

TEST(FaultModel, HasNoGridIfRowsDiffer) {
  const std::string rows = upper + lower.substr(0, lower.find('\n') + 1) + " 0 0 0 0 6 1\n 0 0 0 0 7 1\n";
  EXPECT_EQ(read_fault_model(model("", "", "999", rows), "m.fsp").segments[0].down_dip, 0u);
}

/// Half a subfault down dip: 1 km x sin 30 degrees = 500 m deeper, and 866 m to the south.
TEST(FaultModel, MovesUpperEdgesToCentres) {
  const std::string centres = "% Coordinates are given for center of each subfault\n";
  const std::string tops = "% Coordinates are given for top-center of each subfault\n";
  const auto first = [](const std::string& positions, const std::string& top) {
    return read_fault_model(model("", positions, top, upper + lower), "m.fsp").segments[0].patches[0];
  };
  for (const FaultPatch& p : {first(tops, "999"), first(tops, "4.0"), first(centres, "4.0")}) {
    EXPECT_NEAR(p.depth, 4500, 1e-9);
    EXPECT_NEAR(p.north, -866.025, 1e-3);
    EXPECT_NEAR(p.east, 0, 1e-9);
    EXPECT_NEAR(p.latitude, -866.025 / m_per_degree, 1e-8);
  }
  for (const FaultPatch& p : {first("", "999"), first(centres, "999"), first(centres, "3.5"), first(tops, "3.5")})
    EXPECT_EQ(p.depth, 4000);
}

TEST(FaultModel, ReadsLayersWithoutWater) {
  const std::string head = "% VELOCITY-DENSITY STRUCTURE\n% DEPTH P-VEL S-VEL DENS\n";
  const auto rock = [&](const std::string& layers) {
    return read_fault_model(model(head + layers, "", "999", upper + lower), "m.fsp").rock;
  };
  const auto tops = rock("% 0 1.5 0 1.0\n% 2 4.0 2.0 2.0\n% 12 6.6 3.8 2.9\n");
  ASSERT_EQ(tops.size(), 2u);
  EXPECT_EQ(rock_at(tops, 0).s_wave_speed, 2000);  // below the water
  EXPECT_EQ(rock_at(tops, 11999).density, 2000);
  EXPECT_EQ(rock_at(tops, 12000).density, 2900);
  const auto bottoms = rock("% 5 4.0 2.0 2.0\n% 30 6.6 3.8 2.9\n");
  EXPECT_EQ(rock_at(bottoms, 4000).density, 2000);
  EXPECT_EQ(rock_at(bottoms, 6000).density, 2900);
  EXPECT_TRUE(rock("% 0 4.0 3.9 2.0\n").empty());  // P waves slower than possible
}

}  // namespace
