#include "averages/grid/steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "math/digits.hpp"
#include "math/time_steps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::plane {

namespace {

using std::numbers::pi;

constexpr double courant = 0.4;
/// A step is at most courant / friction_share of the time in which friction takes the wave action, because half steps
/// of friction would let strongly damped lines move freely in between.
constexpr double friction_share = 4;

}  // namespace

GridSteps::GridSteps(const Problem& problem, const Cells& cells, GridMotion& motion, int threads)
    : problem_(problem),
      cells_(cells),
      motion_(motion),
      walls_(problem, cells),
      equations_(problem, cells, walls_, threads),
      front_(problem, cells),
      friction_acts_(problem.friction.acts()),
      acts_in_stages_(problem.friction.acts() && problem.friction.steep_at_rest()),
      sticks_(problem.friction.sticks()),
      free_(cells.size(), 0.0) {
  if (acts_in_stages_ && !sticks_) slowed_ = std::make_unique<Slowed>(problem.friction, cells);
  for (auto* averages : {&rate_, &old_}) {
    averages->slip.assign(cells.size(), 0);
    averages->action.assign(cells.size(), 0);
  }
  motion.strength.assign(cells.size(), 0);
  each_ = problem.friction.state_size();
  motion.states.assign(each_ * cells.size(), 0);
  for (std::size_t cell = 0; each_ > 0 && cell < cells.size(); ++cell) {
    const Point at = cells.centre(cell);  // a ghost cell has the values at the edge
    problem.friction.start(std::clamp(at.x, problem.left, problem.right), std::clamp(at.y, problem.bottom, problem.top),
                           std::span(motion.states).subspan(cell * each_, each_));
  }
  if (problem.nucleation) {
    const Nucleation& n = *problem.nucleation;
    patch_.assign(cells.size(), 0);
    cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
      patch_[cell] = std::hypot(cells.x(i) - n.x, cells.y(j) - n.y) <= n.radius ? 1 : 0;
    });
  }
  if (problem.hold) hold();
}

GridSteps::Slowed::Slowed(const friction::Friction& friction, const Cells& cells) {
  for (std::size_t j = 0; j < cells.ny; ++j) rows.emplace_back(friction, cells.nx);
  for (auto* values : {&momentum, &velocity, &typical_speed, &force, &slope, &s, &fastest, &mean_force})
    values->assign(cells.size(), 0);
  state_values.resize(friction.state_size() * cells.size());
}

/// The static load is the opposite of what would move the lines at t = 0.
void GridSteps::hold() {
  equations_.set_known(front_.extend(motion_.now));
  equations_.find_rates(0, motion_.now, rate_);
  held_.assign(cells_.size(), 0);
  for (const std::size_t cell : equations_.trains().at) {
    if (motion_.now.slip[cell] <= 0) continue;
    held_[cell] = -rate_.action[cell];
    refuse_steep_edge(cell);
  }
}

/// A static load on the outermost lines would be infinite where the slip ends steeply.
void GridSteps::refuse_steep_edge(std::size_t cell) const {
  const std::vector<double>& slip = motion_.now.slip;
  const std::size_t row = cells_.stride();
  const bool at_front = slip[cell - 1] <= 0 || slip[cell + 1] <= 0 || slip[cell - row] <= 0 || slip[cell + row] <= 0;
  const double gradient = equations_.inside(cell, slip).gradient;
  const Point at = cells_.centre(cell);
  const double a = problem_.contact ? problem_.contact(at.x, at.y) : 1;
  if (!at_front || gradient <= gradient_ahead * a) return;
  throw InputError({.key = "hold",
                    .problem = "the slip ends with the gradient " + digits(gradient, 3) + " at x = " + digits(at.x, 4) +
                               ", y = " + digits(at.y, 4) + ", where a static load would be infinite",
                    .allowed = "a slip that falls to 0 with a gradient below " + digits(gradient_ahead * a, 2)});
}

/// Nothing holds the lines in the nucleation patch any more.
void GridSteps::release() {
  if (held_.empty() || patch_.empty() || !problem_.nucleation_has_begun(motion_.time)) return;
  for (std::size_t cell = 0; cell < held_.size(); ++cell)
    if (is_free(cell)) held_[cell] = 0;
}

/// F at the centre of a cell. If it does not change, its formula is called once.
double GridSteps::forcing_at(std::size_t cell, double t) {
  const auto find = [&] {
    const Point at = cells_.centre(cell);
    return problem_.forcing(at.x, at.y, t);
  };
  if (!problem_.steady_forcing) return find();
  if (std::isnan(steady_forcing_[cell])) steady_forcing_[cell] = find();
  return steady_forcing_[cell];
}

