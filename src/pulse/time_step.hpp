#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace slipfront::pulse {

/// y' = f(t, y).
using Rates = std::function<void(double t, const double* y, double* dy)>;

/// One step of SSPRK(5,4): explicit, fourth order, strong stability preserving up to 1.5 Euler steps (Spiteri & Ruuth
/// 2002).
class ExplicitStep {
 public:
  explicit ExplicitStep(std::size_t size);
  /// y(t) -> y(t + dt). `rate_at_start` is f(t, y), which the caller has already needed for the step size.
  void operator()(const Rates& f, double t, double dt, std::vector<double>& y,
                  const std::vector<double>& rate_at_start);

 private:
  std::vector<double> u1_, u2_, u3_, u4_, rate_, rate3_;
};

/// One step of Rodas4: linearly implicit, fourth order, L-stable, stiffly accurate (Hairer & Wanner 1996, IV.10), with
/// banded Jacobian by differences. The first `banded` entries of y are coupled within `reach`; the rest only add up, by
/// the trapezoidal rule.
class ImplicitStep {
 public:
  ImplicitStep(std::size_t banded, std::size_t extra, std::size_t reach);
  /// Tries one step; returns the error in units of the tolerance (accept if <= 1) and leaves y(t + dt) in `next`.
  /// `scale[i]` is the size that entry i is measured by.
  double operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                    const std::vector<double>& rate_at_start, const std::vector<double>& scale, double tolerance,
                    std::vector<double>& next);
  /// Evaluates the Jacobian at (t, y); valid for any number of tries from there.
  void linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                 const std::vector<double>& scale);

 private:
  void factorise(double diagonal);
  void solve(std::vector<double>& b) const;
  double& entry(std::vector<double>& m, std::size_t row, std::size_t column) const {
    return m[row * stride_ + (column + reach_ - row)];
  }

  std::size_t banded_, extra_, reach_, stride_;
  std::vector<double> jacobian_, lu_, by_time_, work_, rate_;
  std::vector<double> u_[6];
};

}  // namespace slipfront::pulse
