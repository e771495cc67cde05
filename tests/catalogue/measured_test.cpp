#include "slipfront/events/catalogue/measured.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using Shape = MeasuredValue::Shape;
using medium::Dimension;

MeasuredValue read(const char* text) { return parse_measured(text, Dimension::velocity, "km/s"); }

TEST(MeasuredValue, ReadsEveryForm) {
  for (const char* text : {"3.0 +- 0.2 km/s", "3.0 +/- 0.2 km/s", "3.0 \xC2\xB1 0.2 km/s", "normal(3.0, 0.2) km/s",
                           "3.0 +- 0.2", " normal( 3.0 ,0.2 ) "}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::normal) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 3000) << text;
    EXPECT_DOUBLE_EQ(m.spread, 200) << text;
  }
  for (const char* text : {"2.8..3.2 km/s", "2.8 - 3.2 km/s", "uniform(2.8, 3.2) km/s", "2.8 .. 3.2"}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::range) << text;
    EXPECT_DOUBLE_EQ(m.low, 2800) << text;
    EXPECT_DOUBLE_EQ(m.high, 3200) << text;
  }
  for (const char* text : {"3 */ 1.2 km/s", "lognormal(3, 1.2) km/s"}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::lognormal) << text;
    EXPECT_DOUBLE_EQ(m.low, 3000) << text;
    EXPECT_DOUBLE_EQ(m.spread, 1.2) << text;
  }
  EXPECT_TRUE(read("3 km/s").is_exact());
}

TEST(MeasuredValue, ReadsAPercentageAsAShareOfTheValue) {
  for (const char* text : {"2.7 +- 10% km/s", "2.7 +- 10 % km/s", "2.7 +/- 10 %", "2.7 \xC2\xB1 10% km/s"}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::normal) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 2700) << text;
    EXPECT_DOUBLE_EQ(m.spread, 270) << text;
  }
}

TEST(MeasuredValue, ReadsTheUnitBehindEitherNumber) {
  for (const char* text :
       {"2.7 km/s +- 0.2", "2.7 km/s +- 0.2 km/s", "2.7km/s+-0.2", "2.7 \xC2\xB1 0.2 km s-1", "2.7(2) km/s",
        "2.70(20) km/s", "2.7 +0.2/-0.2", "2.7 km s\xE2\x81\xBB\xC2\xB9 \xC2\xB1 0.2"}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::normal) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 2700) << text;
    EXPECT_NEAR(m.spread, 200, 1e-9) << text;
  }
  EXPECT_DOUBLE_EQ(read("2.7 km/s +- 10%").spread, 270);
  EXPECT_DOUBLE_EQ(read("27(3)").spread, 3000);
  for (const char* text : {"2.5 to 3.0 km/s",
                           "2.5\xE2\x80\x93"
                           "3.0 km/s",
                           "2.5 \xE2\x80\x94 3.0", "2.5 km/s to 3.0 km/s"}) {
    EXPECT_DOUBLE_EQ(read(text).low, 2500) << text;
    EXPECT_DOUBLE_EQ(read(text).high, 3000) << text;
  }
}

TEST(MeasuredValue, ReadsPowersOfTen) {
  for (const char* text : {"1.2e18 N m", "1.2E+18 Nm", "1.2 x 10^18 N m",
                           "1.2\xC3\x97"
                           "10^18 N-m",
                           "1.2x10^25 dyn cm", "1.2 \xC3\x97 10\xC2\xB9\xE2\x81\xB8 N\xC2\xB7m"})
    EXPECT_DOUBLE_EQ(parse_measured(text, Dimension::moment, "").middle(), 1.2e18) << text;
  EXPECT_THROW(parse_measured("1.2x1018 N m", Dimension::moment, ""), InputError);
}

TEST(MeasuredValue, ReadsUnequalErrors) {
  for (const char* text : {"2.7 +0.3/-0.1 km/s", "2.7 +0.3 -0.1", "2.7+0.3-0.1", "2.7 (+0.3/-0.1) km/s",
                           "2.7 km/s +0.3/-0.1", "2.7 -0.1/+0.3 km/s", "2.7 (-0.1, +0.3)",
                           "2.7 +0.3/\xE2\x88\x92"
                           "0.1"}) {
    const MeasuredValue m = read(text);
    EXPECT_EQ(m.shape, Shape::split) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 2700) << text;
    EXPECT_DOUBLE_EQ(m.spread, 300) << text;
    EXPECT_DOUBLE_EQ(m.spread_below, 100) << text;
    EXPECT_NEAR(m.likelihood(3000), std::exp(-0.5), 1e-12);
    EXPECT_NEAR(m.likelihood(2600), std::exp(-0.5), 1e-12);
    EXPECT_NEAR(m.quantile(0.25), 2700, 1e-9);  // a quarter of the area is below the most likely value
  }
}

