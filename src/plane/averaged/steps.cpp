#include "plane/averaged/steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "foundation/math/ssprk3.hpp"
#include "foundation/text/digits.hpp"
#include "modulation/equations.hpp"

namespace slipfront::plane {

namespace {

constexpr double courant = 0.7;
/// A step is at most courant / friction_share of the time in which friction takes the momentum, because half steps of
/// friction would let strongly damped loops move freely in between.
constexpr double friction_share = 4;

}  // namespace

LoopSteps::LoopSteps(const Problem& problem, Loops& loops)
    : problem_(problem), loops_(loops), equations_(problem, loops) {
  r_rate_.assign(loops.r.size(), 0);
  momentum_rate_.assign(loops.momentum.size(), 0);
  loops.loss.assign(loops.momentum.size(), 0);
  friction_acts_ = problem.friction.acts();
}

void LoopSteps::look() {
  equations_.find_rates(loops_.time, loops_.r, loops_.momentum, loops_.s, r_rate_, momentum_rate_);
  find_strengths();
  const double rate = loops_.loss.empty() ? 0 : *std::max_element(loops_.loss.begin(), loops_.loss.end());
  loops_.limit = 1 / (1 / equations_.longest_step() + friction_share * rate);
  loops_.supply = equations_.supply();
  loops_.power = power_of_friction();
}

/// Finds the rate at which friction takes momentum.
void LoopSteps::find_strengths() {
  if (!friction_acts_) return;
  const friction::Friction& friction = problem_.friction;
  std::vector<double> local(friction.state_size());
  for (std::size_t i = 0; i < loops_.loss.size(); ++i) {
    const Point at = equations_.centre(i);
    const auto C = friction.linear_coefficient(at.x, at.y);
    if (C && friction.closure() == friction::Closure::consistent) {
      loops_.loss[i] = *C;
      continue;
    }
    const State train{equations_.phi()[i], equations_.psi()[i]};
    friction.start(at.x, at.y, local);
    const double mean = friction.mean_strength(train, equations_.contact(i), local);
    const double force = modulation::force_per_dislocation(mean) * equations_.middle(i);
    loops_.loss[i] = loops_.momentum[i] == 0 ? 0 : force / std::fabs(loops_.momentum[i]);
  }
}

double LoopSteps::power_of_friction() const {
  if (!friction_acts_) return 0;
  double power = 0;
  for (std::size_t i = 0; i < loops_.loss.size(); ++i) {
    const double taken = loops_.loss[i] * std::fabs(loops_.momentum[i]);
    power += taken * std::fabs(equations_.velocity()[i]) * loops_.charge(i / loops_.angles) * loops_.turn();
  }
  return power;
}

void LoopSteps::add_friction(double time) {
  if (!friction_acts_) return;
  for (std::size_t i = 0; i < loops_.loss.size(); ++i) loops_.momentum[i] *= std::exp(-loops_.loss[i] * time);
}

void LoopSteps::keep_outside_wall(std::vector<double>& r) const {
  const std::size_t inner = loops_.rows * loops_.angles;
  for (std::size_t k = 0; k < loops_.angles; ++k)
    if (loops_.wall[k] > 0) r[inner + k] = std::fmax(r[inner + k], loops_.wall[k]);
}

/// loops = of_old * old + (1 - of_old) (loops + step * rates).
void LoopSteps::stage(double t, double step, double of_old, const std::vector<double>& r,
                      const std::vector<double>& momentum) {
  equations_.find_rates(t, loops_.r, loops_.momentum, loops_.s, r_rate_, momentum_rate_);
  const double of_new = 1 - of_old;
  for (std::size_t i = 0; i < loops_.r.size(); ++i)
    loops_.r[i] = of_old * r[i] + of_new * (loops_.r[i] + step * r_rate_[i]);
  for (std::size_t i = 0; i < loops_.momentum.size(); ++i)
    loops_.momentum[i] = of_old * momentum[i] + of_new * (loops_.momentum[i] + step * momentum_rate_[i]);
  keep_outside_wall(loops_.r);
}

StepsAhead LoopSteps::ahead(double duration) const {
  const double by_waves = equations_.longest_step();
  StepsAhead steps{
      .by_waves = duration / (courant * by_waves), .in_all = duration / (courant * loops_.limit), .reason = {}};
  const auto strongest = std::max_element(loops_.loss.begin(), loops_.loss.end());
  if (loops_.limit < by_waves / 2) {
    const Point at = equations_.centre(static_cast<std::size_t>(strongest - loops_.loss.begin()));
    steps.reason = "Friction stops the lines at x = " + digits(at.x, 4) + ", y = " + digits(at.y, 4) +
                   " in a time of " + digits(1 / *strongest, 3) + ", of which a step is a sixth";
  } else {
    steps.reason = "Each step is " + digits(courant, 2) + " of the time in which a wave crosses the narrowest cell";
  }
  return steps;
}

void LoopSteps::take(double end) {
  if (loops_.limit == 0) look();
  const double remaining = end - loops_.time;
  const double step = remaining / std::ceil(remaining / (courant * loops_.limit));
  const double power = loops_.power, supply = loops_.supply, t = loops_.time;
  add_friction(step / 2);
  r_ = loops_.r;
  momentum_ = loops_.momentum;
  ssprk3(t, step, [this](double at, double length, double of_old) { stage(at, length, of_old, r_, momentum_); });
  look();
  add_friction(step / 2);
  loops_.time = step == remaining ? end : t + step;
  ++loops_.steps;
  loops_.dissipated += step * (power + loops_.power) / 2;
  loops_.supplied += step * (supply + loops_.supply) / 2;
}

}  // namespace slipfront::plane
