#include "slipfront/scenario/keys.hpp"

#include <algorithm>
#include <set>

#include "support.hpp"

namespace slipfront::scenario {
namespace {

/// A value of the wrong type for a key, as TOML. Formulas accept texts and numbers.
std::string wrong_value(const Key& key) { return key.type == KeyType::truth ? "\"maybe\"" : "true"; }

/// A scenario with one more key, in its table.
std::string with(const Key& key, const std::string& value) {
  const std::string entry = std::string(key.name) + " = " + value + "\n";
  if (key.table == "initial") return step + entry;
  if (key.table == "friction" && key.name != "law") {
    const std::string law(key.laws.empty() ? "viscous" : key.laws.front());
    return step + "[friction]\nlaw = \"" + law + "\"\n" + entry;
  }
  return step + "[" + std::string(key.table) + "]\n" + entry;
}

std::vector<Key> keys_in_tables() {
  std::vector<Key> found;
  for (const Key& key : keys())
    if (!key.table.empty()) found.push_back(key);
  return found;
}

TEST(ScenarioKeys, HaveAMeaningAndAreListedOnce) {
  std::set<std::string> names;
  for (const Key& key : keys()) {
    EXPECT_FALSE(key.meaning.empty()) << key.table << "." << key.name;
    EXPECT_TRUE(names.insert(std::string(key.table) + "." + std::string(key.name)).second) << key.table << key.name;
  }
}

// A key that the list has and the reader ignores would be accepted with any value.
TEST(ScenarioKeys, AreAllRead) {
  for (const Key& key : keys_in_tables()) {
    if (key.table == "initial" && (key.name == "width" || key.name == "formula" || key.name == "file")) continue;
    const Complaint c = refused(with(key, wrong_value(key)));
    EXPECT_EQ(c.key, std::string(key.table) + "." + std::string(key.name)) << c.problem;
  }
}

TEST(ScenarioKeys, NameExactlyTheWordsThatTheReaderAllows) {
  for (const Key& key : keys_in_tables()) {
    if (key.type != KeyType::word) continue;
    std::vector<std::string_view> words = key.words;
    std::string all;
    for (const std::string_view word : words) all += (all.empty() ? "" : ", ") + std::string(word);
    const Complaint c = refused(with(key, "\"qqqqqqqqqqqqqqqqqqqq\""));
    EXPECT_EQ(c.allowed, all) << key.table << "." << key.name;
  }
}

TEST(ScenarioKeys, StateTheDefaultsOfTheReader) {
  const Scenario without = read(step);
  for (const Key& key : keys_in_tables()) {
    const bool plain = key.type == KeyType::number || key.type == KeyType::whole_number || key.type == KeyType::word ||
                       key.type == KeyType::truth;
    if (!plain || key.table == "loading" || key.table == "domain" || key.table == "plane" ||
        key.table == "nucleation" || (key.table == "friction" && !key.laws.empty()))
      continue;
    const bool word = key.type == KeyType::word;
    const std::string value = word ? '"' + std::string(key.otherwise) + '"' : std::string(key.otherwise);
    if (!word && key.type != KeyType::truth && value.find_first_not_of("0123456789.e-") != std::string::npos) continue;
    if (key.name == "width" || (key.table == "chain" && key.name == "tolerance")) continue;
    SCOPED_TRACE(value);
    const Scenario stated = read(with(key, value));
    EXPECT_EQ(stated.initial.profile, without.initial.profile);
    EXPECT_EQ(stated.initial.hold, without.initial.hold);
    EXPECT_EQ(stated.pulse.cells, without.pulse.cells);
    EXPECT_EQ(stated.pulse.tolerance, without.pulse.tolerance);
    EXPECT_EQ(stated.pulse.threshold, without.pulse.threshold);
    EXPECT_EQ(stated.pulse.left, without.pulse.left);
    EXPECT_EQ(stated.pulse.right, without.pulse.right);
    EXPECT_EQ(stated.pulse.periodic, without.pulse.periodic);
    EXPECT_EQ(stated.chain.scale.value_or(1), without.chain.scale.value_or(1));
    EXPECT_EQ(stated.chain.model, without.chain.model);
    EXPECT_EQ(stated.chain.left, without.chain.left);
    EXPECT_EQ(stated.chain.right, without.chain.right);
    EXPECT_EQ(stated.chain.periodic, without.chain.periodic);
    EXPECT_EQ(stated.chain.implicit, without.chain.implicit);
    EXPECT_EQ(stated.friction.name(), key.name == "closure" || (key.table == "friction" && key.name == "units")
                                          ? "viscous"
                                          : without.friction.name());
    EXPECT_EQ(stated.friction.closure(), without.friction.closure());
  }
}

TEST(ScenarioKeys, StateTheDefaultsOfAPlane) {
  const Scenario plane = read(
      "[plane]\nleft = -1\nright = 1\nbottom = -1\ntop = 1\n"
      "[initial]\nprofile = \"formula\"\nformula = \"3 + x + y\"\n");
  ASSERT_TRUE(plane.plane);
  EXPECT_EQ(plane.plane->problem.slip(0.25, 0.5), 3.75);
  const auto stated = [](std::string_view name) {
    for (const Key* key : keys_of("plane"))
      if (key->name == name) return key->otherwise;
    return std::string();
  };
  EXPECT_EQ(stated("cells"), std::to_string(plane.plane->cells));
  EXPECT_EQ(stated("loops"), std::to_string(plane.plane->loops));
  EXPECT_EQ(stated("angles"), std::to_string(plane.plane->angles));
  EXPECT_EQ(std::stod(stated("wave_speed_ratio")), plane.plane->wave_speed_ratio);
}

}  // namespace
}  // namespace slipfront::scenario
