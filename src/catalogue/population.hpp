#pragma once
/// \file
/// A catalogue by decades of rupture velocity, beside the closed form.

#include <cstddef>
#include <map>
#include <vector>

#include "slipfront/catalogue/measured.hpp"

namespace slipfront::catalogue {

/// One event of a population: V / c, and its values of the quantities that the population sums up, NaN where not known.
struct Member {
  double rupture_velocity;  ///< V / c
  std::vector<double> values;
};

/// How values of several events lie. Quantiles are linear between the ordered values, of which the first is at 0 and
/// the last at 1.
struct Spread {
  std::size_t events = 0;  ///< in which the quantity is known; 0: NaN below
  Quantiles of = {};
};

/// The events of 10^k <= V / c < 10^(k + 1).
struct Decade {
  int exponent = 0;                 ///< k
  double low = 0, high = 0;         ///< V / c
  double middle = 0;                ///< sqrt(low high)
  double stress = 0;                ///< closed form at the middle, mu A / pi (Eqs. 8-10)
  double slip_velocity = 0;         ///< W(0) of the closed form at the middle, c A / pi
  std::size_t events = 0;           ///< 0 in a gap between others
  std::vector<Spread> spread = {};  ///< of each quantity of the members
};

class Population {
 public:
  void add(const Member& member);
  /// From the slowest event's to the fastest's, gaps included.
  std::vector<Decade> decades() const;

 private:
  std::map<int, std::vector<Member>> members_;  ///< by exponent
};

/// A point of the closed form.
struct LinePoint {
  double rupture_velocity;  ///< V / c
  double stress;            ///< mu A / pi
  double slip_velocity;     ///< W(0), c A / pi
};
/// The closed form through these decades, 20 points each, ends included (V / c = 1 is not one: 0.99 is the last).
std::vector<LinePoint> line_through(const std::vector<Decade>& decades);

}  // namespace slipfront::catalogue
