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
/// banded Jacobian by differences. y is that of Semidiscrete: width and momentum of each cell in turn, x of the left
/// edge, then entries that only add up, here by the trapezoidal rule. Linear systems are solved for the faces' places
/// instead of the widths: a force that depends on the place couples a cell with all widths to its left, but only with
/// the faces beside it.
class ImplicitStep {
 public:
  /// Rates depend on `reach` entries to either side in the order: face, momentum, face, ... face.
  ImplicitStep(std::size_t cells, std::size_t size, std::size_t reach, bool depends_on_time);
  /// Tries one step; returns the error in units of the tolerance (accept if <= 1) and leaves y(t + dt) in `next`.
  /// `scale[i]` is the size that width or momentum i is measured by.
  double operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                    const std::vector<double>& rate_at_start, const std::vector<double>& scale, double tolerance,
                    std::vector<double>& next);
  /// Evaluates the Jacobian at (t, y); valid for any number of tries from there.
  void linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                 const std::vector<double>& scale);

 private:
  void factorise(double diagonal);
  void solve(std::vector<double>& b);
  double& entry(std::vector<double>& m, std::size_t row, std::size_t column) const {
    return m[row * stride_ + (column + reach_ - row)];
  }
  void to_places(const std::vector<double>& y);
  void to_widths(std::vector<double>& y) const;

  std::size_t cells_, unknowns_, size_, reach_, stride_;
  bool depends_on_time_;
  std::vector<double> jacobian_, lu_, by_time_, work_, rate_, places_, places_before_;
  std::vector<double> u_[6];
};

}  // namespace slipfront::pulse
