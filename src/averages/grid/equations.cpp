#include "averages/grid/equations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/digits.hpp"
#include "math/roots.hpp"
#include "math/simd/vector_code.hpp"
#include "math/weno.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/modulation/modulation.hpp"

namespace slipfront::plane {

using std::numbers::pi;

namespace {

/// Velocity of the lines, in c, above which the scheme damps waves in the slip in full. Slip at rest must not spread.
constexpr double fully_damped = 0.1;
/// Velocity of lines that meet others, in c.
constexpr double meeting_velocity = 0.01;

double g_of(double EK) { return 4 * EK / (pi * pi); }

/// Mean and jump of the values on both sides of the face below each of `size` cells, from averages of cells.
SLIPFRONT_CLONES void find_sides(std::size_t size, const double* value, std::ptrdiff_t step, double* mean,
                                 double* jump) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double* v = value + i;
    const double below = weno5(v[-3 * step], v[-2 * step], v[-step], v[0], v[step]),
                 above = weno5(v[2 * step], v[step], v[0], v[-step], v[-2 * step]);
    mean[i] = (below + above) / 2;
    jump[i] = above - below;
  }
}

}  // namespace

void Trains::resize(std::size_t count) {
  for (auto* array : {&gradient, &spacing, &momentum, &s, &phi, &psi, &sound, &EK, &velocity, &solved})
    array->resize(count);
}

modulation::StateArrays Trains::arrays(std::size_t first, std::size_t last) {
  const auto from = [first](std::vector<double>& values) { return values.data() + first; };
  return {last - first, from(spacing), from(momentum), from(s),        from(phi),
          from(psi),    from(sound),   from(EK),       from(velocity), from(solved)};
}

/// Solves again for trains whose guess was poor, as those that a front or lines of another density have reached.
void Trains::solve_again(std::size_t first, std::size_t last) {
  thread_local std::vector<std::size_t> left;  // kept between calls, which then allocate nothing
  thread_local Trains some;
  left.clear();
  for (std::size_t i = first; i < last; ++i)
    if (solved[i] == 0) left.push_back(i);
  if (left.empty()) return;
  while (left.size() % 8 != 0) left.push_back(left.back());  // whole vectors
  some.resize(left.size());
  for (auto of : {&Trains::spacing, &Trains::momentum})
    for (std::size_t j = 0; j < left.size(); ++j) (some.*of)[j] = (this->*of)[left[j]];
  modulation::find_guesses(some.arrays(0, left.size()));
  modulation::solve_states(some.arrays(0, left.size()));
  for (auto of : {&Trains::s, &Trains::phi, &Trains::psi, &Trains::EK, &Trains::velocity, &Trains::solved})
    for (std::size_t j = 0; j < left.size(); ++j)
      if (some.solved[j] != 0) (this->*of)[left[j]] = (some.*of)[j];
}

void solve(Trains& t, std::size_t first, std::size_t last, const std::function<std::string(std::size_t)>& where) {
  modulation::solve_states(t.arrays(first, last));
  t.solve_again(first, last);
  for (std::size_t i = first; i < last; ++i) {
    if (t.solved[i] != 0) continue;
    try {
      const double guess = t.s[i] > 0 ? std::atanh(std::fmin(t.s[i], 1 - 1e-16)) : 0;
      const modulation::SolvedState found = modulation::solve_state({t.spacing[i], t.momentum[i]}, guess);
      t.phi[i] = found.state.phi;
      t.psi[i] = found.state.psi;
      t.s[i] = std::tanh(found.state.psi);
      t.EK[i] = found.EK;
      t.velocity[i] = std::tanh(found.state.phi);
    } catch (const NumericsError& error) {
      throw NumericsError((where ? where(t.at[i]) : "") + error.what());
    }
  }
}

void set_spacing(Trains& t, std::size_t i) {
  const double a = t.contact.empty() ? 1 : t.contact[i];
  t.spacing[i] = 2 * pi * a / std::fmax(t.gradient[i], no_lines * a);  // in the local units a x, a t
}

