#pragma once
/// \file
/// A measured quantity with what is known of its error, and the quantiles that sum up a distribution.

#include <optional>
#include <string_view>

#include "slipfront/medium/quantity.hpp"

namespace slipfront::catalogue {

/// In SI units. `low` == `high` but for a range.
struct Measured {
  enum class Shape {
    range,      ///< anything from low to high alike; an exact number where low == high
    normal,     ///< about low == high with standard deviation `spread`
    lognormal,  ///< median low == high, `spread` > 1 the factor of one standard deviation
  };
  double low = 0;
  double high = 0;
  Shape shape = Shape::range;
  double spread = 0;

  double middle() const { return low + (high - low) / 2; }
  bool is_range() const { return low < high; }
  bool is_exact() const { return shape == Shape::range && low == high; }
  /// The value below which it lies with `probability`, 0 < probability < 1.
  double quantile(double probability) const;
  /// Of the true value x, given what was measured; largest 1. Not for an exact number.
  double likelihood(double x) const;
  /// What a value that `quantile` gave at an even probability weighs where ln x is even before the measurement.
  double weight_of_draw(double x) const;
};

/// "3.0 km/s", "3.0 +- 0.2 km/s" (or the sign for it), "3.0 */ 1.2 km/s", "2.8..3.2 km/s", "2.8-3.2 km/s",
/// "normal(3.0, 0.2) km/s", "lognormal(3.0, 1.2) km/s", "uniform(2.8, 3.2) km/s". \throws InputError (value, problem
/// and allowed only), as parse_quantity does and for an uncertainty that is not positive, a factor not above 1, a
/// distribution that is not one of these.
Measured parse_measured(std::string_view text, medium::Dimension dimension, std::string_view default_unit);

struct Quantiles {
  double low;  ///< 5 %
  double median;
  double high;  ///< 95 %
};

}  // namespace slipfront::catalogue
