#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "slipfront/lattice/plane/problem.hpp"
#include "slipfront/theory/train.hpp"

/// Rings of dislocations: loops at rest between the radii 1 and 2 under the tension J0 = strength / r,
/// around a held plateau.
namespace rings {

/// The slip by numerical integration of the density kappa from r = 2 inwards. J0 = 4 cosh(psi) E / pi.
class Slip {
 public:
  explicit Slip(double strength = 4) {
    for (std::size_t i = 1; i < slip_.size(); ++i) {
      const double outer = 2 - step * static_cast<double>(i - 1);
      slip_[i] = slip_[i - 1] + step / 6 *
                                    (density(strength, outer) + 4 * density(strength, outer - step / 2) +
                                     density(strength, outer - step));
    }
  }
  double operator()(double r) const {
    if (r >= 2) return 0;
    const double place = std::fmin((2 - r) / step, static_cast<double>(slip_.size() - 1) - 1e-9);
    const auto i = static_cast<std::size_t>(place);
    const double f = place - static_cast<double>(i);
    return slip_[i] + f * (slip_[i + 1] - slip_[i]);
  }

 private:
  static double density(double strength, double r) {
    double low = 1e-12, high = 10;  // psi, bisected in its logarithm
    for (int i = 0; i < 100; ++i) {
      const double psi = std::sqrt(low * high);
      const auto train = slipfront::train::averages({0, psi});
      (train.J < strength / r ? low : high) = psi;
    }
    return slipfront::train::averages({0, low}).k;
  }
  static constexpr double step = 1.0 / 4000;
  std::vector<double> slip_ = std::vector<double>(4001);
};

inline slipfront::plane::Problem problem(const Slip& slip) {
  slipfront::plane::Problem p;
  p.left = p.bottom = -3.2;
  p.right = p.top = 3.2;
  p.slip = [slip](double x, double y) { return slip(std::fmax(std::hypot(x, y), 1.0)); };
  p.fixed = [](double x, double y) { return std::hypot(x, y) < 1 ? 1.0 : 0.0; };
  return p;
}

/// The point at the distance r from the origin, in the direction of an angle in degrees.
inline slipfront::plane::Point polar(double r, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {r * std::cos(angle), r * std::sin(angle)};
}

inline double friction_on_one_side(double, double y) { return 1 + std::tanh(y / 0.1); }

}  // namespace rings
