#include <cmath>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

TEST(ScenarioOverride, AppliesInOrderBeforeChecking) {
  const Scenario s = read(step, {"friction.law=viscous", "friction.coefficient=-1", "friction.coefficient = 0.5",
                                 "output.times=[0, 1]", "forcing.formula=0.1*sin(x)*t", "title=two words",
                                 "chain.model=\"lattice\"", "interface.contact=2", "medium.poisson_ratio=2_5e-2"});
  EXPECT_EQ(s.friction.parameter("coefficient"), 0.5);
  EXPECT_EQ(s.output.times.size(), 2u);
  EXPECT_DOUBLE_EQ(s.forcing_at(1, 2), 0.2 * std::sin(1));
  EXPECT_EQ(s.title, "two words");
  EXPECT_EQ(s.chain.model, chain::Model::lattice);
  EXPECT_EQ(s.contact_at(0), 2);
  EXPECT_EQ(*s.medium.poisson_ratio, 0.25);
}

TEST(ScenarioOverride, IsNamedInComplaints) {
  const auto complaint = [](const std::string& text) {
    const Complaint c = refused(step, {text});
    EXPECT_EQ(c.file, "--set") << text;
    EXPECT_EQ(c.line, 0u) << text;
    return c;
  };
  EXPECT_EQ(complaint("pulse.cells=3").key, "pulse.cells");
  EXPECT_EQ(complaint("pulse.cells=3").value, "3");
  EXPECT_EQ(complaint("output.times=[1, 9]").value, "9");
  EXPECT_EQ(complaint("output.times=3,4").value, "3,4");
  EXPECT_EQ(complaint("forcing.formula=y").value, "y");
  EXPECT_TRUE(contains(complaint("pulse.cels=3").allowed, "'cells'"));
  EXPECT_TRUE(contains(complaint("puls.cells=3").allowed, "'pulse'"));
  for (const std::string key : {"time.end", "chain.scale", "initial.stress_left"})
    for (const std::string bad : {"nan", "inf", "1e400", "", "word", "1\n2", "\xFF", "{a=1}"})
      complaint(key + "=" + bad);
  for (const std::string bad : {"", "=", "pulse", "pulse=3", "cells=3", ".x=1", "pulse.=1", "event.name=1", "title=1",
                                "a.b.c.d.e.f=1", "initial.a.b=1", "\"initial\".width=1"})
    complaint(bad);
}

TEST(ScenarioOverride, IsNamedInTheTitle) {
  const std::string titled = "title = \"Frictionless step\"\n" + step;
  const Overrides viscous = {"friction.law=none", "friction.law=viscous", "friction.coefficient=0.5"};
  const std::string told = "Frictionless step (with friction.coefficient=0.5, friction.law=viscous)";
  EXPECT_EQ(read(titled).title, "Frictionless step");
  EXPECT_EQ(read(titled, viscous).title, told);
  EXPECT_EQ(read(read(titled, viscous).text).title, told);
  EXPECT_EQ(read(titled, {"title=Mine", "time.end=1"}).title, "Mine");
  EXPECT_EQ(read(step, viscous).title, "");
}

TEST(ScenarioOverride, IsPartOfTheCommandLine) {
  EXPECT_EQ(command_line(read(step), "pulse"), "slipfront pulse dir/s.toml");
  EXPECT_EQ(command_line(read(step, {"time.end=1", "title=it's two"}), "compare", {100, 1e-7}),
            "slipfront compare dir/s.toml --set time.end=1 --set 'title=it'\\''s two' --scale 100 --scale 1e-07");
}

TEST(ScenarioFile, ReadsItsOwnTextBack) {
  const Overrides overrides = {"initial.profile=tanh",  "initial.width=0.1",
                               "friction.law=power",    "friction.coefficient=0.3",
                               "friction.exponent=1.7", "output.times=[0.1, 0.7]",
                               "forcing.formula=x*t/3", "title=a \"quoted\" \\ \xC3\xA9 title"};
  const std::string text =
      "# kept\n[event]\nname = \"E\"\ndate = 2004-09-28\n" + step + "[medium]\ndensity = '2.7 g/cm3'\n";
  for (const Overrides& some : {Overrides{}, overrides}) {
    const Scenario a = read(text, some);
    const Scenario b = read(a.text);
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.initial.profile, b.initial.profile);
    EXPECT_EQ(a.friction.name(), b.friction.name());
    EXPECT_EQ(a.friction.parameter("coefficient"), b.friction.parameter("coefficient"));
    EXPECT_EQ(a.friction.parameter("exponent"), b.friction.parameter("exponent"));
    EXPECT_EQ(a.output.times, b.output.times);
    EXPECT_EQ(a.forcing, b.forcing);
    EXPECT_EQ(a.medium.density, b.medium.density);
    EXPECT_EQ(a.warnings, b.warnings);
    for (const double x : {-3.0, -0.01, 0.0, 0.02, 2.0}) EXPECT_EQ(a.stress(x), b.stress(x));
    EXPECT_EQ(read(b.text).text, b.text);
  }
  EXPECT_EQ(read(text).text, text);
  EXPECT_TRUE(contains(read(text, overrides).text, "# --set friction.law=power"));
}

}  // namespace
}  // namespace slipfront::scenario
