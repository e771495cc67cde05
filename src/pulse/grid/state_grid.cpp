#include "pulse/grid/state_grid.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace slipfront::pulse {

Places::Places(const friction::Friction& friction, double left, double right, std::size_t count)
    : left_(left),
      spacing_((right - left) / static_cast<double>(count)),
      variables_(friction.state_size()),
      values_(variables_ * count) {
  for (std::size_t j = 0; j < values_.size(); j += variables_)
    friction.evolution().start(std::span(values_).subspan(j, variables_));
}

Places::Passing Places::passing(const std::vector<double>& x, const Passing& there) const {
  const std::size_t count = values_.size() / variables_;
  Passing here{std::vector<double>(count), std::vector<double>(count)};
  std::size_t i = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double place = left_ + (static_cast<double>(j) + 0.5) * spacing_;
    while (i < x.size() && x[i] <= place) ++i;
    if (i == 0 || i == x.size()) continue;
    const double share = (place - x[i - 1]) / (x[i] - x[i - 1]);
    here.mean[j] = there.mean[i - 1] + share * (there.mean[i] - there.mean[i - 1]);
    here.typical[j] = there.typical[i - 1] + share * (there.typical[i] - there.typical[i - 1]);
  }
  return here;
}

void Places::advance(const friction::StateEvolution& evolution, const Passing& passing, double time) {
  evolution.advance_all(passing.mean.size(), {passing.mean.data(), passing.typical.data()}, time, variables_,
                        values_.data());
}

void Places::look_up(std::size_t size, const double* x, double* memory) const {
  if (variables_ == 0) return;
  const std::size_t count = values_.size() / variables_;
  const double last = static_cast<double>(count - 1), per_spacing = 1 / spacing_;
  for (std::size_t i = 0; i < size; ++i) {
    const double at = (x[i] - left_) * per_spacing - 0.5, position = at > 0 ? std::fmin(at, last) : 0.0;
    const int j = std::min(static_cast<int>(position), static_cast<int>(count) - 2);
    const double share = position - j;
    const double* from = values_.data() + static_cast<std::size_t>(j) * variables_;
    for (std::size_t v = 0; v < variables_; ++v)
      memory[i * variables_ + v] = from[v] + share * (from[variables_ + v] - from[v]);
  }
}

}  // namespace slipfront::pulse
