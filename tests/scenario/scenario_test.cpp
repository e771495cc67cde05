#include <array>
#include <cmath>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

/// The complaint about a key in a table after [initial]; the key is on line 5.
Complaint refused_setting(const std::string& table, const std::string& key, const std::string& value) {
  const Complaint c = refused(step + "[" + table + "]\n" + key + " = " + value + "\n");
  EXPECT_EQ(c.file, "dir/s.toml");
  EXPECT_EQ(c.line, 5u) << table << "." << key << " = " << value;
  EXPECT_EQ(c.key, table + "." + key);
  EXPECT_FALSE(c.problem.empty());
  EXPECT_FALSE(c.allowed.empty());
  return c;
}

TEST(ScenarioFile, DefaultsNeedOnlyInitial) {
  const Scenario s = read(step);
  EXPECT_EQ(s.title, "");
  EXPECT_EQ(s.file, "dir/s.toml");
  EXPECT_EQ(s.text, step);
  EXPECT_EQ(s.friction.name(), "none");
  EXPECT_EQ(s.friction.closure(), friction::Closure::consistent);
  EXPECT_FALSE(s.forcing_at);
  EXPECT_FALSE(s.contact_at);
  EXPECT_FALSE(s.domain.left || s.domain.right || s.chain.spacing || s.output.every || s.medium.density);
  EXPECT_DOUBLE_EQ(s.end, 2 * std::acos(-1.0));
  EXPECT_EQ(s.pulse.cells, 400);
  EXPECT_TRUE(s.warnings.empty());
}

TEST(ScenarioFile, ReadsEveryKey) {
  const Scenario s = read(R"(title = "All"
[initial]
profile = "tanh"
stress_left = 1.5
stress_right = 0.5
width = 2
[friction]
law = "power"
coefficient = 1
exponent = 0.5
closure = "paper"
[forcing]
formula = "0.1*x + t"
[interface]
contact = "1 + x^2"
[domain]
left = -5
right = 6.5
[time]
end = 12
[pulse]
cells = 1000
tolerance = 1e-9
threshold = 0.01
[chain]
scale = 4
spacing = 0.05
model = "lattice"
[medium]
shear_modulus = "30 GPa"
poisson_ratio = 0.3
p_wave_speed = "6 km/s"
s_wave_speed = "3.2 km/s"
density = "2.7 g/cm3"
contact_ratio = 4e-5
asperity_spacing = "1 mm"
[output]
times = [0, 1.5, 12]
variables = ["k", "Sigma", "U", "W", "H", "slip", "stress_drop"]
[event]
anything = nan
)");
  EXPECT_EQ(s.title, "All");
  EXPECT_EQ(s.initial.profile, ProfileKind::tanh);
  EXPECT_EQ(s.initial.stress_left, 1.5);
  EXPECT_EQ(s.initial.stress_right, 0.5);
  EXPECT_EQ(s.initial.width, 2);
  EXPECT_EQ(s.friction.name(), "power");
  EXPECT_EQ(s.friction.parameter("coefficient"), 1);
  EXPECT_EQ(s.friction.parameter("exponent"), 0.5);
  EXPECT_EQ(s.friction.closure(), friction::Closure::paper);
  EXPECT_EQ(s.forcing, "0.1*x + t");
  EXPECT_DOUBLE_EQ(s.forcing_at(2, 3), 3.2);
  EXPECT_EQ(s.contact, "1 + x^2");
  EXPECT_DOUBLE_EQ(s.contact_at(-2), 5);
  EXPECT_EQ(*s.domain.left, -5);
  EXPECT_EQ(*s.domain.right, 6.5);
  EXPECT_EQ(s.end, 12);
  EXPECT_EQ(s.pulse.cells, 1000);
  EXPECT_EQ(s.pulse.tolerance, 1e-9);
  EXPECT_EQ(s.pulse.threshold, 0.01);
  EXPECT_EQ(s.chain.scale, 4.0);
  EXPECT_EQ(*s.chain.spacing, 0.05);
  EXPECT_EQ(s.chain.model, chain::Model::lattice);
  EXPECT_DOUBLE_EQ(*s.medium.shear_modulus, 30e9);
  EXPECT_DOUBLE_EQ(*s.medium.poisson_ratio, 0.3);
  EXPECT_DOUBLE_EQ(*s.medium.p_wave_speed, 6000);
  EXPECT_DOUBLE_EQ(*s.medium.s_wave_speed, 3200);
  EXPECT_DOUBLE_EQ(*s.medium.density, 2700);
  EXPECT_DOUBLE_EQ(*s.medium.contact_ratio, 4e-5);
  EXPECT_DOUBLE_EQ(*s.medium.asperity_spacing, 1e-3);
  EXPECT_EQ(s.output.times, (std::vector<double>{0, 1.5, 12}));
  EXPECT_EQ(s.output.variables.size(), 7u);
  EXPECT_EQ(*read(step + "[output]\nevery = 0.5\n").output.every, 0.5);
}

