// Compares the table of units with UDUNITS-2, from which it has its names.
#include "text/units.hpp"

#include <gtest/gtest.h>
#include <udunits2.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "text/unit_names.hpp"

namespace {

using namespace slipfront;

struct Free {
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using UdUnit = std::unique_ptr<ut_unit, Free>;

ut_system* database() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    return ut_read_xml(nullptr);
  }();
  return system;
}

/// The factor by which UDUNITS-2 converts `text` to the SI unit with these powers. Not a number if it cannot.
double factor_by_udunits(const std::string& text, const std::array<int, 3>& powers) {
  std::string si;
  const char* const base[] = {"m", "kg", "s"};
  for (std::size_t i = 0; i < 3; ++i) si += (i ? "." : "") + std::string(base[i]) + "^" + std::to_string(powers[i]);
  const UdUnit from(ut_parse(database(), text.c_str(), UT_ASCII)), to(ut_parse(database(), si.c_str(), UT_ASCII));
  if (!from || !to || !ut_are_convertible(from.get(), to.get())) return std::nan("");
  const std::unique_ptr<cv_converter, Free> converter(ut_get_converter(from.get(), to.get()));
  return cv_convert_double(converter.get(), 0) == 0 ? cv_convert_double(converter.get(), 1) : std::nan("");
}

constexpr std::array<int, 3> kinds[] = {{1, 0, -1}, {1, 0, 0}, {0, 0, 1}, {-1, 1, -2}, {-3, 1, 0}, {0, 0, 0}};

/// Checks that UDUNITS-2 agrees about `text`. Returns whether it is a unit of mechanics.
bool expect_same(const std::string& text) {
  const std::optional<medium::Unit> unit = medium::parse_unit(text);
  const bool mechanical = unit && unit->factor != 0 && std::isfinite(unit->factor);
  if (mechanical) {
    EXPECT_NEAR(factor_by_udunits(text, unit->powers) / unit->factor, 1, 2e-15) << text;
  } else {
    for (const auto& kind : kinds) EXPECT_TRUE(std::isnan(factor_by_udunits(text, kind))) << text;
  }
  EXPECT_EQ(unit.has_value(), UdUnit(ut_parse(database(), text.c_str(), UT_ASCII)) != nullptr) << text;
  return mechanical;
}

/// The names of all units of mechanics.
std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto table : {medium::unit_names, medium::unit_symbols})
    for (const medium::NamedUnit& unit : table)
      if (unit.unit.factor != 0) all.emplace_back(unit.name);
  return all;
}

TEST(Units, RecognizeUnitsOutsideMechanics) {
  ASSERT_TRUE(database());
  for (const char* text : {"K", "V", "cd", "kat", "degC", "kelvin", "mV", "m K-1", "V/m"})
    EXPECT_FALSE(expect_same(text)) << text;
  for (const auto table : {medium::unit_names, medium::unit_symbols})
    for (const medium::NamedUnit& unit : table) EXPECT_EQ(expect_same(std::string(unit.name)), unit.unit.factor != 0);
}

TEST(Units, MatchUdunitsWithEveryPrefix) {
  ASSERT_TRUE(database());
  for (const std::string& name : names())
    for (const char* prefix :
         {"",         "yotta", "zetta", "exa",   "peta", "tera", "giga",  "mega", "kilo",  "hecto", "deka",
          "deci",     "centi", "milli", "micro", "nano", "pico", "femto", "atto", "zepto", "yocto", "KILO",
          "kilomega", "kilok", "Y",     "Z",     "E",    "P",    "T",     "G",    "M",     "k",     "h",
          "da",       "d",     "c",     "m",     "u",    "n",    "p",     "f",    "a",     "z",     "y"})
      expect_same(prefix + name);
}

TEST(Units, MatchUdunitsForProducts) {
  ASSERT_TRUE(database());
  const std::vector<std::string> all = names();
  std::mt19937 random(1);
  const auto one_of = [&](const auto& choices) { return choices[random() % std::size(choices)]; };
  const std::vector<std::string> prefixes = {"", "", "k", "milli"}, exponents = {"", "", "2", "-1", "^3", "^-2", "0"},
                                 joints = {"/", "*", ".", " "};
  for (int i = 0; i < 20000; ++i) {
    std::string text = one_of(prefixes) + one_of(all) + one_of(exponents);
    for (std::size_t more = random() % 4; more > 0; --more)
      text += one_of(joints) + one_of(prefixes) + one_of(all) + one_of(exponents);
    // After a blank, UDUNITS reads "percent" as "per cent".
    if (text.find(" per") == std::string::npos) expect_same(text);
  }
}

TEST(Units, MatchUdunitsForAnyLetters) {
  ASSERT_TRUE(database());
  std::mt19937 random(2);
  int known = 0;
  for (int i = 0; i < 50000; ++i) {
    std::string text;
    for (std::size_t size = 1 + random() % 4; size > 0; --size) text += "abcdefghiklmnoprstuyKMGTPHNgs"[random() % 29];
    known += expect_same(text) ? 1 : 0;
  }
  EXPECT_GT(known, 1000);
}

TEST(Units, RejectTextThatIsNoUnit) {
  for (const char* text : {"", " ", "km/", "km//s", "km  s", "km^", "km-", "10 km", "km per s", "(km)", "km s since",
                           "kilo", "k", "m12", "\xc2\xb5m"})
    EXPECT_FALSE(medium::parse_unit(text)) << text;
}

}  // namespace
