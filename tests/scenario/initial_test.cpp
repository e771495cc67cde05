#include <cmath>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

std::function<double(double)> formula(const std::string& text) {
  return read("[initial]\nprofile = \"formula\"\nformula = \"\"\"" + text + "\"\"\"\n").stress;
}

Complaint refused_formula(const std::string& text) {
  const Complaint c = refused([&] { formula(text); });
  EXPECT_EQ(c.key, "initial.formula");
  EXPECT_EQ(c.line, 3u);
  return c;
}

TEST(ScenarioInitial, StepAndTanhTakeTheirValues) {
  const Scenario s = read(step);
  EXPECT_EQ(s.stress(-1e-300), 1);
  EXPECT_EQ(s.stress(1e-300), 0);
  const Scenario smooth = read("[initial]\nprofile = \"tanh\"\nstress_left = 3\nstress_right = 1\nwidth = 0.5\n");
  for (const double x : {-20.0, -0.3, 0.0, 0.7, 20.0})
    EXPECT_NEAR(smooth.stress(x), 1 + 2 / (1 + std::exp(4 * x)), 1e-14) << x;
  EXPECT_TRUE(smooth.warnings.empty());
  EXPECT_EQ(read(step, {"initial.profile=tanh"}).initial.width, 1);
}

TEST(ScenarioInitial, RejectsKeysThatDoNotFitTheProfile) {
  EXPECT_EQ(refused("[initial]\n").key, "initial.stress_left");
  EXPECT_EQ(refused("[initial]\n").line, 1u);
  EXPECT_EQ(refused("[initial]\nstress_left = 1\n").key, "initial.stress_right");
  EXPECT_EQ(refused("[initial]\nprofile = \"formula\"\n").key, "initial.formula");
  EXPECT_EQ(refused("[initial]\nprofile = \"table\"\n").key, "initial.file");
  EXPECT_EQ(refused("[initial]\nprofile = \"tabel\"\n").line, 2u);
  for (const std::string key : {"width = 1", "formula = \"1\"", "file = \"f\""})
    EXPECT_EQ(refused(step + key).line, 4u);
  EXPECT_EQ(refused("[initial]\nprofile = \"formula\"\nformula = \"1\"\nstress_left = 1\n").key, "initial.stress_left");
  for (const std::string bad : {"-1", "0.0044", "1e-300", "1.1e6", "nan", "inf", "1e400", "\"1\""}) {
    const Complaint c = refused("[initial]\nstress_right = 1\nstress_left = " + bad + "\n");
    EXPECT_EQ(c.line, 3u);
    EXPECT_EQ(c.key, "initial.stress_left");
  }
  for (const std::string bad : {"0", "-1", "nan", "1e300"})
    EXPECT_EQ(refused(step, {"initial.profile=tanh", "initial.width=" + bad}).key, "initial.width");
}

TEST(ScenarioInitial, EvaluatesFormulas) {
  EXPECT_DOUBLE_EQ(formula("exp(-x^2) + 1")(0.5), std::exp(-0.25) + 1);
  EXPECT_DOUBLE_EQ(formula("5 - 2^-x^2 + 2^3^2 - 512")(1), 4.5);  // powers bind to the right and before the sign
  EXPECT_DOUBLE_EQ(formula("x < 0 ? 2 : x >= 1 && x != 2 ? 3 : 4")(2), 4);
  EXPECT_DOUBLE_EQ(formula("max(1, min(x, 3), 2)")(5), 3);
  EXPECT_DOUBLE_EQ(formula("abs(sign(x))*tanh(2) + sqrt(4) + log(e) + ln(e) + log10(100) + pi*1.5e0")(-3),
                   std::tanh(2) + 2 + 1 + 1 + 2 + std::acos(-1.0) * 1.5);
  EXPECT_DOUBLE_EQ(formula("1 +\n\t.5 + 1.")(0), 2.5);
  EXPECT_DOUBLE_EQ(read("[initial]\nprofile = \"formula\"\nformula = 2\n").stress(9), 2);
  const auto twice = formula("1 + x*x");  // a second call does not see the first one's x
  EXPECT_EQ(twice(2), 5);
  EXPECT_EQ(twice(1), 2);
}