double energy_density(const Trains& t, std::size_t i) {
  const double a = t.contact.empty() ? 1 : t.contact[i];
  return g_of(t.EK[i]) * t.gradient[i] * t.gradient[i] - a * a * modulation::pressure(t.psi[i]);
}

GridEquations::GridEquations(const Problem& problem, const Cells& cells, const Walls& walls, int threads)
    : problem_(problem), cells_(cells), walls_(walls), threads_(threads) {
  for (auto* pair : {&gradient_, &slope_, &flux_, &transverse_, &at_faces_, &jump_})
    for (auto& array : *pair) array.assign(cells.size(), 0);
  for (auto* array : {&spread_, &in_cells_.guess, &in_faces_[0].guess, &in_faces_[1].guess})
    array->assign(cells.size(), 0);
}

void GridEquations::set_known(const std::vector<char>& known) {
  known_ = known;
  const auto moves = [&](std::size_t cell) { return known_[cell] != 0 && !walls_.held(cell); };
  const std::array<Trains*, 3> all{&in_cells_, &in_faces_[0], &in_faces_[1]};
  for (Trains* trains : all) {
    trains->at.clear();
    trains->rows.clear();
  }
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    for (Trains* trains : all)
      if (i == 0) trains->rows.push_back(trains->at.size());
    if (moves(cell)) in_cells_.at.push_back(cell);
    if (i > 0 && (moves(cell) || moves(cell - 1))) in_faces_[0].at.push_back(cell);
    if (j > 0 && (moves(cell) || moves(cell - cells_.stride()))) in_faces_[1].at.push_back(cell);
  });
  for (Trains* trains : all) {
    trains->rows.push_back(trains->at.size());
    trains->resize(trains->at.size());
    if (!problem_.contact) continue;
    trains->contact.resize(trains->at.size());
    each_row(*trains, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        Point p = cells_.centre(trains->at[i]);
        if (trains == &in_faces_[0]) p.x -= cells_.hx / 2;
        if (trains == &in_faces_[1]) p.y -= cells_.hy / 2;
        trains->contact[i] = problem_.contact(p.x, p.y);
      }
    });
  }
  for (auto* pair : {&slope_, &flux_})  // 0 where nothing moves
    for (auto& array : *pair) std::fill(array.begin(), array.end(), 0.0);
}

void GridEquations::find_gradients(const std::vector<double>& slip) {
  const std::size_t row = cells_.stride();
  for_each_on_team(slip.size() / row, threads_, [&](std::size_t j) {
    for (const bool along_y : {false, true}) {
      const std::size_t step = cells_.step(along_y);
      const double per = 1 / cells_.spacing(along_y);
      for (std::size_t face = std::max(j * row, step); face < (j + 1) * row; ++face)
        gradient_[along_y ? 1 : 0][face] = (slip[face] - slip[face - step]) * per;
    }
  });
  for (const bool along_y : {false, true}) walls_.set_gradients(slip, along_y, gradient_[along_y ? 1 : 0]);
}

void GridEquations::find_slopes(std::size_t first, std::size_t last) {
  const std::size_t begin = in_cells_.at[first], count = in_cells_.at[last - 1] + 1 - begin;
  for (const bool along_y : {false, true}) {
    const std::vector<double>& g = gradient_[along_y ? 1 : 0];
    std::vector<double>& slope = slope_[along_y ? 1 : 0];
    const std::size_t step = cells_.step(along_y);
    std::vector<double>&mean = at_faces_[0], &jump = jump_[0];  // which hold nothing yet
    find_sides(count, &g[begin + step], static_cast<std::ptrdiff_t>(step), &mean[begin], &jump[begin]);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t cell = in_cells_.at[i];
      const bool near = walls_.near(cell, along_y);
      slope[cell] = near ? (g[cell] + g[cell + step]) / 2 : mean[cell];
      spread_[cell] = (along_y ? spread_[cell] : 0) + (near ? g[cell + step] - g[cell] : jump[cell]) / 2;
    }
  }
}

bool GridEquations::is_flat(std::size_t cell) const {
  const double most = 0.2 * no_lines;
  double steepest = gradient_in(cell);
  for (const bool along_y : {false, true})
    for (const std::size_t face : {cell, cell + cells_.step(along_y)})
      steepest = std::fmax(steepest, std::fabs(gradient_[along_y ? 1 : 0][face]));
  return steepest < most;
}

