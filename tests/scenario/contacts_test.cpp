// Keys of contacts that age and pores that dilate.

#include "friction/state/contacts.hpp"

#include <cmath>

#include "slipfront/error.hpp"
#include "support.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::scenario;

const std::string law =
    step + "[domain]\nleft = -7\nright = 3\n[friction]\nlaw = \"rate-and-state\"\nstrength = 0.05\n";

TEST(ContactKeys, SetTheContactAtTheStart) {
  const Scenario s =
      read(law +
           "reference_velocity = 0.05\ncharacteristic_slip = 0.1\ncontact_ageing = 0.1\ncontact_time = 0.5\n"
           "dilatancy = 0.02\ndrainage_time = 3\npore_pressure = 0.25\n[interface]\ncontact = \"2+x/10\"\n");
  const friction::Contacts& c = s.friction.contacts();
  EXPECT_TRUE(c.act());
  EXPECT_EQ(c.ageing, 0.1);
  EXPECT_EQ(c.age, 0.5);
  EXPECT_EQ(c.dilatancy, 0.02);
  EXPECT_EQ(c.drainage, 3);
  EXPECT_EQ(c.ambient, 0.25);
  EXPECT_NEAR(s.contact_at(1), 2.1 * 0.75 * std::sqrt(1 + 0.1 * std::log(1 + 2 / 0.5)), 1e-14);
  const friction::Contacts scaled = s.friction.scaled_by(10).contacts();
  EXPECT_EQ(scaled.age, 5);
  EXPECT_EQ(scaled.drainage, 30);
  EXPECT_EQ(scaled.dilatancy, 0.02);
}

TEST(ContactKeys, AcceptSiUnits) {
  const std::string in_si = si_step +
                            "[domain]\nleft = \"-1 m\"\nright = \"1 m\"\n[friction]\nlaw = \"rate-and-state\"\n"
                            "strength = \"1 kPa\"\n";
  const std::string rock =
      "[medium]\nshear_modulus = \"30 GPa\"\npoisson_ratio = 0.25\np_wave_speed = \"6 km/s\"\ncontact_ratio = "
      "0.01\nasperity_spacing = \"1 mm\"\n";
  const std::string law_in_si = "normal_stress = \"50 MPa\"\ndilatancy = \"0.5 MPa\"\npore_pressure = \"20 MPa\"\n";
  const Scenario s = read(in_si + law_in_si + "drainage_time = \"1 ms\"\n" + rock);
  const friction::Contacts& c = s.friction.contacts();
  EXPECT_NEAR(c.dilatancy, 0.01, 1e-15);
  EXPECT_NEAR(c.ambient, 0.4, 1e-15);
  EXPECT_GT(c.drainage, 0);
  EXPECT_EQ(refused(in_si + "dilatancy = \"0.5 MPa\"\n" + rock).key, "friction.dilatancy");
}

TEST(ContactKeys, RejectWrongValues) {
  const struct {
    const char *lines, *key, *said;
  } cases[] = {
      {"contact_ageing = -0.1\ncontact_time = 1", "contact_ageing", "out of range"},
      {"contact_ageing = 0.1\ncontact_time = 0", "contact_time", "out of range"},
      {"contact_ageing = 0.1", "contact_time", "missing"},
      {"contact_time = 1", "contact_time", "no effect"},
      {"dilatancy = 0.1\ndrainage_time = 0", "drainage_time", "out of range"},
      {"dilatancy = 0.1\ndrainage_time = -2", "drainage_time", "out of range"},
      {"drainage_time = 2", "drainage_time", "no effect"},
      {"pore_pressure = 0.2", "pore_pressure", "no effect"},
      {"dilatancy = 0.1\npore_pressure = 1", "pore_pressure", "effective normal stress"},
  };
  for (const auto& c : cases) {
    const Complaint complaint = refused(law + c.lines + "\n");
    EXPECT_EQ(complaint.key, std::string("friction.") + c.key);
    EXPECT_TRUE(contains(complaint.problem, c.said)) << complaint.problem;
  }
  const Complaint other = refused(step + "[friction]\nlaw = \"viscous\"\ncoefficient = 1\ndilatancy = 0.1\n");
  EXPECT_EQ(other.key, "friction.dilatancy");
  EXPECT_TRUE(contains(other.allowed, "rate-and-state"));
}

TEST(ContactKeys, WarnWithoutDrainage) {
  const Scenario s = read(law + "dilatancy = 0.1\n");
  ASSERT_FALSE(s.warnings.empty());
  EXPECT_TRUE(contains(s.warnings.back(), "never drain"));
}

}  // namespace
