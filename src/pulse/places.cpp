#include "places.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace slipfront::pulse {

Places::Places(const friction::Friction& friction, double left, double right, std::size_t count)
    : left_(left),
      spacing_((right - left) / static_cast<double>(count)),
      variables_(friction.variables()),
      values_(variables_ * count) {
  for (std::size_t j = 0; j < values_.size(); j += variables_)
    friction.law().start(std::span(values_).subspan(j, variables_));
}

std::vector<double> Places::velocity_from(const std::vector<double>& x, const std::vector<double>& velocity) const {
  std::vector<double> at(values_.size() / variables_);
  std::size_t i = 0;
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double place = left_ + (static_cast<double>(j) + 0.5) * spacing_;
    while (i < x.size() && x[i] <= place) ++i;
    if (i == 0 || i == x.size()) continue;
    at[j] = std::lerp(velocity[i - 1], velocity[i], (place - x[i - 1]) / (x[i] - x[i - 1]));
  }
  return at;
}

void Places::advance(const friction::Law& law, const std::vector<double>& velocity, double time) {
  for (std::size_t j = 0; j < velocity.size(); ++j)
    law.advance(velocity[j], time, std::span(values_).subspan(j * variables_, variables_));
}

void Places::look_up(double x, double* memory) const {
  const std::size_t count = values_.size() / variables_;
  const double position = std::clamp((x - left_) / spacing_ - 0.5, 0.0, static_cast<double>(count - 1));
  const std::size_t j = std::min(static_cast<std::size_t>(position), count - 2);
  for (std::size_t v = 0; v < variables_; ++v)
    memory[v] =
        std::lerp(values_[j * variables_ + v], values_[(j + 1) * variables_ + v], position - static_cast<double>(j));
}

}  // namespace slipfront::pulse
