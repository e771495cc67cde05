#include "slipfront/text/quantity.hpp"

#include <gtest/gtest.h>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using medium::Dimension;
using medium::parse_quantity;

double one(std::string_view text, Dimension dimension, std::string_view unit = {}) {
  const medium::Span span = parse_quantity(text, dimension, unit);
  EXPECT_EQ(span.low, span.high);
  return span.low;
}

TEST(Quantity, ReadsTheCommonNotations) {
  EXPECT_DOUBLE_EQ(one("3.0 km/s", Dimension::velocity), 3000);
  EXPECT_DOUBLE_EQ(one("10 km/day", Dimension::velocity), 10e3 / 86400);
  EXPECT_DOUBLE_EQ(one(" 10km/d ", Dimension::velocity), 10e3 / 86400);
  EXPECT_NEAR(one("30 mm/yr", Dimension::velocity), 0.03 / 31556925.9747, 1e-15);
  EXPECT_DOUBLE_EQ(one("30 GPa", Dimension::pressure), 30e9);
  EXPECT_DOUBLE_EQ(one("2 weeks", Dimension::time), 1209600);
  EXPECT_DOUBLE_EQ(one("2.7 g/cm^3", Dimension::density), 2700);
  EXPECT_DOUBLE_EQ(one("3 m s-1", Dimension::velocity), 3);
  EXPECT_DOUBLE_EQ(one("3 km.s^-1", Dimension::velocity), 3000);
  EXPECT_DOUBLE_EQ(one("1e-3 m", Dimension::length), 1e-3);
  EXPECT_DOUBLE_EQ(one("+0.25", Dimension::ratio), 0.25);
  EXPECT_DOUBLE_EQ(one("1 %", Dimension::ratio), 0.01);
  EXPECT_DOUBLE_EQ(one("2.8", Dimension::velocity, "km/s"), 2800);
  EXPECT_DOUBLE_EQ(one("2.8 m/s", Dimension::velocity, "km/s"), 2.8);  // its own unit wins
}

TEST(Quantity, ReadsRangesAsRanges) {
  const medium::Span span = parse_quantity("2-15 km/day", Dimension::velocity);
  EXPECT_DOUBLE_EQ(span.low, 2e3 / 86400);
  EXPECT_DOUBLE_EQ(span.high, 15e3 / 86400);
  EXPECT_DOUBLE_EQ(parse_quantity("1e-3 - 2e-3", Dimension::length, "m").high, 2e-3);
  EXPECT_DOUBLE_EQ(parse_quantity("-2--1", Dimension::ratio).low, -2);
}

TEST(Quantity, RejectsTextAndNamesTheAllowed) {
  const struct {
    const char* text;
    Dimension dimension;
  } bad[] = {{"3 km", Dimension::velocity},
             {"3", Dimension::velocity},
             {"km/s", Dimension::velocity},
             {"1e400 km/s", Dimension::velocity},
             {"nan km/s", Dimension::velocity},
             {"inf m", Dimension::length},
             {"3 furlong/fortnightt", Dimension::velocity},
             {"3 km/s km", Dimension::velocity},
             {"3,5 km/s", Dimension::velocity},
             {"1e300 Gm/s", Dimension::velocity},
             {"5-2 km/s", Dimension::velocity},
             {"3- km/s", Dimension::velocity},
             {"20 degC", Dimension::ratio},
             {"", Dimension::time},
             {"5 lg(re 1 mW)", Dimension::ratio},
             {"2 10 km/s", Dimension::velocity},
             {"3 (km", Dimension::length},
             {"0.3 m", Dimension::ratio},
             {"3 km per s", Dimension::velocity},
             {"3 km/", Dimension::velocity},
             {"3 km//s", Dimension::velocity},
             {"3 m s since", Dimension::length},
             {"3 km^", Dimension::length}};
  for (const auto& b : bad) {
    try {
      parse_quantity(b.text, b.dimension);
      FAIL() << b.text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.complaint().value.find_first_not_of(' '), error.complaint().value.empty() ? std::string::npos : 0)
          << b.text;
      EXPECT_FALSE(error.complaint().problem.empty()) << b.text;
      EXPECT_FALSE(error.complaint().allowed.empty()) << b.text;
    }
  }
}

TEST(Number, AcceptsOnlyAWholeFiniteNumber) {
  EXPECT_EQ(medium::number("1.5"), 1.5);
  EXPECT_EQ(medium::number(" +2e3\t"), 2000);
  for (const char* bad : {"", "x", "1.5x", "1e400", "nan", "inf", "0x10", "1,5", "+", "--1"})
    EXPECT_FALSE(medium::number(bad)) << bad;
}

}  // namespace
