#pragma once
/// \file
/// Sorts a catalogue into decades of rupture velocity, for comparison with the closed form.

#include <cstddef>
#include <map>
#include <vector>

#include "slipfront/events/catalogue/measured.hpp"

namespace slipfront::catalogue {

/// One event of a population: V / c, and the values of the quantities for which the population computes quantiles. A
/// value is NaN if it is not known.
struct Member {
  double rupture_velocity;  ///< V / c
  std::vector<double> values;
};

/// The distribution of a quantity over several events. Its quantiles are interpolated linearly between the ordered
/// values; the smallest value is the quantile 0 and the largest the quantile 1.
struct Spread {
  std::size_t events = 0;  ///< number of events in which the quantity is known; if 0, `of` is NaN
  Quantiles of = {};
};

/// The events of 10^k <= V / c < 10^(k + 1).
struct Decade {
  int exponent = 0;                 ///< k
  double low = 0, high = 0;         ///< V / c
  double middle = 0;                ///< sqrt(low high)
  double stress = 0;                ///< closed form at the middle, mu A / pi (Eqs. 8-10)
  double slip_velocity = 0;         ///< W(0) of the closed form at the middle, c A / pi
  std::size_t events = 0;           ///< 0 in a gap between decades with events
  std::vector<Spread> spread = {};  ///< one for each quantity of the members
};

class Population {
 public:
  void add(const Member& member);
  /// The decades from that of the slowest event to that of the fastest, including gaps.
  std::vector<Decade> decades() const;

 private:
  std::map<int, std::vector<Member>> members_;  ///< sorted by exponent
};

/// A point of the closed form.
struct LinePoint {
  double rupture_velocity;  ///< V / c
  double stress;            ///< mu A / pi
  double slip_velocity;     ///< W(0), c A / pi
};
/// The closed form over these decades, with 20 points in each decade and both ends included. If the end is V / c = 1,
/// the last point is at 0.99.
std::vector<LinePoint> line_through(const std::vector<Decade>& decades);

}  // namespace slipfront::catalogue
