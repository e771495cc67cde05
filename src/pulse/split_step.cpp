#include "split_step.hpp"

#include <cmath>

#include "slipfront/pulse/named_values.hpp"

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

}  // namespace

SplitStep::SplitStep(std::size_t cells, std::size_t size)
    : cells_(cells),
      rates_(stages, std::vector<double>(size)),
      friction_(stages, std::vector<double>(cells + 1)),
      midpoint_(size) {}

void SplitStep::operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                           const std::vector<double>& rate_at_start) {
  before_ = y;
  rates_[0] = rate_at_start;
  for (std::size_t k = 0; k < stages; ++k) {
    stage_ = before_;
    for (std::size_t j = 0; j <= k; ++j)
      for (std::size_t i = 0; i < stage_.size(); ++i) stage_[i] += dt * by_rates[k][j] * rates_[j][i];
    const Values values(stage_.data(), cells_);
    const double time = dt * by_friction[k][k];
    double& dissipated = friction_[k][cells_];
    dissipated = 0;
    for (std::size_t cell = 0; cell < cells_; ++cell) {
      double free = values.momentum(cell);
      for (std::size_t j = 0; j < k; ++j) free -= dt * by_friction[k][j] * friction_[j][cell];
      const Left left = friction(cell, values.width(cell), free, time);
      friction_[k][cell] = (free - left.momentum) / time;
      dissipated += friction_[k][cell] * left.velocity;
      values.momentum(cell) = left.momentum;
    }
    for (std::size_t j = 0; j <= k; ++j) values.dissipated() += dt * by_friction[k][j] * friction_[j][cells_];
    if (k + 1 < stages) f(t + at[k] * dt, stage_.data(), rates_[k + 1].data());
  }
  midpoint_ = before_;
  for (std::size_t i = 0; i < midpoint_.size(); ++i) midpoint_[i] += dt * rates_[1][i];
  const Values values(midpoint_.data(), cells_);
  for (std::size_t cell = 0; cell < cells_; ++cell) values.momentum(cell) -= dt * friction_[0][cell];
  y = stage_;
}

double SplitStep::error(const std::vector<double>& y, const std::vector<double>& scale,
                        const std::vector<double>& excluded) const {
  double sum = 0;
  for (std::size_t i = 0; i < 2 * cells_; ++i) {
    const double off = (y[i] - midpoint_[i]) / scale[i];
    sum += (1 - excluded[i / 2]) * off * off;
  }
  return std::sqrt(sum / static_cast<double>(2 * cells_));
}

}  // namespace slipfront::pulse
