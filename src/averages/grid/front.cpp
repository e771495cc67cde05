#include "averages/grid/front.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::plane {

using std::numbers::pi;

namespace {

constexpr int layers = 4;  ///< the stencil of six cells needs these layers outside the front
/// Least distance from the front to the next cell outside it, in cells.
constexpr double nearest = 1e-6;

}  // namespace

/// Sums over the known neighbours of a cell whose slip rises away from it, weighted by the squares of the steps.
struct Front::Neighbours {
  double weight = 0, slip = 0, step = 0, action = 0;
  double gradient2 = 0;  ///< square of the gradient on the far side of the neighbours
};

Front::Front(const Problem& problem, const Cells& cells)
    : problem_(problem),
      cells_(cells),
      psi_ahead_(train::psi_of_stress(gradient_ahead)),
      J0_ahead_(train::averages(train::at_rest(gradient_ahead)).J),
      known_(cells.size(), 0) {}

Front::Neighbours Front::neighbours_of(std::size_t cell, const Averages& now) const {
  Neighbours sum;
  for (const bool along_y : {false, true}) {
    double steepest = 0;
    for (const bool up : {false, true}) {
      const std::size_t step = cells_.step(along_y), first = up ? cell + step : cell - step,
                        second = up ? first + step : first - step;
      if (known_[first] == 0 || known_[second] == 0) continue;
      const double rise = std::fmax(now.slip[second] - now.slip[first], 0.0), weight = rise * rise;
      sum.weight += weight;
      sum.slip += weight * now.slip[first];
      sum.step += weight * rise;
      sum.action += weight * now.action[first];
      steepest = std::fmax(steepest, rise / cells_.spacing(along_y));
    }
    sum.gradient2 += steepest * steepest;
  }
  return sum;
}

/// The first cell outside the front: phi + psi arrives from inside, and few lines are ahead. The slip falls to 0 as its
/// gradient inside implies.
void Front::set_first(std::size_t cell, const Neighbours& n, Averages& now) const {
  const Point at = cells_.centre(cell);
  const double a = problem_.contact ? problem_.contact(at.x, at.y) : 1;
  const double gradient = std::sqrt(n.gradient2), action = n.action / n.weight;
  const State inside = modulation::state_of({2 * pi * a / std::fmax(gradient, no_lines * a), 2 * pi * action / a}, 0.1);
  double slower = 1;
  now.action[cell] = action;
  if (inside.psi > psi_ahead_) {
    const double phi = inside.phi + inside.psi - psi_ahead_;
    now.action[cell] = a * J0_ahead_ * std::sinh(phi);
    slower = std::fmin(1.0, a * gradient_ahead * std::cosh(phi) / gradient);
  }
  now.slip[cell] = std::fmin(slower * (n.slip - n.step), -nearest * n.step) / n.weight;
}

const std::vector<char>& Front::extend(Averages& now) {
  empty_.clear();
  cells_.each([&](std::size_t, std::size_t, std::size_t cell) {
    known_[cell] = now.slip[cell] > 0 ? 1 : 0;
    if (known_[cell] == 0) empty_.push_back(cell);
  });
  cells_.mirror(known_);
  cells_.mirror(now.slip);
  cells_.mirror(now.action);
  for (int layer = 0; layer < layers; ++layer) {
    found_.clear();
    for (const std::size_t cell : empty_) {
      if (known_[cell] != 0) continue;
      const Neighbours n = neighbours_of(cell, now);
      if (n.weight <= 0) continue;
      found_.push_back(cell);
      if (layer == 0) {
        set_first(cell, n, now);
      } else {
        now.action[cell] = n.action / n.weight;
        now.slip[cell] = std::fmin(n.slip - n.step, -nearest * n.step) / n.weight;
      }
    }
    for (const std::size_t cell : found_) known_[cell] = 1;
  }
  for (const std::size_t cell : empty_)
    if (known_[cell] == 0) now.slip[cell] = now.action[cell] = 0;
  return known_;
}

}  // namespace slipfront::plane