GridEquations::Inside GridEquations::inside(std::size_t cell, const std::vector<double>& slip) const {
  std::array<double, 2> parts{slope_[0][cell], slope_[1][cell]};
  double area = 1, steepest = 0;
  for (const std::size_t d : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t step = cells_.step(d == 1);
    const bool below = slip[cell - step] > 0, above = slip[cell + step] > 0;
    if (below == above) continue;
    parts[d] = gradient_[d][below ? cell : cell + step];
    if (std::fabs(parts[d]) <= steepest) continue;
    steepest = std::fabs(parts[d]);
    area = std::fmin(0.5 + slip[cell] / (steepest * cells_.spacing(d == 1)), 1.5);
  }
  return {std::hypot(parts[0], parts[1]), area};
}

/// Lines meet in a valley of the slip that fills, and at a peak that falls.
bool GridEquations::meet(const Averages& now, std::size_t i) const {
  const std::size_t cell = in_cells_.at[i];
  const double V = in_cells_.velocity[i];
  if (!(now.slip[cell] > 0 && std::fabs(V) > meeting_velocity)) return false;
  for (const bool along_y : {false, true}) {
    const std::vector<double>& g = gradient_[along_y ? 1 : 0];
    if (walls_.near(cell, along_y)) continue;
    const double below = std::copysign(1.0, V) * g[cell],
                 above = std::copysign(1.0, V) * g[cell + cells_.step(along_y)];
    if (below < -no_lines && above > no_lines) return true;
  }
  return false;
}

/// Finds the states from the sizes of the gradients. Where there are nearly no lines, the state is that of `no_lines`.
void GridEquations::solve_at(double t, Trains& trains, std::size_t first, std::size_t last,
                             const std::vector<double>& action) {
  for (std::size_t i = first; i < last; ++i) {
    const double a = trains.contact.empty() ? 1 : trains.contact[i];
    set_spacing(trains, i);
    trains.momentum[i] = 2 * pi * action[trains.at[i]] / a;
    trains.s[i] = trains.guess[trains.at[i]];
  }
  solve(trains, first, last, [&](std::size_t index) {
    const Point at = cells_.centre(index);
    return "t = " + digits(t) + ", x = " + digits(at.x, 4) + ", y = " + digits(at.y, 4) + ": ";
  });
  for (std::size_t i = first; i < last; ++i) trains.guess[trains.at[i]] = trains.s[i];
}

void GridEquations::find_slip_rates(std::size_t first, std::size_t last, Averages& rate) const {
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t cell = in_cells_.at[i];
    const double V = in_cells_.velocity[i], damped = std::fmin(1, std::fabs(V) / fully_damped);
    rate.slip[cell] = V * in_cells_.gradient[i] + damped * spread_[cell];  // Eq. (8.8): U_t = tanh(phi) |grad U|
  }
}

/// The gradients along the other direction at faces: means of both cells.
void GridEquations::find_transverse(std::size_t first, std::size_t last, bool along_y) {
  const std::vector<double>& slope = slope_[along_y ? 0 : 1];
  const std::size_t step = cells_.step(along_y);
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t face = in_faces_[along_y ? 1 : 0].at[i];
    transverse_[along_y ? 1 : 0][face] = (slope[face] + slope[face - step]) / 2;
  }
}

/// The wave action at faces, and its jump there, which damps short waves.
void GridEquations::find_actions(const Averages& now, std::size_t first, std::size_t last, bool along_y) {
  const std::size_t d = along_y ? 1 : 0;
  const std::vector<std::size_t>& faces = in_faces_[d].at;
  std::vector<double>&mean = at_faces_[d], &jump = jump_[d];
  const std::size_t step = cells_.step(along_y), begin = faces[first], count = faces[last - 1] + 1 - begin;
  find_sides(count, &now.action[begin], static_cast<std::ptrdiff_t>(step), &mean[begin], &jump[begin]);
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t face = faces[i];
    if (walls_.near(face, along_y) || walls_.near(face - step, along_y)) {
      const double b = now.action[face - 2 * step], c = now.action[face - step], e = now.action[face],
                   f = now.action[face + step];
      const double below = c + limited(c - b, e - c) / 2, above = e - limited(e - c, f - e) / 2;
      mean[face] = (below + above) / 2;
      jump[face] = above - below;
    }
    const bool is_front = (now.slip[face] > 0) != (now.slip[face - step] > 0);
    if (is_front || walls_.at_face(face, along_y)) jump[face] = 0;
  }
}

