#include "pulse/time/ars443.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "foundation/simd/combine.hpp"
#include "foundation/simd/reduce.hpp"
#include "foundation/simd/vector_code.hpp"
#include "pulse/grid/values.hpp"

namespace slipfront::pulse {
namespace {

constexpr std::size_t stages = 4;
/// At which time, in steps, and from which rates the stages come: column 0 is the start.
constexpr double at[stages] = {0.5, 2.0 / 3, 0.5, 1};
constexpr double by_rates[stages][stages] = {
    {1.0 / 2}, {11.0 / 18, 1.0 / 18}, {5.0 / 6, -5.0 / 6, 1.0 / 2}, {1.0 / 4, 7.0 / 4, 3.0 / 4, -7.0 / 4}};
/// And from which friction: column 0 is the first stage.
constexpr double by_friction[stages][stages] = {
    {1.0 / 2}, {1.0 / 6, 1.0 / 2}, {-1.0 / 2, 1.0 / 2, 1.0 / 2}, {3.0 / 2, -3.0 / 2, 1.0 / 2, 1.0 / 2}};

/// Force of friction that leaves `momentum` of `free` in a time, from 1 over that time; returns the power that it
/// takes.
SLIPFRONT_CLONES double take_friction(std::size_t size, const double* free, const double* momentum,
                                      const double* velocity, double per_time, double* friction) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) friction[i] = (free[i] - momentum[i]) * per_time;
  return reduce(
      size, 0, [=](std::size_t i) { return friction[i] * velocity[i]; }, [](double a, double b) { return a + b; });
}

}  // namespace

Ars443::Ars443(std::size_t cells, std::size_t size)
    : cells_(cells),
      rates_(stages, std::vector<double>(size)),
      friction_(stages, std::vector<double>(cells + 1)),
      stage_(size),
      midpoint_(size),
      free_(cells),
      momentum_(cells),
      velocity_(cells),
      mean_off_(cells) {}

void Ars443::operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                        const std::vector<double>& rate_at_start) {
  before_ = y;
  rates_[0] = rate_at_start;
  mean_off_.assign(cells_, 0.0);
  const auto add_to_mean = [&](double weight, const double* momentum) {
    for (std::size_t cell = 0; cell < cells_; ++cell) mean_off_[cell] += weight * momentum[cell];
  };
  constexpr double trapezoidal = 0.5;
  add_to_mean(by_rates[stages - 1][0] - trapezoidal, before_.data() + cells_);
  std::array<const double*, 1 + stages> y_and_rates, y_and_friction;  // as far as they are known; with weight 0 else
  y_and_rates.fill(before_.data());
  y_and_friction.fill(stage_.data());
  for (std::size_t k = 0; k < stages; ++k) {
    std::array<double, 1 + stages> by_stage{1}, taken{1};
    for (std::size_t j = 0; j <= k; ++j) by_stage[1 + j] = dt * by_rates[k][j];
    for (std::size_t j = 0; j < k; ++j) taken[1 + j] = -dt * by_friction[k][j];
    y_and_rates[1 + k] = rates_[k].data();
    combine5(stage_.size(), by_stage, y_and_rates, stage_.data());
    const Values values(stage_.data(), cells_);
    const double time = dt * by_friction[k][k];
    y_and_friction[0] = values.momenta();
    combine5(cells_, taken, y_and_friction, free_.data());
    friction(stage_.data(), free_.data(), time, momentum_.data(), velocity_.data());
    friction_[k][cells_] =
        take_friction(cells_, free_.data(), momentum_.data(), velocity_.data(), 1 / time, friction_[k].data());
    std::copy_n(momentum_.data(), cells_, values.momenta());
    y_and_friction[1 + k] = friction_[k].data();
    for (std::size_t j = 0; j <= k; ++j) values.dissipated() += dt * by_friction[k][j] * friction_[j][cells_];
    add_to_mean(k + 1 < stages ? by_rates[stages - 1][k + 1] : -trapezoidal, momentum_.data());
    if (k + 1 < stages) f(t + at[k] * dt, stage_.data(), rates_[k + 1].data());
  }
  combine3(midpoint_.size(), {1, dt, 0}, {before_.data(), rates_[1].data(), before_.data()}, midpoint_.data());
  const Values values(midpoint_.data(), cells_);
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    values.momentum(cell) -= dt * friction_[0][cell];
    // Friction stops a cell but does not throw it back, as the midpoint rule has it where a cell comes to rest.
    if (momentum_[cell] == 0 || std::signbit(values.momentum(cell)) != std::signbit(momentum_[cell]))
      values.momentum(cell) = 0;
  }
  y = stage_;
}

double Ars443::error(const std::vector<double>& y, const std::vector<double>& scale,
                     const std::vector<double>& excluded, const std::vector<double>& friction_times) const {
  double sum = 0;
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    const std::size_t i = cells_ + cell;
    const double width = (y[cell] - midpoint_[cell]) / scale[cell];
    const double full = std::fabs(y[i] - midpoint_[i]), times = 1 + friction_times[cell],
                 damped = full / (times * times);
    const double momentum = std::fmin(full, std::fmax(damped, std::fabs(mean_off_[cell]))) / scale[i];
    sum += (1 - excluded[cell]) * (width * width + momentum * momentum);
  }
  const double error = std::sqrt(sum / static_cast<double>(2 * cells_));
  return std::isfinite(error) ? error : HUGE_VAL;
}

}  // namespace slipfront::pulse