TEST(ScenarioInitial, RejectsFormulasWithPosition) {
  const Complaint unknown = refused_formula("1 + tnh(x)");
  EXPECT_TRUE(contains(unknown.problem, "'tnh' at character 5")) << unknown.problem;
  EXPECT_TRUE(contains(unknown.allowed, "'tanh'"));
  EXPECT_TRUE(contains(refused_formula("x + t").problem, "character 5"));
  EXPECT_TRUE(contains(refused_formula("1 + 1e400").problem, "character 5"));
  EXPECT_TRUE(contains(refused_formula("1 + * 2").problem, "character 5"));
  for (const std::string bad :
       {"",      " ",        "x = 1", "1, 2",  "(1, 2)", "max(1", "1)",  "2x",  "2e",    "sin",      "sin()",
        "max()", "sin(1,2)", "'a'",   "1.5.2", "0x10",   "nan",   "inf", "1;2", "x ? 1", "\xC3\xA9", "#"})
    refused_formula(bad);
  EXPECT_NO_THROW(formula(std::string(100, '(') + "1" + std::string(100, ')')));
  refused_formula(std::string(101, '(') + "1" + std::string(101, ')'));
  EXPECT_NO_THROW(formula("1" + std::string(4095, ' ')));
  refused_formula("1" + std::string(4096, ' '));
  refused_formula(std::string(200000, '('));
}

TEST(ScenarioInitial, RejectsStressThatIsNoNumber) {
  for (const std::string bad :
       {"x", "-1", "1/x", "sqrt(x)", "log(x)", "max(1, sqrt(x))", "min(1, sqrt(x))", "1e7", "2 + sign(sqrt(x))"})
    EXPECT_TRUE(contains(refused_formula(bad).problem, "at x = "));
  // Right where it was tried, wrong elsewhere.
  const Complaint late = refused([] { formula("9 - x")(10); });
  EXPECT_EQ(late.line, 3u);
  EXPECT_EQ(late.value, "9 - x");
  EXPECT_EQ(late.problem, "the stress is -1 at x = 10");
  EXPECT_TRUE(contains(refused([] { read(step + "[forcing]\nformula = \"1/(x-8)\"\n").forcing_at(8, 1); }).problem,
                       "x = 8, t = 1"));
  EXPECT_EQ(refused([] { read(step + "[interface]\ncontact = \"9-x\"\n").contact_at(9); }).key, "interface.contact");
  EXPECT_EQ(refused("[initial]\nprofile=\"formula\"\nformula=\"9-x\"\n[domain]\nright=9.5\n").line, 3u);
}

TEST(ScenarioInitial, CountsTinyStressAsNoneAndWarnsOnce) {
  const Scenario s = read("[initial]\nprofile = \"formula\"\nformula = \"max(0, 0.01*(1 - x^2))\"\n");
  EXPECT_EQ(s.stress(0.9), 0);
  EXPECT_EQ(s.stress(0.5), 0.0075);
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_TRUE(contains(s.warnings[0], "0.0045"));
  EXPECT_EQ(read(step, {"initial.profile=tanh"}).warnings.size(), 1u);
  EXPECT_TRUE(read("[initial]\nprofile = \"formula\"\nformula = \"x < 1 ? 1 : 0\"\n").warnings.empty());
}

TEST(ScenarioInitial, CountsStressThatIsTinyForTheContactAsNone) {
  const std::string tail = "[initial]\nprofile = \"formula\"\nformula = \"max(0, 0.01*(1 - x^2))\"\n";
  const std::string domain = "[domain]\nleft = -1\nright = 1\n[interface]\ncontact = ";
  const Scenario s = read(tail + domain + "\"2\"\n");
  EXPECT_EQ(s.stress(0.5), 0);
  EXPECT_EQ(s.stress(0.1), 0.0099);
  ASSERT_EQ(s.warnings.size(), 1u);
  EXPECT_TRUE(contains(s.warnings[0], "stress over contact ratio"));
  EXPECT_EQ(read(tail + domain + "\"0.5\"\n").stress(0.9), 0);  // no stress below 0.0045, whatever the contact
  const Complaint all = refused(tail + domain + "\"3\"\n");
  EXPECT_EQ(all.key, "interface.contact");
  EXPECT_TRUE(contains(all.problem, "below 0.0045 everywhere"));
}