void GridEquations::find_fluxes(double t, const Averages& now) {
  for_each_on_team(
      cells_.ny, threads_,
      [&](std::size_t j) {
        for (const bool along_y : {false, true})
          in_faces_[along_y ? 1 : 0].in_row(j, [&](std::size_t first, std::size_t last) {
            find_transverse(first, last, along_y);
            find_actions(now, first, last, along_y);
          });
      },
      rows_at_once);
  for (const bool along_y : {false, true}) {
    walls_.set_transverse(slope_[along_y ? 0 : 1], along_y, transverse_[along_y ? 1 : 0]);
    walls_.set_actions(now.action, along_y, at_faces_[along_y ? 1 : 0]);
  }
  for_each_on_team(
      cells_.ny, threads_,
      [&](std::size_t j) {
        for (const std::size_t d : {std::size_t{0}, std::size_t{1}})
          in_faces_[d].in_row(j, [&](std::size_t first, std::size_t last) { find_fluxes(t, first, last, d); });
      },
      rows_at_once);
}

void GridEquations::find_fluxes(double t, std::size_t first, std::size_t last, std::size_t d) {
  Trains& faces = in_faces_[d];
  for (std::size_t i = first; i < last; ++i) {
    const double along = gradient_[d][faces.at[i]], across = transverse_[d][faces.at[i]];
    faces.gradient[i] = std::sqrt(along * along + across * across);
  }
  solve_at(t, faces, first, last, at_faces_[d]);
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t face = faces.at[i];
    flux_[d][face] = g_of(faces.EK[i]) * gradient_[d][face] + jump_[d][face] / 2;
  }
}

void GridEquations::find_rates(double t, Averages& now, Averages& rate) {
  cells_.mirror(now.slip);
  cells_.mirror(now.action);
  find_gradients(now.slip);
  lines_meet_ = false;
  each_row(in_cells_, [&](std::size_t first, std::size_t last) {
    find_slopes(first, last);
    for (std::size_t i = first; i < last; ++i) in_cells_.gradient[i] = gradient_in(in_cells_.at[i]);
    solve_at(t, in_cells_, first, last, now.action);
    find_slip_rates(first, last, rate);
    for (std::size_t i = first; i < last; ++i)
      if (meet(now, i)) lines_meet_ = true;
  });
  find_fluxes(t, now);
  each_train([&](std::size_t, std::size_t cell) {  // Eq. (8.4): I_t = div(g grad U) + F - <f>, with I = g U_t
    rate.action[cell] = (flux_[0][cell + 1] - flux_[0][cell]) / cells_.hx +
                        (flux_[1][cell + cells_.stride()] - flux_[1][cell]) / cells_.hy;
  });
}

namespace {

constexpr std::size_t reach = 2;  ///< a stencil of five cells reaches so far
/// A free cell this close to the boundary, less than 0.3 cells, gives no gradient with it.
constexpr double too_close = 0.2;

/// Derivative at 0 of the parabola through three values.
double slope_at_0(const std::array<double, 3>& at, const std::array<double, 3>& value) {
  const auto [a, b, c] = at;
  return -value[0] * (b + c) / ((a - b) * (a - c)) - value[1] * (a + c) / ((b - a) * (b - c)) -
         value[2] * (a + b) / ((c - a) * (c - b));
}

}  // namespace

