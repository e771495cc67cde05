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

double Measured::share_below(double x) const {
  const auto below = [](double z) { return std::erfc(-z / std::numbers::sqrt2) / 2; };
  switch (shape) {
    case Shape::range:
      break;
    case Shape::normal:
      return below((x - low) / spread);
    case Shape::lognormal:
      return x > 0 ? below(std::log(x / low) / std::log(spread)) : 0;
    case Shape::split: {
      const double under = spread_below / (spread_below + spread);
      return x < low ? 2 * under * below((x - low) / spread_below) : 1 - 2 * (1 - under) * below((low - x) / spread);
    }
  }
  if (is_exact()) return x > low ? 1 : 0;
  return std::clamp((x - low) / (high - low), 0.0, 1.0);
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
  const bool falls = shape != Shape::lognormal && x < least_even_share * low;
  return (falls ? x / (least_even_share * low) : 1) * std::exp(-z * z / 2);
}

double Measured::likelihood_of_log(double ln_x) const {
  if (shape != Shape::lognormal) return likelihood(std::exp(ln_x));
  const double z = (ln_x - std::log(low)) / std::log(spread);
  return std::exp(-z * z / 2);
}

}  // namespace slipfront::catalogue
