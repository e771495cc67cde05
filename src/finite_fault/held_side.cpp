#include "finite_fault/held_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "modulation/equations.hpp"
#include "rupture/inverse.hpp"
#include "slipfront/modulation/characteristics.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::finite_fault {
namespace {

constexpr std::size_t nodes = 8000;  // some hundreds to a column

}  // namespace

double SideStress::at(double d) const {
  if (d >= distance.back()) return stress.back();
  const auto above = std::upper_bound(distance.begin(), distance.end(), std::fmax(d, 0)) - distance.begin();
  const auto i = static_cast<std::size_t>(above);
  const double share = (std::fmax(d, 0) - distance[i - 1]) / (distance[i] - distance[i - 1]);
  const double value = std::lerp(stress[i - 1], stress[i], share);
  return value < least_stress ? 0 : value;
}

HeldSide::HeldSide(SideStress stress, double end) : stress_(std::move(stress)) {
  const auto speed_at = [](const State& s) { return s.empty() ? 0 : modulation::sound(s.psi).c0; };
  // Nothing that the pulse meets may come back from the end of the grid.
  const double beyond = 1.2 * end * speed_at(train::at_rest(stress_.stress.back()));
  length_ = stress_.distance.back() + beyond;
  node_ = length_ / static_cast<double>(nodes);
  double time = 0, slowness = 0;
  for (std::size_t i = 0; i <= nodes; ++i) {
    const State s = train::at_rest(stress_.at(node_ * static_cast<double>(i)));
    const double next = s.empty() ? std::numeric_limits<double>::infinity() : 1 / speed_at(s);
    if (i > 0) time += node_ * (slowness + next) / 2;
    slowness = next;
    pressure_.push_back(modulation::pressure(s.psi));
    time_.push_back(time);
  }
}

double HeldSide::front_time(double distance) const {
  const auto i = std::min(static_cast<std::size_t>(distance / node_), nodes - 1);
  const double share = distance / node_ - static_cast<double>(i);
  if (!(share > 0)) return time_[i];
  return std::isinf(time_[i + 1]) ? time_[i + 1] : std::lerp(time_[i], time_[i + 1], share);
}

pulse::Problem HeldSide::problem() const {
  const auto stress = [side = *this](double x) { return x > 0 ? 0 : side.stress_.at(-x); };
  const auto load = [side = *this](double x, double) {
    if (x > 0 || -x >= side.length_) return 0.0;
    const double k = side.stress_.at(-x);
    if (!(k > 0)) return 0.0;
    const auto i = std::min(static_cast<std::size_t>(-x / side.node_), nodes - 1);
    return (side.pressure_[i] - side.pressure_[i + 1]) / (side.node_ * k);
  };
  return {.stress = stress,
          .forcing = load,
          .friction = {},
          .left = -length_,
          .right = 0.1 * length_,
          .corner = 0,
          .cells = 1600};
}

}  // namespace slipfront::finite_fault