Walls::Walls(const Problem& problem, const Cells& cells) : cells_(cells) {
  if (!problem.fixed) return;
  held_.assign(cells.size(), 0);
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    held_[cell] = problem.fixed(cells.x(i), cells.y(j)) != 0 ? 1 : 0;
  });
  cells_.mirror(held_);
  refuse_unseen(problem);
  for (const bool along_y : {false, true}) {
    std::vector<char>& near = near_[along_y ? 1 : 0];
    near.assign(cells.size(), 0);
    const std::size_t step = cells.step(along_y);
    cells.each([&](std::size_t, std::size_t, std::size_t cell) {
      for (std::size_t n = 0; n <= 2 * reach; ++n)
        if (held_[cell + n * step - reach * step] != 0) near[cell] = 1;
    });
    cells_.mirror(near);
    find(problem, along_y);
  }
}

/// A held region between the centres of cells would have no effect.
void Walls::refuse_unseen(const Problem& problem) const {
  constexpr int samples = 5;
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    for (const std::size_t row : {cell - cells_.stride(), cell, cell + cells_.stride()})
      for (const std::size_t at : {row - 1, row, row + 1})
        if (held(at)) return;
    const auto sample = [](int n) { return (n + 0.5) / samples - 0.5; };
    for (int row = 0; row < samples; ++row)
      for (int column = 0; column < samples; ++column) {
        const double x = cells_.x(i) + sample(column) * cells_.hx, y = cells_.y(j) + sample(row) * cells_.hy;
        if (problem.fixed(x, y) == 0) continue;
        throw InputError({.key = "fixed",
                          .problem = "the held region at x = " + digits(x, 4) + ", y = " + digits(y, 4) +
                                     " lies between the centres of cells",
                          .allowed = "more cells, or a larger region"});
      }
  });
}

void Walls::find(const Problem& problem, bool along_y) {
  const std::size_t step = cells_.step(along_y);
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if ((along_y ? j : i) == 0 || !at_face(cell, along_y)) return;
    const bool is_up = !held(cell);
    Crossing crossing{.face = cell, .free = {}, .count = 0, .sign = is_up ? 1.0 : -1.0, .place = 0, .slip = 0};
    for (std::size_t n = 0; n < 3; ++n) {
      crossing.free[n] = is_up ? cell + n * step : cell - (n + 1) * step;
      if (crossing.count == n && !held(crossing.free[n])) ++crossing.count;
    }
    const auto point = [&](double place) {
      const double along = crossing.sign * place * cells_.spacing(along_y);
      return Point{cells_.x(i) + (along_y ? 0 : along - cells_.hx / 2),
                   cells_.y(j) + (along_y ? along - cells_.hy / 2 : 0)};
    };
    const auto is_fixed = [&](double place) {
      const Point at = point(place);
      return problem.fixed(at.x, at.y) != 0;
    };
    crossing.place = bisected({.holding = -0.5, .failing = 0.5}, is_fixed, 40).failing;
    const Point at = point(crossing.place);
    crossing.slip = problem.slip(at.x, at.y);
    crossings_[along_y ? 1 : 0].push_back(crossing);
  });
}

void Walls::set_gradients(const std::vector<double>& slip, bool along_y, std::vector<double>& gradient) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const std::size_t first = c.place > too_close && c.count > 1 ? 1 : 0;
    double slope = 0;
    if (c.count < first + 2) {
      const double at = static_cast<double>(first) + 0.5;
      slope = (slip[c.free[first]] - c.slip) / (at - std::fmin(c.place, too_close));
    } else {
      const double at = static_cast<double>(first) + 0.5;
      slope = slope_at_0({c.place, at, at + 1}, {c.slip, slip[c.free[first]], slip[c.free[first + 1]]});
    }
    gradient[c.face] = c.sign * slope / cells_.spacing(along_y);
  }
}

void Walls::set_actions(const std::vector<double>& action, bool along_y, std::vector<double>& at_faces) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const std::size_t first = c.place > too_close && c.count > 1 ? 1 : 0;
    const double at = static_cast<double>(first) + 0.5;
    at_faces[c.face] = -action[c.free[first]] * c.place / (at - std::fmin(c.place, too_close));
  }
}

void Walls::set_transverse(const std::vector<double>& in_cells, bool along_y, std::vector<double>& at_faces) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const double first = in_cells[c.free[0]];
    at_faces[c.face] = c.count > 1 ? first + (first - in_cells[c.free[1]]) / 2 : first;
  }
}

}  // namespace slipfront::plane
