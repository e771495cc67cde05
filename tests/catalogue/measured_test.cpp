#include "slipfront/catalogue/measured.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "slipfront/error.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using Shape = Measured::Shape;
using medium::Dimension;

Measured read(const char* text) { return parse_measured(text, Dimension::velocity, "km/s"); }

TEST(Measured, ReadsEveryForm) {
  for (const char* text : {"3.0 +- 0.2 km/s", "3.0 +/- 0.2 km/s", "3.0 \xC2\xB1 0.2 km/s", "normal(3.0, 0.2) km/s",
                           "3.0 +- 0.2", " normal( 3.0 ,0.2 ) "}) {
    const Measured m = read(text);
    EXPECT_EQ(m.shape, Shape::normal) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 3000) << text;
    EXPECT_DOUBLE_EQ(m.spread, 200) << text;
  }
  for (const char* text : {"2.8..3.2 km/s", "2.8 - 3.2 km/s", "uniform(2.8, 3.2) km/s", "2.8 .. 3.2"}) {
    const Measured m = read(text);
    EXPECT_EQ(m.shape, Shape::range) << text;
    EXPECT_DOUBLE_EQ(m.low, 2800) << text;
    EXPECT_DOUBLE_EQ(m.high, 3200) << text;
  }
  for (const char* text : {"3 */ 1.2 km/s", "lognormal(3, 1.2) km/s"}) {
    const Measured m = read(text);
    EXPECT_EQ(m.shape, Shape::lognormal) << text;
    EXPECT_DOUBLE_EQ(m.low, 3000) << text;
    EXPECT_DOUBLE_EQ(m.spread, 1.2) << text;
  }
  EXPECT_TRUE(read("3 km/s").is_exact());
}

TEST(Measured, ReadsAPercentageAsAShareOfTheValue) {
  for (const char* text : {"2.7 +- 10% km/s", "2.7 +- 10 % km/s", "2.7 +/- 10 %", "2.7 \xC2\xB1 10% km/s"}) {
    const Measured m = read(text);
    EXPECT_EQ(m.shape, Shape::normal) << text;
    EXPECT_DOUBLE_EQ(m.middle(), 2700) << text;
    EXPECT_DOUBLE_EQ(m.spread, 270) << text;
  }
}

TEST(Measured, RejectsPercentagesThatItDoesNotUnderstand) {
  for (const char* text :
       {"2.7 +- -10 % km/s", "2.7 */ 10 % km/s", "2.7 % km/s", "2..3 % km/s", "normal(2.7, 10 %) km/s"})
    EXPECT_THROW(read(text), InputError) << text;
  EXPECT_THROW(parse_measured("0.3 +- 10 %", Dimension::ratio, ""), InputError);
  EXPECT_DOUBLE_EQ(parse_measured("3 %", Dimension::ratio, "").middle(), 0.03);
}

TEST(Measured, RejectsWithTheReason) {
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
                                   {"(", "unknown distribution"}})
    EXPECT_NE(complaint(text).find(says), std::string::npos) << text << ": " << complaint(text);
}

TEST(Measured, HasALikelihoodThatAgreesWithItsQuantiles) {
  for (const char* text : {"3 +- 0.5", "3 */ 1.4", "2..4"}) {
    const Measured m = read(text);
    for (const double p : {0.05, 0.3, 0.5, 0.8, 0.99}) {
      const double h = 1e-6;
      // The likelihood over the density of the quantiles, in x or in ln x, is constant.
      const auto even = [&](double at) {
        const double x = m.quantile(at), pace = (m.quantile(at + h) - m.quantile(at - h)) / (2 * h);
        return m.likelihood(x) * pace / (m.shape == Measured::Shape::lognormal ? x : 1);
      };
      EXPECT_NEAR(even(p) / even(0.5), 1, 1e-6) << text << " " << p;
      EXPECT_NEAR(m.likelihood_of_log(std::log(m.quantile(p))), m.likelihood(m.quantile(p)), 1e-12);
    }
    EXPECT_NEAR(m.quantile(0.5), 3000, 1e-9);
  }
  EXPECT_EQ(read("2..4").likelihood(1999), 0);
}

TEST(Measured, HasALikelihoodThatFallsTowardsZeroForANormalError) {
  const Measured m = read("2 +- 1");
  EXPECT_NEAR(m.likelihood(1400), std::exp(-0.18), 1e-12);
  EXPECT_NEAR(m.likelihood(14), 0.01 * std::exp(-0.5 * 1.986 * 1.986), 1e-12);
}

TEST(Measured, HasAShareBelowThatInvertsItsQuantiles) {
  for (const char* text : {"3 +- 0.5", "3 */ 1.4", "2..4"})
    for (const double p : {1e-6, 0.05, 0.5, 0.8, 0.99}) {
      const Measured m = read(text);
      EXPECT_NEAR(m.share_below(m.quantile(p)) / p, 1, 1e-9) << text << " " << p;
    }
  EXPECT_EQ(read("2..4").share_below(1999), 0);
  EXPECT_EQ(read("2..4").share_below(4001), 1);
  EXPECT_EQ(read("3 */ 1.4").share_below(-1), 0);
  EXPECT_EQ(read("3").share_below(3000), 0);
  EXPECT_EQ(read("3").share_below(3001), 1);
}

}  // namespace
