#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace slipfront::pulse {

/// The semi-implicit Euler method, extrapolated once (Deuflhard 1985, SIAM Review 27:505): two steps of half the length
/// are compared with the whole step, and the difference added to them. Second order.
class ExtrapolatedEuler {
 public:
  /// One step of the first-order method, from y at t to `next` at t + dt.
  using Step = std::function<void(double t, double dt, const double* y, double* next)>;

  explicit ExtrapolatedEuler(std::size_t size) : whole_(size), half_(size), halves_(size) {}

  void operator()(const Step& step, double t, double dt, const std::vector<double>& y, std::vector<double>& next) {
    step(t, dt, y.data(), whole_.data());
    step(t, dt / 2, y.data(), half_.data());
    step(t + dt / 2, dt / 2, half_.data(), halves_.data());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = halves_[i] + difference(i);
  }
  /// Entry i after the two steps, and its difference from the whole step, which is an estimate of the error.
  double after_halves(std::size_t i) const { return halves_[i]; }
  double difference(std::size_t i) const { return halves_[i] - whole_[i]; }

 private:
  std::vector<double> whole_, half_, halves_;
};

}  // namespace slipfront::pulse