TEST(ScenarioTable, InterpolatesMonotonically) {
  const std::string text = "[initial]\nprofile = \"table\"\nfile = \"t.csv\"\n";
  const Rows rows = {{-2, 0}, {-1, 0}, {0, 4}, {0.5, 4.1}, {3, 0}, {4, 0}};
  const Scenario s = read(text, {}, rows);
  for (const auto& [x, stress] : rows) EXPECT_DOUBLE_EQ(s.stress(x), stress);
  for (std::size_t i = 1; i < rows.size(); ++i)
    for (int j = 0; j < 100; ++j) {
      const auto at = [&, i](int k) { return rows[i - 1].first + (rows[i].first - rows[i - 1].first) * k / 100.0; };
      const double rise = s.stress(at(j + 1)) - s.stress(at(j));
      EXPECT_GE(rise * (rows[i].second - rows[i - 1].second), 0) << at(j);
    }
  EXPECT_DOUBLE_EQ(read(text, {}, {{0, 1}, {2, 3}}).stress(0.5), 1.5);
  // A parabola's inner slopes are near enough that halving the step divides the error by 4 at least.
  const auto error = [&](double h) {
    Rows parabola;
    for (int i = 0; i * h <= 4; ++i) parabola.push_back({i * h, 1 + i * h * i * h});
    return std::fabs(read(text, {}, parabola).stress(2 + 0.4 * h) - 1 - (2 + 0.4 * h) * (2 + 0.4 * h));
  };
  EXPECT_LT(error(0.1), error(0.2) / 4);
  EXPECT_LT(error(0.2), 1e-3);
}

TEST(ScenarioTable, RejectsWhatIsNoTable) {
  const std::string text = "[initial]\nprofile = \"table\"\nfile = \"t.csv\"\n";
  const double nan = std::nan("");
  for (const Rows& rows : std::vector<Rows>{{},
                                            {{0, 1}},
                                            {{0, 1}, {0, 1}},
                                            {{1, 1}, {0, 1}},
                                            {{0, 1}, {1, -1}},
                                            {{0, nan}, {1, 1}},
                                            {{nan, 1}, {1, 1}},
                                            {{0, 1}, {HUGE_VAL, 1}},
                                            {{0, 1}, {1, 2e6}},
                                            {{0, 0}, {1e-300, 1e6}}}) {
    const Complaint c = refused(text, {}, rows);
    EXPECT_EQ(c.line, 3u);
    EXPECT_EQ(c.key, "initial.file");
  }
  const Complaint outside = refused([&] { read(text, {}, {{0, 1}, {1, 1}}).stress(1.5); });
  EXPECT_EQ(outside.problem, "the table does not cover x = 1.5");
  EXPECT_EQ(refused(text + "[domain]\nright = 2\n", {}, {{0, 1}, {1, 1}}).allowed, "0 <= x <= 1");
  EXPECT_EQ(refused(text, {"initial.file="}).problem, "not a path");
  EXPECT_EQ(refused([&] { read_scenario(text, "s.toml", {}, {}); }).key, "initial.file");
}

TEST(ScenarioTable, IsFoundNextToTheScenario) {
  const auto path = [](const std::string& scenario, const std::string& table) {
    std::string asked;
    read_scenario("[initial]\nprofile = \"table\"\n", scenario, {"initial.file=" + table},
                  [&](const std::string& p, const std::vector<std::string>&) {
                    asked = p;
                    return std::vector<std::vector<double>>{{0, 1}, {1, 1}};
                  });
    return asked;
  };
  EXPECT_EQ(path("a/b.toml", "t.csv"), "a/t.csv");
  EXPECT_EQ(path("b.toml", "t.csv"), "t.csv");
  EXPECT_EQ(path("a/b.toml", "/c/t.csv"), "/c/t.csv");
  EXPECT_THROW(
      read_scenario("[initial]\nprofile = \"table\"\nfile = \"t\"\n", "s.toml", {},
                    [](const std::string& p, const std::vector<std::string>&) -> std::vector<std::vector<double>> {
                      throw FileError(p);
                    }),
      FileError);
}

}  // namespace
}  // namespace slipfront::scenario