void GridSteps::add_loads(double t) {
  motion_.supply = 0;
  if (held_.empty() && !problem_.forcing) return;
  if (problem_.steady_forcing) steady_forcing_.resize(rate_.action.size(), std::numeric_limits<double>::quiet_NaN());
  motion_.supply = equations_.sum_over_trains([&](std::size_t, std::size_t cell) {
    double load = held_.empty() ? 0 : held_[cell];
    if (problem_.forcing) load += forcing_at(cell, t);
    rate_.action[cell] += load;
    return motion_.now.slip[cell] > 0 ? load * rate_.slip[cell] * cells_.hx * cells_.hy : 0;
  });
}

/// The mean forces on the trains, by vector code.
void GridSteps::find_forces() {
  const Trains& trains = equations_.trains();
  equations_.each_row(trains, [&](std::size_t first, std::size_t last) {
    Slowed& s = *slowed_;
    for (std::size_t i = first; i < last; ++i) {
      const double a = trains.contact.empty() ? 1 : trains.contact[i];
      s.fastest[i] = 2 * a * std::sinh(std::fabs(trains.phi[i])) * std::cosh(trains.psi[i]);
      std::copy_n(state_of(trains.at[i]).begin(), each_, s.state_values.data() + i * each_);
    }
    problem_.friction.average().mean_strengths(
        {last - first, &s.fastest[first], &trains.s[first], {s.state_values.data() + first * each_, each_}},
        problem_.friction.closure(), &s.mean_force[first], nullptr);
  });
}

void GridSteps::find_strengths() {
  motion_.power = 0;
  if (!friction_acts_) return;
  if (slowed_) find_forces();
  const Trains& trains = equations_.trains();
  const bool consistent = problem_.friction.closure() == friction::Closure::consistent;
  motion_.power = equations_.sum_over_trains([&](std::size_t i, std::size_t cell) {
    const Point at = cells_.centre(cell);
    const double size = std::fabs(motion_.now.action[cell]);
    double force = 0;
    const auto C = problem_.friction.linear_coefficient(at.x, at.y);
    if (C && consistent) {
      motion_.strength[cell] = *C;
      force = motion_.strength[cell] * size;
    } else {
      const double a = trains.contact.empty() ? 1 : trains.contact[i];
      if (!is_released(cell))
        force = slowed_ ? slowed_->mean_force[i]
                        : problem_.friction.mean_strength({trains.phi[i], trains.psi[i]}, a, state_of(cell));
      motion_.strength[cell] = sticks_ ? force : (size > 0 ? force / size : 0);
    }
    return motion_.now.slip[cell] > 0 ? force * std::fabs(rate_.slip[cell]) * cells_.hx * cells_.hy : 0;
  });
}

std::optional<std::size_t> GridSteps::slowest_cell() const {
  if (!friction_acts_ || acts_in_stages_) return {};
  std::optional<std::size_t> slowest;
  for (const std::size_t cell : equations_.trains().at)
    if (motion_.strength[cell] > (slowest ? motion_.strength[*slowest] : 0)) slowest = cell;
  return slowest;
}

double GridSteps::longest_step() const {
  const double rate = 1 / std::fmin(cells_.hx, cells_.hy);
  const std::optional<std::size_t> slowest = slowest_cell();
  return courant / (rate + (slowest ? friction_share * motion_.strength[*slowest] : 0));
}

StepsAhead GridSteps::ahead(double duration) const {
  StepsAhead steps{.by_waves = duration / (courant * std::fmin(cells_.hx, cells_.hy)),
                   .in_all = duration / longest_step(),
                   .reason = {}};
  const std::optional<std::size_t> slowest = slowest_cell();
  if (slowest && steps.in_all > 2 * steps.by_waves) {
    const Point at = cells_.centre(*slowest);
    steps.reason = "Friction stops the lines at x = " + digits(at.x, 4) + ", y = " + digits(at.y, 4) +
                   " in a time of " + digits(1 / motion_.strength[*slowest], 3) + ", of which a step is a tenth";
  } else {
    steps.reason = "Each step is " + digits(courant, 2) + " of the time in which a wave crosses a cell";
  }
  return steps;
}

void GridSteps::look() { look_after(0); }

/// Looks at the end of a step, in the second half of which the state variables change for `half_step`.
void GridSteps::look_after(double half_step) {
  release();
  guesses_ = equations_.guesses();
  equations_.set_known(front_.extend(motion_.now));
  equations_.find_rates(motion_.time, motion_.now, rate_);
  age(half_step);
  add_loads(motion_.time);
  find_strengths();
  if (motion_.met_at < 0 && equations_.lines_meet()) motion_.met_at = motion_.time;
}

