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

Places::Passing Places::passing(const std::vector<double>& x, const Passing& there) const {
  const std::size_t count = values_.size() / variables_;
  Passing here{std::vector<double>(count), std::vector<double>(count)};
  std::size_t i = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double place = left_ + (static_cast<double>(j) + 0.5) * spacing_;
    while (i < x.size() && x[i] <= place) ++i;
    if (i == 0 || i == x.size()) continue;
    const double share = (place - x[i - 1]) / (x[i] - x[i - 1]);
    here.mean[j] = std::lerp(there.mean[i - 1], there.mean[i], share);
    here.typical[j] = std::lerp(there.typical[i - 1], there.typical[i], share);
  }
  return here;
}

void Places::advance(const friction::Law& law, const Passing& passing, double time) {
  for (std::size_t j = 0; j < passing.mean.size(); ++j)
    law.advance_in_train(passing.mean[j], passing.typical[j], time,
                         std::span(values_).subspan(j * variables_, variables_));
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
