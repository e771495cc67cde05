#include "slipfront/events/catalogue/read.hpp"

#include <gtest/gtest.h>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;

std::vector<Entry> csv(std::string_view text) {
  std::vector<Entry> entries;
  read_csv(text, "t.csv", [&](Entry&& e) { entries.push_back(std::move(e)); });
  return entries;
}

Complaint refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.complaint();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

TEST(Csv, ReadsUnitsFromHeaderAndCell) {
  const auto rows =
      csv("name,rupture_velocity_km_s,slip_velocity [cm/day],vs_at_hypocentre_km_s,poisson_ratio,source,mood\n"
          "\"A, the first\",2.8,10,3.3,0.25,\"X \"\"et\"\" al.\",good\r\n"
          "B,10 km/day,,,,,\n");
  ASSERT_EQ(rows.size(), 2u);
  const Observation& a = rows[0].observation;
  EXPECT_EQ(a.name, "A, the first");
  EXPECT_EQ(a.citation, "X \"et\" al.");
  EXPECT_DOUBLE_EQ(a.rupture_velocity_m_s->middle(), 2800);
  EXPECT_DOUBLE_EQ(a.slip_velocity_m_s->middle(), 0.1 / 86400);
  EXPECT_DOUBLE_EQ(*a.s_wave_speed, 3300);
  EXPECT_EQ(a.line, 2u);
  EXPECT_DOUBLE_EQ(rows[1].observation.rupture_velocity_m_s->middle(), 1e4 / 86400);
  EXPECT_FALSE(rows[1].observation.slip_velocity_m_s);
}

TEST(Toml, ReadsDistributionsAsTables) {
  const Observation o = read_toml(
      "[event]\nrupture_velocity = { mean = \"3 km/s\", sd = \"200 m/s\" }\n"
      "slip_velocity = { median = \"0.5 m/s\", factor = 1.2 }\n"
      "duration = { low = \"1 day\", high = \"2 weeks\" }\n"
      "[medium]\ncontact_ratio = { mean = 0.01, sd = 0.002 }\n",
      "t.toml");
  const Observation same = read_toml(
      "[event]\nrupture_velocity = \"3.0 +- 0.2 km/s\"\nslip_velocity = \"0.5 */ 1.2 m/s\"\nduration = \"1..14 day\"\n"
      "[medium]\ncontact_ratio = \"0.01 +- 0.002\"\n",
      "t.toml");
  const auto expect_same = [](const MeasuredValue& a, const MeasuredValue& b) {
    EXPECT_DOUBLE_EQ(a.low, b.low);
    EXPECT_DOUBLE_EQ(a.high, b.high);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_DOUBLE_EQ(a.spread, b.spread);
  };
  expect_same(*o.rupture_velocity_m_s, *same.rupture_velocity_m_s);
  expect_same(*o.slip_velocity_m_s, *same.slip_velocity_m_s);
  expect_same(*o.duration, *same.duration);
  expect_same(o.uncertain_constants.at(0).measured, same.uncertain_constants.at(0).measured);
}

TEST(Toml, RejectsTablesThatAreNoDistribution) {
  const auto c = [](const std::string& table) {
    return refusal([&] { read_toml("[event]\nslip_velocity = " + table + "\n", "t.toml"); });
  };
  EXPECT_EQ(c("{ meen = \"3 m/s\", sd = \"1 m/s\" }").key, "event.slip_velocity.meen");
  EXPECT_EQ(c("{ meen = \"3 m/s\", sd = \"1 m/s\" }").allowed, "'mean' (the nearest known key)");
  EXPECT_EQ(c("{ mean = \"3 m/s\", sd = \"0 m/s\" }").key, "event.slip_velocity.sd");
  EXPECT_EQ(c("{ mean = \"3 m/s\", sd = \"0 m/s\" }").line, 2u);
  EXPECT_EQ(c("{ median = \"3 m/s\", factor = 1 }").allowed, "> 1");
  EXPECT_EQ(c("{ low = \"3 m/s\", high = \"1 m/s\" }").problem, "the range runs downwards");
  EXPECT_EQ(c("{ low = \"1..2 m/s\", high = \"1 m/s\" }").problem, "not one number");
  EXPECT_EQ(c("{ mean = \"-3 m/s\", sd = \"1 m/s\" }").allowed, "> 0");
  EXPECT_EQ(c("{ mean = [3], sd = \"1 m/s\" }").key, "event.slip_velocity.mean");
  for (const char* table : {"{}", "{ mean = \"3 m/s\" }", "{ mean = \"3 m/s\", factor = 2 }",
                            "{ low = \"1 m/s\", high = \"2 m/s\", sd = \"1 m/s\" }"})
    EXPECT_EQ(c(table).problem, "these keys do not make a distribution") << table;
  EXPECT_NE(c("{ mean = \"3 m\", sd = \"1 m/s\" }").problem, "");
}

