#include "averages/grid/equations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/digits.hpp"
#include "math/weno.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/modulation/solve_states.hpp"

namespace slipfront::plane {

using std::numbers::pi;

namespace {

/// Velocity of the lines, in c, above which the scheme damps waves in the slip in full. Slip at rest must not spread.
constexpr double fully_damped = 0.1;
/// Velocity of lines that meet others, in c.
constexpr double meeting_velocity = 0.01;

double g_of(double EK) { return 4 * EK / (pi * pi); }

struct Sides {
  double below, above;
};
/// Values on both sides of the face below a cell, from averages of cells.
Sides sides(const double* value, std::ptrdiff_t step, bool low_order) {
  const double a = value[-3 * step], b = value[-2 * step], c = value[-step], d = value[0], e = value[step],
               f = value[2 * step];
  if (low_order) return {c + limited(c - b, d - c) / 2, d - limited(d - c, e - d) / 2};
  return {weno5(a, b, c, d, e), weno5(f, e, d, c, b)};
}

}  // namespace

void Trains::resize(std::size_t count) {
  for (auto* array : {&gradient, &spacing, &momentum, &s, &phi, &psi, &sound, &EK, &velocity, &solved})
    array->assign(count, 0);
}

modulation::StateArrays Trains::arrays() {
  return {s.size(),   spacing.data(), momentum.data(), s.data(),        phi.data(),
          psi.data(), sound.data(),   EK.data(),       velocity.data(), solved.data()};
}

/// Solves again for trains whose guess was poor, as those that a front or lines of another density have reached.
void Trains::solve_again() {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (solved[i] == 0) left.push_back(i);
  Trains some;
  some.resize(left.size());
  for (auto of : {&Trains::spacing, &Trains::momentum, &Trains::s})
    for (std::size_t j = 0; j < left.size(); ++j) (some.*of)[j] = (this->*of)[left[j]];
  modulation::improve_guesses(some.arrays());
  modulation::solve_states(some.arrays());
  for (auto of : {&Trains::s, &Trains::phi, &Trains::psi, &Trains::EK, &Trains::velocity, &Trains::solved})
    for (std::size_t j = 0; j < left.size(); ++j)
      if (some.solved[j] != 0) (this->*of)[left[j]] = (some.*of)[j];
}

void solve_all(Trains& t, const std::function<std::string(std::size_t)>& where) {
  modulation::solve_states(t.arrays());
  t.solve_again();
  for (std::size_t i = 0; i < t.at.size(); ++i) {
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

GridEquations::GridEquations(const Problem& problem, const Cells& cells, const Walls& walls)
    : problem_(problem), cells_(cells), walls_(walls) {
  for (auto* pair : {&gradient_, &slope_, &flux_})
    for (auto& array : *pair) array.assign(cells.size(), 0);
  for (auto* array :
       {&spread_, &transverse_, &at_faces_, &jump_, &in_cells_.guess, &in_faces_[0].guess, &in_faces_[1].guess})
    array->assign(cells.size(), 0);
}

void GridEquations::set_known(const std::vector<char>& known) {
  known_ = known;
  const auto moves = [&](std::size_t cell) { return known_[cell] != 0 && !walls_.held(cell); };
  in_cells_.at.clear();
  for (Trains& faces : in_faces_) faces.at.clear();
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if (moves(cell)) in_cells_.at.push_back(cell);
    if (i > 0 && (moves(cell) || moves(cell - 1))) in_faces_[0].at.push_back(cell);
    if (j > 0 && (moves(cell) || moves(cell - cells_.stride()))) in_faces_[1].at.push_back(cell);
  });
  for (Trains* trains : {&in_cells_, &in_faces_[0], &in_faces_[1]}) {
    trains->resize(trains->at.size());
    trains->contact.clear();
    if (!problem_.contact) continue;
    for (const std::size_t at : trains->at) {
      Point p = cells_.centre(at);
      if (trains == &in_faces_[0]) p.x -= cells_.hx / 2;
      if (trains == &in_faces_[1]) p.y -= cells_.hy / 2;
      trains->contact.push_back(problem_.contact(p.x, p.y));
    }
  }
}

void GridEquations::find_gradients(const std::vector<double>& slip) {
  for (const bool along_y : {false, true}) {
    std::vector<double>& gradient = gradient_[along_y ? 1 : 0];
    const std::size_t step = cells_.step(along_y);
    const double per = 1 / cells_.spacing(along_y);
    for (std::size_t face = step; face < slip.size(); ++face) gradient[face] = (slip[face] - slip[face - step]) * per;
    walls_.set_gradients(slip, along_y, gradient);
  }
}

void GridEquations::find_slopes() {
  for (auto& slope : slope_) std::fill(slope.begin(), slope.end(), 0.0);
  for (const std::size_t cell : in_cells_.at) {
    spread_[cell] = 0;
    for (const bool along_y : {false, true}) {
      const std::vector<double>& g = gradient_[along_y ? 1 : 0];
      const std::size_t step = cells_.step(along_y);
      double below = g[cell], above = g[cell + step];
      if (!walls_.near(cell, along_y)) {
        const double a = g[cell - 2 * step], b = g[cell - step], c = g[cell], d = g[cell + step],
                     e = g[cell + 2 * step], f = g[cell + 3 * step];
        below = weno5(a, b, c, d, e);
        above = weno5(f, e, d, c, b);
      }
      slope_[along_y ? 1 : 0][cell] = (below + above) / 2;
      spread_[cell] += (above - below) / 2;
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
void GridEquations::find_meeting(const Averages& now) {
  lines_meet_ = false;
  for (std::size_t i = 0; i < in_cells_.at.size(); ++i) {
    const std::size_t cell = in_cells_.at[i];
    const double V = in_cells_.velocity[i];
    if (!(now.slip[cell] > 0 && std::fabs(V) > meeting_velocity)) continue;
    for (const bool along_y : {false, true}) {
      const std::vector<double>& g = gradient_[along_y ? 1 : 0];
      if (walls_.near(cell, along_y)) continue;
      const double below = std::copysign(1.0, V) * g[cell],
                   above = std::copysign(1.0, V) * g[cell + cells_.step(along_y)];
      if (below < -no_lines && above > no_lines) lines_meet_ = true;
    }
  }
}

/// Finds the states from the sizes of the gradients. Where there are nearly no lines, the state is that of `no_lines`.
void GridEquations::solve(double t, Trains& trains, const std::vector<double>& action) {
  const std::size_t n = trains.at.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double a = trains.contact.empty() ? 1 : trains.contact[i];
    set_spacing(trains, i);
    trains.momentum[i] = 2 * pi * action[trains.at[i]] / a;
    trains.s[i] = trains.guess[trains.at[i]];
  }
  solve_all(trains, [&](std::size_t index) {
    const Point at = cells_.centre(index);
    return "t = " + digits(t) + ", x = " + digits(at.x, 4) + ", y = " + digits(at.y, 4) + ": ";
  });
  for (std::size_t i = 0; i < n; ++i) trains.guess[trains.at[i]] = trains.s[i];
}

void GridEquations::find_slip_rates(Averages& rate) {
  for (std::size_t i = 0; i < in_cells_.at.size(); ++i) {
    const std::size_t cell = in_cells_.at[i];
    const double V = in_cells_.velocity[i], damped = std::fmin(1, std::fabs(V) / fully_damped);
    rate.slip[cell] = V * in_cells_.gradient[i] + damped * spread_[cell];  // Eq. (8.8): U_t = tanh(phi) |grad U|
  }
}

/// The gradients along the other direction at faces: means of both cells.
void GridEquations::find_transverse(bool along_y) {
  const std::vector<double>& slope = slope_[along_y ? 0 : 1];
  const std::size_t step = cells_.step(along_y);
  for (const std::size_t face : in_faces_[along_y ? 1 : 0].at)
    transverse_[face] = (slope[face] + slope[face - step]) / 2;
  walls_.set_transverse(slope, along_y, transverse_);
}

/// The wave action at faces, and its jump there, which damps short waves.
void GridEquations::find_actions(const std::vector<double>& slip, const std::vector<double>& action, bool along_y) {
  const std::size_t step = cells_.step(along_y);
  for (const std::size_t face : in_faces_[along_y ? 1 : 0].at) {
    const Sides at = sides(&action[face], static_cast<std::ptrdiff_t>(step),
                           walls_.near(face, along_y) || walls_.near(face - step, along_y));
    const bool is_front = (slip[face] > 0) != (slip[face - step] > 0);
    at_faces_[face] = (at.below + at.above) / 2;
    jump_[face] = is_front || walls_.at_face(face, along_y) ? 0 : at.above - at.below;
  }
  walls_.set_actions(action, along_y, at_faces_);
}

void GridEquations::find_fluxes(double t, const Averages& now, bool along_y) {
  const std::size_t d = along_y ? 1 : 0;
  Trains& faces = in_faces_[d];
  find_transverse(along_y);
  find_actions(now.slip, now.action, along_y);
  for (std::size_t i = 0; i < faces.at.size(); ++i)
    faces.gradient[i] = std::hypot(gradient_[d][faces.at[i]], transverse_[faces.at[i]]);
  solve(t, faces, at_faces_);
  for (std::size_t i = 0; i < faces.at.size(); ++i) {
    const std::size_t face = faces.at[i];
    flux_[d][face] = g_of(faces.EK[i]) * gradient_[d][face] + jump_[face] / 2;
  }
}

void GridEquations::find_rates(double t, Averages& now, Averages& rate) {
  cells_.mirror(now.slip);
  cells_.mirror(now.action);
  find_gradients(now.slip);
  find_slopes();
  for (std::size_t i = 0; i < in_cells_.at.size(); ++i) in_cells_.gradient[i] = gradient_in(in_cells_.at[i]);
  solve(t, in_cells_, now.action);
  find_slip_rates(rate);
  find_meeting(now);
  for (auto& flux : flux_) std::fill(flux.begin(), flux.end(), 0.0);
  for (const bool along_y : {false, true}) find_fluxes(t, now, along_y);
  for (const std::size_t cell : in_cells_.at)  // Eq. (8.4): I_t = div(g grad U) + F - <f>, with I = g U_t
    rate.action[cell] = (flux_[0][cell + 1] - flux_[0][cell]) / cells_.hx +
                        (flux_[1][cell + cells_.stride()] - flux_[1][cell]) / cells_.hy;
}

}  // namespace slipfront::plane