TEST(ScenarioFile, RejectsValuesOutOfRangeWithLineAndKey) {
  const std::vector<std::array<std::string, 2>> numbers = {
      {"friction", "coefficient"}, {"friction", "exponent"}, {"domain", "left"},
      {"domain", "right"},         {"time", "end"},          {"pulse", "cells"},
      {"pulse", "tolerance"},      {"pulse", "threshold"},   {"chain", "scale"},
      {"chain", "spacing"},        {"output", "every"},      {"medium", "poisson_ratio"},
      {"medium", "contact_ratio"}};
  for (const auto& [table, key] : numbers)
    for (const std::string bad : {"nan", "inf", "-inf", "1e400", "99999999999999999999", "\"word\"", "true", "[1]"})
      refused_setting(table, key, bad);
  const std::vector<std::array<std::string, 3>> bad = {{"friction", "coefficient", "-0.1"},
                                                       {"friction", "exponent", "0"},
                                                       {"friction", "exponent", "21"},
                                                       {"domain", "left", "1e10"},
                                                       {"time", "end", "0"},
                                                       {"time", "end", "-1"},
                                                       {"pulse", "cells", "3"},
                                                       {"pulse", "cells", "10000001"},
                                                       {"pulse", "cells", "40.5"},
                                                       {"pulse", "tolerance", "1e-13"},
                                                       {"pulse", "tolerance", "0.2"},
                                                       {"pulse", "threshold", "0"},
                                                       {"pulse", "threshold", "1"},
                                                       {"chain", "scale", "0"},
                                                       {"chain", "spacing", "0"},
                                                       {"chain", "model", "\"latice\""},
                                                       {"medium", "poisson_ratio", "0.5"},
                                                       {"medium", "poisson_ratio", "-1"},
                                                       {"medium", "contact_ratio", "0"},
                                                       {"medium", "density", "2700"},
                                                       {"medium", "density", "\"2 km\""},
                                                       {"medium", "density", "\"-1 kg/m3\""},
                                                       {"medium", "p_wave_speed", "\"5-6 km/s\""},
                                                       {"medium", "s_wave_speed", "[3]"},
                                                       {"output", "every", "0"},
                                                       {"output", "every", "1e-9"},
                                                       {"output", "times", "1"},
                                                       {"output", "times", "[1, 1]"},
                                                       {"output", "times", "[2, 1]"},
                                                       {"output", "times", "[-1]"},
                                                       {"output", "times", "[7]"},
                                                       {"output", "times", "[nan]"},
                                                       {"output", "times", "[\"a\"]"},
                                                       {"output", "variables", "[\"sigma\"]"},
                                                       {"output", "variables", "[]"},
                                                       {"output", "variables", "[\"k\", \"k\"]"},
                                                       {"output", "variables", "\"k\""},
                                                       {"friction", "law", "\"vicous\""},
                                                       {"friction", "law", "1"},
                                                       {"friction", "closure", "\"Paper\""},
                                                       {"forcing", "formula", "\"\""},
                                                       {"forcing", "formula", "\"1/t\""},
                                                       {"forcing", "formula", "\"y\""},
                                                       {"forcing", "formula", "nan"},
                                                       {"interface", "contact", "\"x\""},
                                                       {"interface", "contact", "\"t\""},
                                                       {"interface", "contact", "0"}};
  for (const auto& [table, key, value] : bad) refused_setting(table, key, value);
  EXPECT_TRUE(contains(refused_setting("output", "variables", "[\"sigma\"]").allowed, "'Sigma'"));
  EXPECT_TRUE(contains(refused_setting("friction", "law", "\"vicous\"").allowed, "'viscous'"));
  EXPECT_EQ(refused(step + "[output]\ntimes = [0,\n 2,\n 1]\n").line, 7u);
}

TEST(ScenarioFile, AcceptsTheEndsOfRanges) {
  EXPECT_EQ(read(step + "[pulse]\ncells = 4\ntolerance = 0.1\n").pulse.cells, 4);
  EXPECT_EQ(read(step + "[pulse]\ncells = 10000000\ntolerance = 1e-12\n").pulse.tolerance, 1e-12);
  EXPECT_EQ(read(step + "[friction]\nlaw = \"coulomb\"\ncoefficient = 0\n").friction.parameter("coefficient"), 0);
  EXPECT_EQ(read("[initial]\nstress_left = 0.0045\nstress_right = 1e6\n").stress(-1), 0.0045);
}

