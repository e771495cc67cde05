#include "averages/loops/steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "math/digits.hpp"
#include "math/interpolation.hpp"
#include "math/time_steps.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"

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

using std::numbers::pi;

std::vector<double> slip_velocities(const Loops& loops, const LoopEquations& equations) {
  std::vector<double> w(loops.cells());
  for (std::size_t i = 0; i < w.size(); ++i)
    w[i] = 2 * pi * equations.velocity()[i] / equations.spacing()[i];  // U_t = 2 pi r_t / l
  return w;
}

Ray::Ray(const Loops& loops, double angle) : loops_(loops) {
  if (loops.angles == 1) return;
  const double turned = angle / loops.turn(), whole = std::floor(turned), f = turned - whole;
  const auto n = static_cast<std::ptrdiff_t>(loops.angles), first = static_cast<std::ptrdiff_t>(whole) - 1;
  for (std::ptrdiff_t j = 0; j < 4; ++j)
    column_.at(static_cast<std::size_t>(j)) = static_cast<std::size_t>(((first + j) % n + n) % n);
  weight_ = {-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
             (f + 1) * f * (f - 1) / 6};
}

double Ray::of(const double* row) const {
  double sum = 0;
  for (std::size_t j = 0; j < 4; ++j) sum += weight_[j] * row[column_[j]];
  return sum;
}

std::size_t Ray::first_face_inside(double r) const {
  std::size_t outside = 0, inside = loops_.rows;
  while (inside - outside > 1) {
    const std::size_t middle = (outside + inside) / 2;
    (r > face(middle) ? inside : outside) = middle;
  }
  return inside;
}

double Ray::loops_outside(double r) const {
  if (r >= face(0)) return 0;
  if (r <= face(loops_.rows)) return loops_.label.back();
  const std::size_t j = first_face_inside(r), first = std::min(j >= 2 ? j - 2 : 0, loops_.rows - 3);
  std::array<double, 4> faces{};
  for (std::size_t i = 0; i < 4; ++i) faces[i] = face(first + i);
  const double q = lagrange(4, faces.data(), &loops_.label[first], r);
  return std::clamp(q, loops_.label[j - 1], loops_.label[j]);
}

double Ray::at(const std::vector<double>& values, double r) const {
  if (r > face(0) || r <= face(loops_.rows)) return 0;
  const std::size_t inner = first_face_inside(r), row = inner - 1;
  const auto centre = [&](std::size_t i) { return (face(i) + face(i + 1)) / 2; };
  const std::size_t next = r > centre(row) ? (row > 0 ? row - 1 : row) : std::min(row + 1, loops_.rows - 1);
  if (next == row) return cell(values, row);
  const double here = centre(row), there = centre(next);
  return cell(values, row) + (cell(values, next) - cell(values, row)) * (r - here) / (there - here);
}

double volume(const Loops& loops) {
  const auto area = [&](std::size_t face) {
    double sum = 0;
    for (std::size_t k = 0; k < loops.angles; ++k) {
      const double r = loops.r[face * loops.angles + k];
      sum += r * r / 2 * loops.turn();
    }
    return sum;
  };
  double sum = 0;
  for (std::size_t row = 0; row < loops.rows; ++row) sum += loops.charge(row) * (area(row) + area(row + 1)) / 2;
  return 2 * pi * sum;
}

LoopEnergy energy(const Loops& loops, const LoopEquations& equations) {
  LoopEnergy total{0, 0};
  for (std::size_t i = 0; i < loops.cells(); ++i) {
    const std::size_t inner = i + loops.angles;
    const double a = equations.contact(i);
    const double area = (loops.r[i] - loops.r[inner]) * (loops.r[i] + loops.r[inner]) / 2 * loops.turn();
    const State train{equations.phi()[i], equations.psi()[i]};
    const train::Averages now = train::averages(train, a);
    const double k = now.k;  // the gradient of the slip
    const double at_rest =
        k / a >= train::smallest_stress ? train::averages(train::at_rest(k / a), a).H : 8 * a * k / (2 * pi);
    total.elastic += at_rest * area;
    total.kinetic += (now.H - at_rest) * area;
  }
  return total;
}

}  // namespace slipfront::plane