TEST(Csv, ReadsPublishedColumnNames) {
  const auto rows =
      csv("name,year,duration_days,slip_cm,slip_type,length_km,slip_velocity_cm_day,slip_velocity_how,rupture_velocity_"
          "km_day,rv_min_km_day,rv_max_km_day,rupture_velocity_how\n"
          "one,1999,49,3.8,max,300,0.07755,computed slip/duration,6.122,,,computed length/duration (apparent)\n"
          "range,2008,7-14,,,,,,,2,15,stated\n"
          "cap,2012,,,,,,,,,2592,stated\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_DOUBLE_EQ(rows[0].observation.duration->middle(), 49 * 86400.0);
  EXPECT_DOUBLE_EQ(rows[0].observation.slip->middle(), 0.038);
  EXPECT_EQ(rows[0].observation.warnings.size(), 2u);  // both velocities are computed, not observed
  EXPECT_DOUBLE_EQ(rows[1].observation.rupture_velocity_m_s->low, 2e3 / 86400);
  EXPECT_DOUBLE_EQ(rows[1].observation.rupture_velocity_m_s->high, 15e3 / 86400);
  EXPECT_TRUE(rows[1].observation.duration->is_range());
  EXPECT_FALSE(rows[2].observation.rupture_velocity_m_s);
  EXPECT_EQ(rows[2].observation.warnings.size(), 1u);  // an upper bound is not an observation
}

TEST(Csv, KeepsTheOtherRowsOfABadOne) {
  const auto rows =
      csv("name,rupture_velocity_km_s,slip_velocity_m_s\n"
          "good,2.8,0.5\n"
          "short,2.8\n"
          "word,fast,0.5\n"
          "huge,1e400,0.5\n"
          "negative,-2.8,0.5\n"
          "unit,3 km,0.5\n"
          "good too,2.9,0.4\n");
  ASSERT_EQ(rows.size(), 7u);
  for (const std::size_t good : {0u, 6u}) EXPECT_FALSE(rows[good].error);
  for (std::size_t bad = 1; bad < 6; ++bad) {
    ASSERT_TRUE(rows[bad].error) << bad;
    EXPECT_EQ(rows[bad].error->line, bad + 2);
    EXPECT_EQ(rows[bad].error->file, "t.csv");
    EXPECT_FALSE(rows[bad].error->allowed.empty());
    if (bad > 1) {
      EXPECT_EQ(rows[bad].error->key, "rupture_velocity_km_s");
    }
  }
  EXPECT_EQ(rows[3].error->value, "1e400");
}

TEST(Csv, RejectsUnknownHeaders) {
  EXPECT_EQ(refusal([] { csv("name,rupture_velocty_km_s\nA,1\n"); }).key, "rupture_velocty_km_s");
  EXPECT_EQ(refusal([] { csv("name,rupture_velocity_km\nA,1\n"); }).key, "rupture_velocity_km");
  EXPECT_EQ(refusal([] { csv("name,slip_m,slip_m\nA,1,1\n"); }).problem, "column given twice");
  refusal([] { csv("name,colour\nA,red\n"); });
  refusal([] { csv("name,slip_m\n"); });
  refusal([] { csv(""); });
}

TEST(Csv, CountsLinesThroughQuotedBreaksAndBlankLines) {
  const auto rows = csv("\xEF\xBB\xBFname,slip_m\n\n\"two\nlines\",1\n\nlast,x\n\"never closed,1\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].observation.line, 3u);
  EXPECT_EQ(rows[1].error->line, 6u);
  EXPECT_EQ(rows[2].error->line, 7u);
  EXPECT_NE(rows[2].error->problem.find("quote"), std::string::npos);
}

TEST(Toml, ReadsOneEvent) {
  const Observation o = read_toml(
      "[event]\nname = \"P\"\ndate = 2004-09-28\nrupture_velocity = \"2.5-3.5 km/s\"\n[medium]\npoisson_ratio = "
      "0.3\np_wave_speed = \"6 km/s\"\n",
      "p.toml");
  EXPECT_EQ(o.name, "P");
  EXPECT_EQ(o.date, "2004-09-28");
  EXPECT_DOUBLE_EQ(o.rupture_velocity_m_s->high, 3500);
  EXPECT_EQ(*o.poisson_ratio, 0.3);
  EXPECT_EQ(o.line, 1u);
}

TEST(Toml, RejectsWithLineKeyAndNearestName) {
  const auto refused = [](std::string_view text) { return refusal([&] { read_toml(text, "p.toml"); }); };
  const Complaint typo = refused("[event]\nrupture_velocty = \"3 km/s\"\n");
  EXPECT_EQ(typo.line, 2u);
  EXPECT_EQ(typo.key, "event.rupture_velocty");
  EXPECT_NE(typo.allowed.find("'rupture_velocity'"), std::string::npos);
  EXPECT_EQ(refused("[event]\nrupture_velocity = \"3 km\"\n").value, "3 km");
  EXPECT_EQ(refused("[event]\nrupture_velocity = 3.0\n").problem, "a number without a unit");
  EXPECT_EQ(refused("[event]\nrupture_velocity = [1, 2]\n").line, 2u);
  EXPECT_EQ(refused("[event]\nrupture_velocity = \"-1 km/s\"\n").problem, "not positive");
  const Complaint misplaced = refused("[event]\np_wave_speed = \"6 km/s\"\n");
  EXPECT_EQ(misplaced.key, "event.p_wave_speed");
  EXPECT_EQ(misplaced.allowed, "p_wave_speed in [medium]");
  EXPECT_EQ(refused("[event]\n[medium]\nslip = \"1 m\"\n").allowed, "slip in [event]");
  EXPECT_EQ(refused("[event]\n[medium]\nshear_modulus = \"20-30 km\"\n").key, "medium.shear_modulus");
  EXPECT_EQ(refused("[evnt]\n").key, "evnt");
  EXPECT_EQ(refused("event = 3\n").problem, "not a table");
  EXPECT_EQ(refused("[medium]\n").problem, "there is no [event] table");
  EXPECT_EQ(refused("[event\n").line, 1u);
  EXPECT_GT(refused("[\x06").line, 0u);                    // once an abort inside the parser
  for (const char* letter : {"\xC3\xA9", "\xEF\xB3\xBF"})  // undefined behaviour inside the parser, found by fuzz_toml
    EXPECT_EQ(refused("[event]\n" + std::string(letter) + " = 1\n").line, 2u);
  EXPECT_EQ(refused("[event]\nrupture_velocity = \"1e400 km/s\"\n").problem, "not a finite number");
}

TEST(ReadEvents, RecognizesTheFormats) {
  const auto names = [](std::string_view text, const char* file) {
    std::string all;
    read_events(text, file, [&](Entry&& e) { all += (e.error ? "!" : "") + e.observation.name + ";"; });
    return all;
  };
  EXPECT_EQ(names("[event]\nname = \"T\"\n", "stdin"), "T;");
  EXPECT_EQ(names("# c\n[event]\nname = \"T\"\n", "stdin"), "T;");
  EXPECT_EQ(names("name,slip_m\nC,1\n", "stdin"), "C;");
  EXPECT_EQ(names("name,slip_m\nC,1\n", "x.toml"), "!x.toml;");
  EXPECT_EQ(names(" \n", "empty"), "!empty;");
  EXPECT_EQ(names("% not a model\n", "stdin"), "!stdin;");
}

}  // namespace