TEST(ScenarioFile, RejectsUnknownNamesAndContradictions) {
  EXPECT_EQ(refused("title = 1\n" + step).key, "title");
  EXPECT_EQ(refused("").problem, "there is no [initial] table");
  const Complaint table = refused(step + "[frction]\n");
  EXPECT_EQ(table.line, 4u);
  EXPECT_TRUE(contains(table.allowed, "'friction'"));
  EXPECT_EQ(refused(step + "[[time]]\nend = 1\n").problem, "not a table");
  EXPECT_EQ(refused("event = 1\n" + step).problem, "not a table");
  EXPECT_TRUE(contains(refused_setting("friction", "coeficient", "1").allowed, "'coefficient'"));
  refused_setting("chain", "x", "{ y = 1 }");
  EXPECT_TRUE(contains(refused_setting("friction", "coefficient", "1").problem, "law"));
  const auto friction = [](const std::string& rest) { return refused(step + "[friction]\n" + rest); };
  EXPECT_EQ(friction("law = \"none\"\ncoefficient = 1\n").line, 6u);
  EXPECT_EQ(friction("law = \"viscous\"\ncoefficient = 1\nexponent = 2\n").key, "friction.exponent");
  EXPECT_EQ(refused(step + "[output]\ntimes = [1]\nevery = 1\n").key, "output.every");
  EXPECT_EQ(refused(step + "[domain]\nleft = 1\nright = 1\n").line, 6u);
  EXPECT_EQ(read(step + "[friction]\nlaw = \"viscous\"\n").warnings.size(), 1u);  // and no coefficient
}

TEST(ScenarioFile, NamesTheKeyOfANumberThatIsInvalidToml) {
  const Complaint c = refused(step + "[output]\ntimes = [1,\n  1e400]\n");
  EXPECT_EQ(c.line, 6u);
  EXPECT_EQ(c.key, "output.times");
  EXPECT_EQ(refused("[initial\n").line, 1u);
  EXPECT_EQ(refused("[initial]\nprofile = t\nwidth = 1\n").line, 2u);  // the parser's message quotes the line break
  EXPECT_GT(refused("[\x06").line, 0u);                                // this once aborted inside the parser
}

TEST(ScenarioFile, SurvivesDeepNesting) {  // 400 kB of "a." overflow the stack of the TOML parser
  std::string keys = "a = 1\n";
  for (int i = 0; i < 200000; ++i) keys.insert(0, "a.");
  EXPECT_EQ(refused(step + keys).line, 4u);
  EXPECT_EQ(refused(step + "[initial.b" + keys.substr(0, 4000) + "]\n").problem, "nested too deeply");
  EXPECT_EQ(refused(step + "a = " + std::string(100000, '[')).problem, "nested too deeply");
  EXPECT_EQ(read("title = \"........... [[[[[[[[[[[[[[[[[[ \"  # ...........\n" + step).stress(-1), 1);
}

TEST(ScenarioFile, ReadsTextsOutsideAscii) {  // the TOML parser itself crashes on some of them
  const std::string letter = "\xC3\x94";
  EXPECT_EQ(refused(step + letter + " = 1\n").line, 4u);
  EXPECT_EQ(refused(step + "x = " + letter + "\n").line, 4u);
  EXPECT_EQ(refused(step + "\"" + letter + "\" = 1\n").key, "initial." + letter);
  EXPECT_EQ(refused(step + "profile = 2u=\"\\(pi*\xEF\xB3\xBF").line, 4u);
  EXPECT_EQ(read("title = \"\"\"a\\\n" + letter + "\"\"\"\n" + step).title, "a" + letter);
  EXPECT_EQ(read("\xEF\xBB\xBFtitle = 'a@b @40 " + letter + "'\n" + step).title, "a@b @40 " + letter);
  EXPECT_EQ(read("title = \"\\u00D4@\"\n" + step, {"time.end=1"}).title, letter + "@ (with time.end=1)");
  for (const std::string bad :
       {"\xFF", "\x80", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF0\x8F\xBF\xBF"})
    EXPECT_EQ(refused(step + "# " + bad + "\n").line, 4u);
  EXPECT_EQ(read(step + "# \xF4\x8F\xBF\xBF\xED\x9F\xBF\xE0\xA0\x80\n", {"title=" + letter}).title, letter);
}

}  // namespace
}  // namespace slipfront::scenario