TEST(MeasuredValue, ReadsBounds) {
  for (const char* text : {"<2.7", "< 2.7 km/s", "<= 2.7 km/s", "\xE2\x89\xA4 2.7"}) {
    const auto bound = parse_bound(text, Dimension::velocity, "km/s");
    ASSERT_TRUE(bound) << text;
    EXPECT_TRUE(bound->is_upper);
    EXPECT_DOUBLE_EQ(bound->limit, 2700);
  }
  EXPECT_FALSE(parse_bound("> 2.7", Dimension::velocity, "km/s")->is_upper);
  EXPECT_FALSE(parse_bound("2.7", Dimension::velocity, "km/s"));
  EXPECT_THROW(parse_bound("< 2.7 +- 0.1", Dimension::velocity, "km/s"), InputError);
}

TEST(MeasuredValue, RejectsPercentagesThatItDoesNotUnderstand) {
  for (const char* text :
       {"2.7 +- -10 % km/s", "2.7 */ 10 % km/s", "2.7 % km/s", "2..3 % km/s", "normal(2.7, 10 %) km/s"})
    EXPECT_THROW(read(text), InputError) << text;
  EXPECT_THROW(parse_measured("0.3 +- 10 %", Dimension::ratio, ""), InputError);
  EXPECT_DOUBLE_EQ(parse_measured("3 %", Dimension::ratio, "").middle(), 0.03);
}

TEST(MeasuredValue, RejectsWithTheReason) {
  const auto complaint = [](const char* text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const auto& [text, says] : {std::pair("3 +- 0 km/s", "the uncertainty is 0"),
                                   {"3 +- -1 km/s", "the uncertainty is -1"},
                                   {"3 +- x km/s", "not a finite number"},
                                   {"3 */ 1 km/s", "factor"},
                                   {"lognormal(3, 0.9) km/s", "factor"},
                                   {"gaussian(3, 1) km/s", "unknown distribution 'gaussian'"},
                                   {"normall(3, 1) km/s", "'normal'"},
                                   {"normal(3) km/s", "two numbers"},
                                   {"3.2..2.8 km/s", "downwards"},
                                   {"3 +- 1e400 km/s", "not a finite number"},
                                   {"3 +- 1 kg", "kg"},
                                   {"(", "unknown distribution"},
                                   {"2,7 km/s", "a comma inside a number"},
                                   {"2.7 km/s +- 0.2 m/s", "two units"},
                                   {"2.7 (2.5) km/s", "parentheses"},
                                   {"2.7(0.3) km/s", "parentheses"},
                                   {"2.7 +0.3/-0 km/s", "an error is not positive"},
                                   {"2.7 +0.3 km/s", "unit"},
                                   {"2.7 3 km/s", "unit"},
                                   {"2.7 +- 0.2 +- 0.1", "unit"},
                                   {"<2.7 km/s", "not a finite number"}})
    EXPECT_NE(complaint(text).find(says), std::string::npos) << text << ": " << complaint(text);
}

TEST(MeasuredValue, HasALikelihoodThatAgreesWithItsQuantiles) {
  for (const char* text : {"3 +- 0.5", "3 */ 1.4", "2..4", "3 +0.5/-0.2"}) {
    const MeasuredValue m = read(text);
    for (const double p : {0.05, 0.3, 0.5, 0.8, 0.99}) {
      const double h = 1e-6;
      // The likelihood over the density of the quantiles, in x or in ln x, is constant.
      const auto even = [&](double at) {
        const double x = m.quantile(at), pace = (m.quantile(at + h) - m.quantile(at - h)) / (2 * h);
        return m.likelihood(x) * pace / (m.shape == MeasuredValue::Shape::lognormal ? x : 1);
      };
      EXPECT_NEAR(even(p) / even(0.5), 1, 1e-6) << text << " " << p;
      EXPECT_NEAR(m.likelihood_of_log(std::log(m.quantile(p))), m.likelihood(m.quantile(p)), 1e-12);
    }
    if (m.shape != Shape::split) {
      EXPECT_NEAR(m.quantile(0.5), 3000, 1e-9);
    }
  }
  EXPECT_EQ(read("2..4").likelihood(1999), 0);
}

TEST(MeasuredValue, HasALikelihoodThatFallsTowardsZeroForANormalError) {
  const MeasuredValue m = read("2 +- 1");
  EXPECT_NEAR(m.likelihood(1400), std::exp(-0.18), 1e-12);
  EXPECT_NEAR(m.likelihood(14), 0.01 * std::exp(-0.5 * 1.986 * 1.986), 1e-12);
}

TEST(MeasuredValue, HasAShareBelowThatInvertsItsQuantiles) {
  for (const char* text : {"3 +- 0.5", "3 */ 1.4", "2..4", "3 +0.5/-0.2"})
    for (const double p : {1e-6, 0.05, 0.5, 0.8, 0.99}) {
      const MeasuredValue m = read(text);
      EXPECT_NEAR(m.share_below(m.quantile(p)) / p, 1, 1e-9) << text << " " << p;
    }
  EXPECT_EQ(read("2..4").share_below(1999), 0);
  EXPECT_EQ(read("2..4").share_below(4001), 1);
  EXPECT_EQ(read("3 */ 1.4").share_below(-1), 0);
  EXPECT_EQ(read("3").share_below(3000), 0);
  EXPECT_EQ(read("3").share_below(3001), 1);
}

}  // namespace