/// Changes the state variables over a time in which the trains stay the same.
void GridSteps::age(double time) {
  if (each_ == 0) return;
  const Trains& trains = equations_.trains();
  equations_.each_train([&](std::size_t i, std::size_t cell) {
    if (motion_.now.slip[cell] <= 0) return;
    const double a = trains.contact.empty() ? 1 : trains.contact[i];
    const double typical = a * std::sinh(std::fabs(trains.phi[i])) * std::exp(trains.psi[i]);
    problem_.friction.evolution().advance({std::fabs(rate_.slip[cell]), typical}, time,
                                          std::span(motion_.states).subspan(cell * each_, each_));
  });
}

void GridSteps::slow(double time) {
  if (!friction_acts_ || acts_in_stages_) return;
  equations_.each_train(
      [&](std::size_t, std::size_t cell) { motion_.now.action[cell] *= std::exp(-motion_.strength[cell] * time); });
}

/// Slows the action in `free_` by the friction of the trains of a row that it leaves.
void GridSteps::slow_implicitly(double step, std::size_t first, std::size_t last) {
  constexpr double least = 1e-300;
  const Trains& trains = equations_.trains();
  Slowed& slowed = *slowed_;
  pulse::SlowedTrains& row = slowed.rows[trains.at[first] / cells_.stride() - Cells::ghosts];
  const auto is_slowed = [&](std::size_t cell) {
    return 2 * pi * std::fabs(free_[cell]) >= least && !is_released(cell);
  };
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t cell = trains.at[i];
    if (!is_slowed(cell)) continue;
    const double size = 2 * pi * std::fabs(free_[cell]), before = 2 * pi * std::fabs(motion_.now.action[cell]);
    row.add({.cell = cell,
             .spacing = trains.spacing[i],
             .contact = trains.contact.empty() ? 1 : trains.contact[i],
             .state_values = motion_.states.data() + cell * each_,
             .free = size,
             .guess = std::clamp(before, 1e-6 * size, size),
             .s_guess = trains.s[i]});
  }
  row.solve(step, {.momentum = slowed.momentum.data(),
                   .velocity = slowed.velocity.data(),
                   .typical_speed = slowed.typical_speed.data(),
                   .force = slowed.force.data(),
                   .slope = slowed.slope.data(),
                   .s = slowed.s.data()});
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t cell = trains.at[i];
    if (is_slowed(cell)) free_[cell] = std::copysign(slowed.momentum[cell] / (2 * pi), free_[cell]);
  }
}

/// now = of_old * old + (1 - of_old) (now + step * rates). The state variables change for half a step in the first
/// stage. Friction with strength at rest takes from the size of the action, and at most all of it.
void GridSteps::stage(double t, double step, double of_old) {
  equations_.find_rates(t, motion_.now, rate_);
  if (of_old == 0) age(step / 2);
  add_loads(t);
  Averages& now = motion_.now;
  const Trains& trains = equations_.trains();
  equations_.each_row(trains, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t cell = trains.at[i];
      double& action = free_[cell];
      action = now.action[cell] + step * rate_.action[cell];
      if (sticks_) action = std::copysign(std::fmax(std::fabs(action) - step * motion_.strength[cell], 0.0), action);
    }
    if (slowed_) slow_implicitly(step, first, last);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t cell = trains.at[i];
      now.action[cell] = of_old * old_.action[cell] + (1 - of_old) * free_[cell];
      now.slip[cell] = of_old * old_.slip[cell] + (1 - of_old) * (now.slip[cell] + step * rate_.slip[cell]);
    }
  });
}

/// No wave action remains in a cell without lines.
void GridSteps::remove_idle_actions() {
  equations_.each_train([&](std::size_t, std::size_t cell) {
    if (equations_.is_flat(cell)) motion_.now.action[cell] = 0;
  });
}

void GridSteps::take(double end) {
  const double remaining = end - motion_.time;
  const double step = remaining / std::ceil(remaining / longest_step());
  const double power = motion_.power, supply = motion_.supply, t = motion_.time;
  slow(step / 2);
  old_ = motion_.now;
  ssprk3(t, step, [this](double at, double length, double of_old) { stage(at, length, of_old); });
  slow(step / 2);
  remove_idle_actions();
  motion_.time = step == remaining ? end : t + step;
  ++motion_.steps;
  look_after(step / 2);
  motion_.dissipated += step * (power + motion_.power) / 2;
  motion_.supplied += step * (supply + motion_.supply) / 2;
}

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
