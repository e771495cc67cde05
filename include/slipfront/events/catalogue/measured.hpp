#pragma once
/// \file
/// A measured quantity with its uncertainty, and the quantiles that summarise a distribution.

#include <optional>
#include <string>
#include <string_view>

#include "slipfront/text/quantity.hpp"

namespace slipfront::catalogue {

/// A measured value in SI units. `low` and `high` differ only for a range.
struct MeasuredValue {
  enum class Shape {
    range,      ///< uniform from low to high; an exact number if low == high
    normal,     ///< mean low == high, standard deviation `spread`
    lognormal,  ///< median low == high; one standard deviation is the factor `spread` > 1
    split,      ///< most likely value low == high; standard deviation `spread` above it and `spread_below` below it
  };
  double low = 0;
  double high = 0;
  Shape shape = Shape::range;
  double spread = 0;
  double spread_below = 0;

  double middle() const { return low + (high - low) / 2; }
  bool is_range() const { return shape == Shape::range && low < high; }
  bool is_exact() const { return shape == Shape::range && low == high; }
  /// The quantity is below this value with the given probability, 0 < probability < 1.
  double quantile(double probability) const;
  /// The probability of values below x. An exact number has 0 up to itself, and 1 above.
  double share_below(double x) const;
  /// Likelihood of the true value x > 0, scaled so that its maximum is 1. An exact number has none. That of a normal
  /// error falls in proportion to x below `least_even_share` of the observed value: a normal error of 40 % does not
  /// exclude 0, and with a prior uniform in ln x the smallest numbers would then decide.
  double likelihood(double x) const;
  static constexpr double least_even_share = 0.7;
  /// The likelihood of exp(ln_x).
  double likelihood_of_log(double ln_x) const;
};

/// A value with unequal errors. Its likelihood is a normal one on each side, and falls to exp(-1/2) at value + above
/// and at value - below. \throws InputError (problem and allowed only) unless both errors are positive.
MeasuredValue split(double value, double above, double below);

/// Reads "3.0 km/s", "3.0 +- 0.2 km/s" (or the plus-minus sign), "3.0 +- 10 % km/s", "3.0(2) km/s", "3.0 +0.3/-0.1
/// km/s", "3.0 */ 1.2 km/s", "2.8..3.2 km/s", "2.8-3.2 km/s" (or with an en dash or "to"), "normal(3.0, 0.2) km/s",
/// "lognormal(3.0, 1.2) km/s" or "uniform(2.8, 3.2) km/s". The unit may follow either number. \throws InputError
/// (value, problem and allowed only) like parse_quantity, and if the uncertainty is not positive, the factor is not
/// above 1, or the text is not one of these forms.
MeasuredValue parse_measured(std::string_view text, medium::Dimension dimension, std::string_view default_unit);

/// A limit that a quantity does not exceed, or does not fall below.
struct Bound {
  std::string quantity;  ///< its name, such as "rupture_velocity"
  bool is_upper = true;
  double limit = 0;  ///< in SI units
};

/// Reads "<2.7 km/s" or ">= 2.7 km/s". Returns nothing if the text does not begin with such a sign. \throws InputError
/// like parse_measured.
std::optional<Bound> parse_bound(std::string_view text, medium::Dimension dimension, std::string_view default_unit);

struct Quantiles {
  double low;  ///< 5 %
  double median;
  double high;  ///< 95 %
};

}  // namespace slipfront::catalogue
