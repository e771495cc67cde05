#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "friction/train_means/mean_over_train.hpp"
#include "math/interpolation.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::friction {
namespace {

using std::numbers::pi;

/// The integral of dn^(n-1) over the amplitude from 0 to pi / 2, of which <sigma^n> is (2 beta)^n / K. With
/// amplitude = gd(y), dn^2 = sech^2 y + s^2 tanh^2 y, and the sum is that of mean_over_train without its weights. The
/// integrand has no singularity within pi / 2 of the real axis: the error is some exp(-pi^2 / h).
double integral_of_power(const elliptic::AtPsi& at, double n) {
  constexpr double end = 40, h = 0.25;
  double sum = 0;
  for (int i = 0; i * h <= end; ++i) {
    const double y = i * h, sech = 1 / std::cosh(y), tanh = std::tanh(y);
    const double term = sech * std::pow(sech * sech + at.s * at.s * tanh * tanh, (n - 1) / 2);
    sum += i == 0 ? term / 2 : term;
  }
  return sum * h;
}

/// <sigma^n>.
double mean_power(const State& train, double n) {
  const elliptic::AtPsi at = elliptic::at_psi(train.psi);
  const double two_beta = 2 * std::cosh(train.phi) * std::cosh(train.psi);
  return std::pow(two_beta, n) / at.K * integral_of_power(at, n);
}

/// loss / P with P = U <sigma^2> = U 4 beta^2 E / K and k = pi beta / K is C (2 sinh |phi| cosh psi)^(n - 1) g(psi). It
/// looks g up in a table of ln psi that fills as it is used, to 1e-10.
class PowerRate final : public RelaxationRate {
 public:
  PowerRate(double coefficient, double exponent, Closure closure) : C_(coefficient), n_(exponent), closure_(closure) {}

  double operator()(const State& train, double contact, LocalState) const override {
    if (C_ == 0 || train.empty() || train.phi == 0) return 0;
    const double fastest = 2 * std::sinh(std::fabs(train.phi)) * std::cosh(train.psi);
    const double rate = C_ * std::pow(fastest, n_ - 1) * shape(train.psi, std::log(train.psi));
    return contact == 1 ? rate : rate * std::pow(contact, n_ - 1);  // <|w|^n sigma> over P, w in units of a
  }
  void rates(std::size_t size, const double* fastest, const double* psi, double* rate) const override;
  bool tabulated() const override { return true; }

 private:
  static constexpr double per_unit = 32, least_log = -700, most_psi = 20;  // nodes per unit of ln psi

  double node(std::size_t i) const {
    double& value = nodes_[i];
    if (std::isnan(value)) {
      const elliptic::AtPsi at = elliptic::at_psi(std::exp(least_log + static_cast<double>(i) / per_unit));
      value = closure_ == Closure::consistent ? integral_of_power(at, n_ + 1) / at.E
                                              : pi / 2 * integral_of_power(at, n_) / (at.E * at.K);
    }
    return value;
  }

  /// Lagrange's polynomial through six nodes. Dense trains have sigma = <sigma>, and g = 1.
  double shape(double psi, double log_psi) const {
    if (psi >= most_psi) return 1;
    if (nodes_.empty())
      nodes_.assign(static_cast<std::size_t>((std::log(most_psi) - least_log) * per_unit) + 8, std::nan(""));
    const double position = (log_psi - least_log) * per_unit;
    const double begin = std::fmax(std::floor(position) - 2, 0.0), s = position - begin;
    const auto first = static_cast<std::size_t>(begin);
    constexpr std::size_t points = 6;
    const auto weights = equidistant_weights(points, s);
    double sum = 0;
    for (std::size_t j = 0; j < points; ++j) sum += weights[j] * node(first + j);
    return sum;
  }

  double C_, n_;
  Closure closure_;
  mutable std::vector<double> nodes_;  ///< g, NaN where not yet known
};

/// C w^n; NaN where that exceeds the range of exp. w = 0 gives 0.
struct PowerForce {
  using Values = std::array<double, 2>;
  static constexpr bool has_limits = true;
  double C, n;
  SLIPFRONT_INLINE explicit PowerForce(const Values& values) : C(values[0]), n(values[1]) {}
  SLIPFRONT_INLINE double operator()(double speed) const {
    constexpr double least = 1e-300, range = 690;
    const double w = speed > least ? speed : 1.0, log = n * log_branch_free(w);
    const bool within = log < range && log > -range && (speed > least || speed == 0);
    const double power = C * exp_branch_free(within ? log : 0.0);
    return !within ? NAN : speed == 0 ? 0.0 : power;
  }
};

SLIPFRONT_CLONES void logarithms(std::size_t size, const double* psi, double* log_psi) {
  constexpr double least = 1e-300;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) log_psi[i] = log_branch_free(psi[i] > least ? psi[i] : least);
}

