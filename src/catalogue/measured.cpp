#include "slipfront/catalogue/measured.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace slipfront::catalogue {
namespace {

/// The standard normal deviate that is below with probability p.
double deviate(double p) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p); }

}  // namespace

double Measured::quantile(double p) const {
  switch (shape) {
    case Shape::range:
      break;
    case Shape::normal:
      return low + spread * deviate(p);
    case Shape::lognormal:
      return low * std::exp(std::log(spread) * deviate(p));
    case Shape::split: {
      const double below = spread_below / (spread_below + spread);
      return p < below ? low + spread_below * deviate(p / below / 2)
                       : low - spread * deviate((1 - p) / (1 - below) / 2);
    }
  }
  return low + p * (high - low);
}

double Measured::likelihood(double x) const {
  double z = 0;
  switch (shape) {
    case Shape::range:
      return x >= low && x <= high ? 1 : 0;
    case Shape::normal:
      z = (x - low) / spread;
      break;
    case Shape::lognormal:
      if (!(x > 0)) return 0;
      z = std::log(x / low) / std::log(spread);
      break;
    case Shape::split:
      z = (x - low) / (x < low ? spread_below : spread);
      break;
  }
  return std::exp(-z * z / 2);
}

double Measured::weight_of_draw(double x) const { return shape == Shape::lognormal || is_exact() ? 1 : 1 / x; }

}  // namespace slipfront::catalogue
