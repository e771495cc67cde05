// Scenarios in SI units, docs/scenario.md, "SI units".

#include <cmath>
#include <string>

#include "math/digits.hpp"
#include "slipfront/scenario/quantities.hpp"
#include "slipfront/theory/medium/medium.hpp"
#include "support.hpp"

namespace slipfront::scenario {
namespace {

const std::string pmma =
    "[medium]\nshear_modulus = \"3 GPa\"\ndensity = \"1180 kg/m3\"\npoisson_ratio = 0.33\ncontact_ratio = 0.0041\n"
    "asperity_spacing = \"20 um\"\n";

/// The units of this medium, from the functions of `medium`.
medium::Units units() { return medium::units(3e9, medium::speed_from_shear_modulus(3e9, 1180, 0.33), 0.0041, 20e-6); }
double force() { return medium::traction_unit(3e9, 0.33, 0.0041); }

Scenario with(const std::string& table, const std::string& initial = si_step) { return read(initial + table + pmma); }

TEST(ScenarioInSi, ConvertsEveryTable) {
  const double face = 2 * units().slip;
  const Scenario s = with(
      "[domain]\nleft = \"-10 cm\"\nright = \"0.1 m\"\n[time]\nend = \"2 ms\"\n[output]\ntimes = [\"1 ms\", \"1500 "
      "us\"]\n"
      "[loading]\nstiffness = \"0.02 MPa/um\"\nvelocity = \"1 um/s\"\nevent_velocity = \"1 mm/s\"\n"
      "[chain]\nwindow = \"1 cm\"\nspacing = \"2 mm\"\n[forcing]\nformula = \"10 kPa\"\n");
  EXPECT_DOUBLE_EQ(*s.domain.left, -0.1 / units().length);
  EXPECT_DOUBLE_EQ(*s.domain.right, 0.1 / units().length);
  EXPECT_DOUBLE_EQ(s.end, 2e-3 / units().time);
  ASSERT_EQ(s.output.times.size(), 2u);
  EXPECT_DOUBLE_EQ(s.output.times[1], 1500e-6 / units().time);
  EXPECT_DOUBLE_EQ(s.loading.stiffness, 0.02e12 / (force() / face));
  EXPECT_DOUBLE_EQ(s.loading.velocity, 1e-6 / units().slip_velocity);
  EXPECT_DOUBLE_EQ(s.loading.event_velocity, 1e-3 / units().slip_velocity);
  EXPECT_DOUBLE_EQ(*s.chain.window, 0.01 / units().length);
  EXPECT_DOUBLE_EQ(*s.chain.spacing, 2e-3 / units().length);
  EXPECT_DOUBLE_EQ(s.forcing_at(0.3, 0.4), 10e3 / force());
}

/// The springs and their velocity are of the same faces: kappa v t is a stress in both systems.
TEST(ScenarioInSi, LoadsAtTheSameRate) {
  const Scenario s = with("[loading]\nstiffness = \"2 MPa/mm\"\nvelocity = \"3 um/s\"\n");
  const double rate = s.loading.stiffness * s.loading.velocity * force() / units().time;
  EXPECT_NEAR(rate / (2e9 * 3e-6), 1, 1e-14);
}

TEST(ScenarioInSi, TakesAForceOverASlipWithAnArea) {
  const Scenario by_area = with("[loading]\nstiffness = \"2e6 N/m\"\narea = \"10 cm2\"\nvelocity = \"1 um/s\"\n");
  const Scenario direct = with("[loading]\nstiffness = \"2e9 Pa/m\"\nvelocity = \"1 um/s\"\n");
  EXPECT_NEAR(by_area.loading.stiffness / direct.loading.stiffness, 1, 1e-14);
  EXPECT_EQ(refused(step + "[loading]\nstiffness = 2\narea = \"1 m2\"\nvelocity = 1\n" + pmma).key, "loading.area");
}

TEST(ScenarioInSi, PullsAnEndByAStress) {
  const Scenario s = with("[loading]\nwhere = \"left\"\nstiffness = \"2 MPa/mm\"\nvelocity = \"1 um/s\"\n");
  EXPECT_DOUBLE_EQ(s.loading.stiffness, 2e9 / (units().stress / (2 * units().slip)));
}

TEST(ScenarioInSi, TakesSharesOfTheNormalStress) {
  const std::string friction = "[friction]\nlaw = \"coulomb\"\nnormal_stress = \"5 MPa\"\ncoefficient = 0.001\n";
  const Scenario s = with(friction, "[initial]\nstress_left = \"0.6 sigma_N\"\nstress_right = \"1 MPa\"\n");
  EXPECT_DOUBLE_EQ(s.initial.stress_left, 3e6 / units().stress);
  EXPECT_DOUBLE_EQ(s.initial.stress_right, 1e6 / units().stress);
  EXPECT_TRUE(contains(refused("[initial]\nstress_left = \"0.6 sigma_N\"\nstress_right = 0\n" + pmma).problem,
                       "friction.normal_stress"));
}

TEST(ScenarioInSi, ReadsFormulasInMetresSecondsAndPascals) {
  const std::string initial =
      "[initial]\nprofile = \"formula\"\nformula = \"1e6 * (2 - tanh(x / 0.01))\"\nunits = \"SI\"\n";
  const Scenario s = with(
      "[domain]\nleft = -5\nright = 5\n[forcing]\nformula = \"1e3 * t + 2 * x\"\nunits = \"SI\"\n"
      "[interface]\ncontact = \"1 + x\"\nunits = \"SI\"\n",
      initial);
  const double x = 0.7, X = x * units().length, T = 3 * units().time;
  EXPECT_DOUBLE_EQ(s.stress(x), 1e6 * (2 - std::tanh(X / 0.01)) / units().stress);
  EXPECT_DOUBLE_EQ(s.forcing_at(x, 3), (1e3 * T + 2 * X) / force());
  EXPECT_DOUBLE_EQ(s.contact_at(x), 1 + X);
  EXPECT_EQ(refused("[initial]\nstress_left = 1\nstress_right = 0\nunits = \"SI\"\n" + pmma).key, "initial.units");
}

TEST(ScenarioInSi, ReadsTablesInMetresAndPascals) {
  const Scenario s =
      read("[initial]\nprofile = \"table\"\nfile = \"a.csv\"\nunits = \"SI\"\n[domain]\nleft = -1\nright = 1\n" + pmma,
           {}, {{-1, 1e6}, {1, 3e6}});
  EXPECT_NEAR(s.stress(0) * units().stress, 2e6, 1e-3);
}

TEST(ScenarioInSi, ReadsFrictionCurvesInPascals) {
  const std::string formula = "[friction]\nlaw = \"formula\"\nunits = \"SI\"\nformula = \"2e3 * w / (1 + w)\"\n";
  const double w = 0.3, W = w * units().slip_velocity, pascals = 2e3 * W / (1 + W);
  EXPECT_NEAR(with(formula).friction.force(-w) * force() / pascals, -1, 1e-14);
  EXPECT_NEAR(with(formula + "coefficient = 3\n").friction.force(-w) * force() / pascals, -3, 1e-14);
  const std::string file = "[friction]\nlaw = \"table\"\nunits = \"SI\"\nfile = \"f.csv\"\n";
  const Rows rows = {{0, 0}, {1e3, 4e6}};
  EXPECT_NEAR(read(step + file + pmma, {}, rows).friction.force(-w) * force() / (4e3 * W), -1, 1e-14);
}

/// A coefficient that is a stress makes the curve a pure number.
TEST(ScenarioInSi, MultipliesFrictionCurvesByAStress) {
  const double w = 0.3, W = w * units().slip_velocity;
  for (const std::string stress : {"coefficient = \"2 kPa\"\n", "normal_stress = \"2 kPa\"\n",
                                   "normal_stress = \"8 kPa\"\ncoefficient = 0.25\n"}) {
    const std::string units_key = "units = \"SI\"\n" + stress;
    const Scenario formula = with("[friction]\nlaw = \"formula\"\nformula = \"w / (1 + w)\"\n" + units_key);
    EXPECT_NEAR(formula.friction.force(-w) * force() / (2e3 * W / (1 + W)), -1, 1e-14) << stress;
    const Rows rows = {{0, 0}, {1e3, 1e3}};
    const Scenario table =
        read(si_step + "[friction]\nlaw = \"table\"\nfile = \"f.csv\"\n" + units_key + pmma, {}, rows);
    EXPECT_NEAR(table.friction.force(-w) * force() / (2e3 * W), -1, 1e-14) << stress;
  }
}

/// In a scenario with values in SI units, a number without a unit would be one of the model.
TEST(ScenarioInSi, RefusesNumbersWithoutAUnit) {
  const auto names = [&](const std::string& rest, const std::string& key, const std::string& allowed,
                         const Overrides& set = {}) {
    const Complaint c = refused(si_step + rest + pmma, set);
    EXPECT_EQ(c.key, key);
    EXPECT_TRUE(contains(c.problem, "initial.stress_left = '1 MPa'")) << c.problem;
    EXPECT_TRUE(contains(c.allowed, allowed)) << c.allowed;
  };
  names("[time]\nend = 300\n", "time.end", "\"300 s\"");
  names("[domain]\nleft = -2.5\n", "domain.left", "\"-2.5 m\"");
  names("[time]\nend = \"3 s\"\n[output]\ntimes = [\"1 ms\", 2]\n", "output.times", "\"2 s\"");
  names("[loading]\nstiffness = 3\nvelocity = \"1 um/s\"\n", "loading.stiffness", "\"3 Pa/m\"");
  names("[loading]\nstiffness = \"3 Pa/m\"\nvelocity = 1e-5\n", "loading.velocity", "\"1e-05 m/s\"");
  names("[friction]\nlaw = \"coulomb\"\ncoefficient = 0.1\n", "friction.coefficient", "\"0.1 Pa\"");
  names("[friction]\nlaw = \"slip-weakening\"\nstrength = \"1 kPa\"\ncharacteristic_slip = 2\n",
        "friction.characteristic_slip", "\"2 m\"");
  names("[forcing]\nformula = 0.1\n", "forcing.formula", "\"0.1 Pa\"");
  names("[interface]\ncontact = \"1 + 0.1 * x\"\n[domain]\nleft = \"-1 mm\"\nright = \"1 mm\"\n", "interface.contact",
        "interface.units");
  names("", "time.end", "\"5 s\"", {"time.end=5"});
  EXPECT_EQ(refused(si_step + pmma, {"time.end=5"}).file, "--set");
}

TEST(ScenarioInSi, TakesPureNumbersAndZeros) {
  read(si_step +
       "[interface]\ncontact = 1.5\n[forcing]\nformula = 0\n[domain]\nleft = \"-1 mm\"\nright = 0\n[chain]\nscale = "
       "2\n[friction]\nlaw = \"viscous\"\ncoefficient = 0.5\n" +
       pmma);
  read(si_step + "[friction]\nlaw = \"coulomb\"\nnormal_stress = \"1 MPa\"\ncoefficient = 0.01\n" + pmma);
  // Constants of the medium, the normal stress and units of formulas do not make a scenario one in SI units.
  read(step + "[friction]\nlaw = \"coulomb\"\nnormal_stress = \"1 MPa\"\ncoefficient = 0.01\n[time]\nend = 3\n" + pmma);
  read(step + "[domain]\nleft = -5\nright = 5\n[forcing]\nformula = \"1e3 * x\"\nunits = \"SI\"\n" + pmma);
}

/// The dimensionless number, printed with all digits, gives the same bits.
TEST(ScenarioInSi, GivesTheBitsOfTheDimensionlessScenario) {
  const std::string text = si_step + "[domain]\nleft = \"-7 mm\"\nright = \"13 mm\"\n[time]\nend = \"0.1 ms\"\n" + pmma;
  Overrides model;
  for (const Quantity& q : quantities_of(text, "a.toml", {})) model.push_back(q.key + "=" + shortest(q.model));
  EXPECT_EQ(model.size(), 5u);
  const Scenario si = read(text), numbers = read(text, model);
  EXPECT_EQ(*si.domain.left, *numbers.domain.left);
  EXPECT_EQ(*si.domain.right, *numbers.domain.right);
  EXPECT_EQ(si.end, numbers.end);
}

TEST(ScenarioInSi, NamesTheDimensionAndTheConstantsThatAreMissing) {
  const Complaint wrong = refused(si_step + "[time]\nend = \"2 m\"\n" + pmma);
  EXPECT_EQ(wrong.key, "time.end");
  EXPECT_TRUE(contains(wrong.problem, "'m' is not that of a time")) << wrong.problem;
  const Complaint missing = refused("[initial]\nstress_left = 0\nstress_right = 0\n[time]\nend = \"2 s\"\n");
  EXPECT_TRUE(contains(missing.problem, "medium.contact_ratio and medium.asperity_spacing")) << missing.problem;
  EXPECT_EQ(refused(si_step + "[pulse]\ncells = \"2 m\"\n" + pmma).key, "pulse.cells");
}

/// Scenarios read what catalogues read.
TEST(ScenarioInSi, ReadsTypographicCharacters) {
  const auto end = [](const std::string& time) { return with("[time]\nend = \"" + time + "\"\n").end; };
  const double microseconds = end("5 us");
  for (const std::string text :
       {"5 \u00b5s", "5 \u03bcs", "5\u00a0us", "5\u202f\u00b5s", "5us", "5 \u00d7 10\u207b\u2076 s"})
    EXPECT_DOUBLE_EQ(end(text), microseconds) << text;
  const auto velocity = [](const std::string& text) {
    return with("[loading]\nstiffness = \"2 MPa\u00a0mm\u207b\u00b9\"\nvelocity = \"" + text + "\"\n").loading.velocity;
  };
  for (const std::string text : {"3 \u00b5m s\u207b\u00b9", "3 \u03bcm\u00b7s\u207b\u00b9", "3 um s-1"})
    EXPECT_EQ(velocity(text), velocity("3 um/s")) << text;
  EXPECT_EQ(with("[forcing]\nformula = \"10\u00a0kPa\"\n").forcing_at(0, 0),
            with("[forcing]\nformula = \"10 kPa\"\n").forcing_at(0, 0));
}

TEST(ScenarioInSi, StatesBoundsInTheUnitOfTheUser) {
  EXPECT_EQ(refused(si_step + "[time]\nend = \"2 s\"\n[output]\nevery = \"1 ns\"\n" + pmma).allowed, ">= 2000 ns");
  EXPECT_EQ(refused(si_step + "[time]\nend = \"2 ms\"\n[output]\ntimes = [\"3000 us\"]\n" + pmma).allowed,
            ">= 0 us and <= 2000 us");
  EXPECT_EQ(refused(si_step + "[domain]\nleft = \"3 cm\"\nright = \"2 mm\"\n" + pmma).allowed, "> 30 mm");
}

TEST(ScenarioInSi, ReportsAllErrorsOfAFile) {
  try {
    read(si_step +
         "[domain]\nleft = \"-1 s\"\nrihgt = 3\n[time]\nend = -1\n[friction]\nlaw = \"coulomb\"\n"
         "coefficient = \"3 m\"\n[pulse]\ncells = 2\n[chian]\nscale = 3\n" +
         pmma);
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    std::vector<std::string> keys;
    std::size_t line = 0;
    for (const Complaint& c : error.complaints()) {
      keys.push_back(c.key);
      EXPECT_GE(c.line, line);
      line = c.line;
      EXPECT_EQ(c.file, "dir/s.toml");
    }
    EXPECT_EQ(keys, (std::vector<std::string>{"domain.left", "domain.rihgt", "time.end", "friction.coefficient",
                                              "pulse.cells", "chian"}));
  }
}

/// An error in [medium] is not repeated by every key that needs it.
TEST(ScenarioInSi, ReportsAnErrorOfTheMediumOnce) {
  const Complaint c = refused(si_step + "[time]\nend = \"2 s\"\n[medium]\ncontact_ratio = -1\n");
  EXPECT_EQ(c.key, "medium.contact_ratio");
}

TEST(ScenarioQuantities, AreInBothSystems) {
  const std::string text = si_step + "[time]\nend = \"1 ms\"\n[friction]\nlaw = \"coulomb\"\ncoefficient = \"5 kPa\"\n";
  for (const Quantity& q : quantities_of(text + pmma, "a.toml", {})) {
    ASSERT_TRUE(q.si) << q.key;
    if (q.key == "time.end") {
      EXPECT_NEAR(*q.si, 1e-3, 1e-18);
    }
    if (q.key == "friction.coefficient") {
      EXPECT_NEAR(*q.si, 5e3, 1e-9);
    }
  }
  EXPECT_EQ(quantities_of(text + pmma, "a.toml", {}).size(), 4u);
  for (const Quantity& q : quantities_of(step, "a.toml", {})) EXPECT_FALSE(q.si);
}

}  // namespace
}  // namespace slipfront::scenario