void PowerRate::rates(std::size_t size, const double* fastest, const double* psi, double* rate) const {
  constexpr std::size_t most = 64;
  double log_psi[most];
  for (std::size_t begin = 0; begin < size; begin += most) {
    const std::size_t some = std::min(most, size - begin);
    forces_at(PowerForce({C_, n_ - 1}), some, fastest + begin, rate + begin);
    logarithms(some, psi + begin, log_psi);
    for (std::size_t i = begin; i < begin + some; ++i) {
      if (std::isnan(rate[i])) rate[i] = C_ * std::pow(fastest[i], n_ - 1);
      rate[i] = C_ == 0 || psi[i] == 0 || fastest[i] == 0 ? 0 : rate[i] * shape(psi[i], log_psi[i - begin]);
    }
  }
}

/// f = C w^2
struct ClosedSquare {
  SLIPFRONT_INLINE static double force(double C, double speed) { return C * (speed * speed); }
  SLIPFRONT_INLINE static double left(double s, double free) { return 2 / (1 + std::sqrt(1 + 4 * s * free)); }
  /// The power series to 1e-18, with Catalan's numbers.
  SLIPFRONT_INLINE static double left_little(double s_free) {
    constexpr double c[] = {1, -1, 2, -5, 14};
    return polynomial(c, s_free);
  }
  static constexpr double little = 1e-4;
};

class PowerLoops final : public ForceLoops {
 public:
  PowerLoops(const Law& law, double coefficient, double exponent) : ForceLoops(law), C_(coefficient), n_(exponent) {}
  void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const override {
    forces_at(PowerForce({C_, n_}), size, speed, force);
    find_others(law_, size, speed, states, force);
  }

 private:
  double C_, n_;
};

class PowerAverage final : public TabulatedAverage {
 public:
  PowerAverage(const Law& law, double coefficient, double exponent)
      : TabulatedAverage(law), C_(coefficient), n_(exponent) {}
  double mean_strength(const State& train, double contact, Closure closure, LocalState) const override {
    const double speed = std::pow(contact * std::fabs(std::tanh(train.phi)), n_);
    if (closure == Closure::paper) return C_ * speed * mean_power(train, n_);
    return C_ * speed * mean_power(train, n_ + 1) / train::averages(train).k;
  }
  std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const override {
    return std::make_unique<PowerRate>(C_, n_, closure);
  }

 private:
  double C_, n_;
};

class Power final : public Law {
 public:
  using WhereItVaries = VaryingForce<Power, PowerForce>;

  explicit Power(const std::vector<double>& values)
      : Law({.square_coefficient = values[1] == 2 ? std::optional(values[0]) : std::nullopt,
             .steep_at_rest = values[1] < 1}),
        C_(values[0]),
        n_(values[1]),
        loops_(*this, C_, n_),
        square_loops_(*this, C_),
        average_(*this, C_, n_) {}
  double strength(double speed, LocalState) const override { return C_ * std::pow(speed, n_); }

  /// v + s v^n = free is monotone. Newton in ln v from above is monotone too: v + s v^n is convex in ln v.
  double speed_after(double free, double weight, LocalState) const override {
    const double s = weight * C_;
    if (free == 0 || s == 0) return free;
    double v = std::fmin(free, std::pow(free / s, 1 / n_));
    if (v == 0) return 0;  // less than the smallest double
    for (int i = 0; i < 60; ++i) {
      const double drag = s * std::pow(v, n_), step = (v + drag - free) / (v + n_ * drag);
      v *= std::exp(-step);
      if (std::fabs(step) < 1e-8) break;  // the error left is of the order of its square
    }
    return v;
  }

  const ForceLoops& loops() const override {
    if (n_ == 2) return square_loops_;
    return loops_;
  }
  const TrainAverage& average() const override { return average_; }

 private:
  double C_, n_;
  PowerLoops loops_;
  ClosedLoops<ClosedSquare> square_loops_;
  PowerAverage average_;
};

}  // namespace

const Definition& power_law() {
  static const Definition definition{
      .name = "power",
      .adjective = "power",
      .equation = "f = C |w|^(n-1) w",
      .source = "docs/theory/5_friction.md",
      .parameters = {coefficient_in("mu A^2 / (pi (1 - nu)) over the unit of w to the power n"),
                     {.name = "exponent",
                      .symbol = "n",
                      .unit = "1",
                      .meaning = "power of the slip velocity",
                      .value = 1,
                      .most = 20,
                      .without_least = true}},
      .make = make_law<Power>};
  return definition;
}

}  // namespace slipfront::friction
