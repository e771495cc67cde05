// Steps in which friction at the faces is implicit, and all else explicit.

#include "averages/pulse/staggered/staggered.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/space/kernels.hpp"
#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::pulse {

void faces_from_cells(const Cells& cells, const Staggered& staggered, std::vector<double>& unknowns) {
  const std::size_t n = cells.size();
  unknowns.resize(staggered.size());
  const FaceValues faces(unknowns.data(), n + 1);
  const ConstValues values = cells.values();
  if (cells.face_momentum.empty())
    staggered.face_momenta(values.momenta(), &faces.momentum(0));
  else
    for (std::size_t f = 0; f <= n; ++f) faces.momentum(f) = cells.face_momentum[f];
  faces.left_edge() = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) faces.width(i) = values.width(i);
  faces.dissipated() = values.dissipated();
  faces.supplied() = values.supplied();
  faces.through_ends() = values.through_ends();
}

void cells_from_faces(const Staggered& staggered, const std::vector<double>& unknowns, Cells& cells) {
  const std::size_t n = cells.size();
  const ConstFaceValues faces(unknowns.data(), n + 1);
  const Values values = cells.values();
  cells.face_momentum.resize(n + 1);
  values.left_edge() = faces.left_edge();
  for (std::size_t i = 0; i < n; ++i) values.width(i) = faces.width(i);
  for (std::size_t f = 0; f <= n; ++f) cells.face_momentum[f] = faces.momentum(f);
  staggered.cell_momenta(cells.face_momentum.data(), values.momenta());
  values.dissipated() = faces.dissipated();
  values.supplied() = faces.supplied();
  values.through_ends() = faces.through_ends();
}

namespace {

using std::numbers::pi;

[[noreturn]] void give_up(double t, std::size_t cell) {
  throw NumericsError("t = " + digits(t) + ", cell " + std::to_string(cell) + ": compressed to zero width");
}

}  // namespace

Staggered::Staggered(Setup setup)
    : setup_(std::move(setup)),
      relaxation_rate_(setup_.friction.relaxation_rate()),
      blocks_(blocks_of(setup_.charge, setup_.left, setup_.right)) {
  const std::size_t n = setup_.charge.size();
  cells_.resize(n);
  for (auto* array : {&width_, &pressure_, &mass_, &balance_}) array->assign(n, 0);
  a_.assign(n, 1);
  for (auto* array : {&place_, &on_one_, &face_mass_, &sinh_phi_, &cosh_phi_, &U_, &face_phi_, &psi_, &loss_rate_,
                      &fastest_, &s_, &mean_, &per_momentum_, &free_, &free_on_one_, &pushes_})
    array->assign(n + 1, 0);
  face_a_.assign(n + 1, 1);
  for (std::size_t f = 0; f <= n; ++f) charge_.push_back((charge_left(f) + charge_right(f)) / 2);
}

void Staggered::face_momenta(const double* cell_momenta, double* momenta) const {
  for (std::size_t f = 0; f < faces(); ++f) {
    const double left = f > 0 ? cell_momenta[f - 1] : 0, right = f + 1 < faces() ? cell_momenta[f] : 0;
    momenta[f] = (left + right) / 2;
  }
  if (setup_.left == Edge::wall) momenta[0] = 0;
  if (setup_.right == Edge::wall) momenta[faces() - 1] = 0;
}

/// Finds means over the cells of the cubic through four faces, or of the line through two faces in the end cells of a
/// block.
void Staggered::cell_momenta(const double* face_momenta, double* momenta) const {
  std::fill_n(momenta, setup_.charge.size(), 0.0);
  const auto of_one = [&](std::size_t f) { return face_momenta[f] / charge_around(f); };
  for (const Block& block : blocks_)
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const double beside = of_one(i) + of_one(i + 1);
      const bool inside = i > block.begin && i + 1 < block.end;
      const double mean = inside ? (13 * beside - of_one(i - 1) - of_one(i + 2)) / 24 : beside / 2;
      momenta[i] = setup_.charge[i] * mean;
    }
}

double Staggered::beside(const std::vector<double>& values, std::size_t face) const {
  const bool left = charge_left(face) > 0, right = charge_right(face) > 0;
  if (left && right) return (values[face - 1] + values[face]) / 2;
  return left ? values[face - 1] : values[face];
}

void Staggered::find_cells(double t, const double* z) {
  const std::size_t n = setup_.charge.size();
  const ConstFaceValues values(z, faces());
  for (std::size_t f = 0; f <= n; ++f) on_one_[f] = values.momentum(f) / charge_around(f);
  place_[0] = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) {
    width_[i] = values.width(i);
    place_[i + 1] = place_[i] + width_[i];
    if (!(width_[i] > 0 || setup_.charge[i] == 0)) give_up(t, i);
    const double q = setup_.charge[i];
    if (q == 0) continue;
    const double a = a_[i] = setup_.contact ? setup_.contact((place_[i] + place_[i + 1]) / 2) : 1;
    cells_.spacing[i] = a * width_[i] / q;
    cells_.momentum[i] = (on_one_[i] + on_one_[i + 1]) / (2 * a);
  }
  cells_.solve(blocks_, {0, n}, t);
  masses_and_pressures({n, cells_.spacing.data(), cells_.phi.data(), cells_.psi.data(), cells_.EK.data(), a_.data(),
                        on_one_.data(), mass_.data(), pressure_.data()});
  if (!setup_.contact) return;
  for (std::size_t i = 0; i < n; ++i) {
    if (setup_.charge[i] == 0) continue;
    balance_[i] =  // dp = k dg
        4 / pi * a_[i] * modulation::mass_excess(cells_.psi[i]) +
        a_[i] * a_[i] * (pressure_[i] - modulation::pressure(cells_.psi[i])) * width_[i] / (2 * pi * setup_.charge[i]);
  }
}

/// Force of pressure and contact on the dislocations around a face. It is 0 at a continued end, where the train outside
/// pushes back.
double Staggered::force_on(std::size_t f) const {
  const bool left = charge_left(f) > 0, right = charge_right(f) > 0;
  if (edge_at(f) == Edge::continued) return 0;
  if (!setup_.contact) return (left ? pressure_[f - 1] : 0) - (right ? pressure_[f] : 0);
  const double edge = left && right ? 0 : setup_.contact(place_[f]);
  const double contact_rise = (right ? a_[f] : edge) - (left ? a_[f - 1] : edge);
  const double rise = (right ? balance_[f] : 0) - (left ? balance_[f - 1] : 0) + 4 / pi * contact_rise;
  const double run = ((left ? width_[f - 1] : 0) + (right ? width_[f] : 0)) / 2;
  return -2 * pi * rise / run * charge_around(f);
}

/// Boundary condition at the first or last face. Returns Edge::free for all other faces, which do not use it. A train
/// that has moved away from a wall ends in a free edge.
Edge Staggered::edge_at(std::size_t f) const {
  if (f > 0 && f + 1 < faces()) return Edge::free;
  const Edge end = f == 0 ? setup_.left : setup_.right;
  if (end != Edge::wall) return end;
  const double wall = f == 0 ? setup_.left_wall : setup_.right_wall, width = f == 0 ? width_.front() : width_.back();
  return edge_at_wall(place_[f], wall, width);
}

const std::vector<double>& Staggered::face_phi() {
  for (std::size_t f = 0; f < faces(); ++f) face_phi_[f] = std::asinh(sinh_phi_[f]);
  return face_phi_;
}

double Staggered::creep() const { return setup_.friction.steep_at_rest() ? creep_ : 0; }

/// Friction rate at a face: loss of momentum per unit of time and momentum.
double Staggered::loss_rate(std::size_t f, double phi) const {
  if (const auto C = setup_.friction.linear_coefficient())  // the values of E K are known already
    return setup_.friction.closure() == friction::Closure::consistent ? *C : *C * pi * pi / (4 * beside(cells_.EK, f));
  return (*relaxation_rate_)({std::hypot(phi, creep()), beside(cells_.psi, f)}, contact_at(f), {});
}

/// Finds the friction rates at all faces.
void Staggered::find_loss_rates() {
  const friction::Friction& friction = setup_.friction;
  if (friction.linear_coefficient()) {
    for (std::size_t f = 0; f < faces(); ++f) loss_rate_[f] = loss_rate(f, 0);
    return;
  }
  for (std::size_t f = 0; f < faces(); ++f) psi_[f] = beside(cells_.psi, f);
  find_trains(
      {faces(), sinh_phi_.data(), psi_.data(), face_a_.data(), fastest_.data(), s_.data(), per_momentum_.data()},
      creep());
  if (relaxation_rate_->tabulated()) {
    relaxation_rate_->rates(faces(), fastest_.data(), psi_.data(), loss_rate_.data());
    return;
  }
  friction.average().mean_strengths({faces(), fastest_.data(), s_.data()}, friction.closure(), mean_.data(), nullptr);
  for (std::size_t f = 0; f < faces(); ++f) {
    if (std::isnan(per_momentum_[f])) per_momentum_[f] = pi / (2 * fastest_[f] * elliptic::at_psi(psi_[f]).E);
    loss_rate_[f] = per_momentum_[f] * mean_[f];
  }
}

Staggered::Terminal Staggered::terminal(const double* rates) const {
  const ConstFaceValues of(rates, faces());
  std::size_t face = 0;
  double force = 0;
  for (std::size_t f = 0; f < faces(); ++f) {
    const double on_one = std::fabs(of.momentum(f)) / charge_around(f);
    if (!(on_one > force)) continue;
    force = on_one;
    face = f;
  }
  const double mass = beside(mass_, face) * contact_at(face);
  const auto momentum = [&](double phi) { return 8 * mass * std::sinh(phi); };
  const auto gains_speed = [&](double log_phi) {
    const double phi = std::exp(log_phi);
    return loss_rate(face, phi) * momentum(phi) < force;
  };
  const double phi = std::exp(bisected({.holding = -690, .failing = 3}, gains_speed, 40).holding);
  return force > 0 ? Terminal{momentum(phi), std::tanh(phi), loss_rate(face, phi)} : Terminal{0, 0, 0};
}

void Staggered::find_masses(double t, const double* z) {
  find_cells(t, z);
  for (std::size_t f = 0; f < faces(); ++f) {
    if (setup_.contact) face_a_[f] = contact_at(f);
    const bool free_edge = is_edge(f) && edge_at(f) == Edge::free;
    face_mass_[f] = 8 * face_a_[f] * (free_edge ? 1 : beside(mass_, f));
  }
}

/// Force of the load on all dislocations around a face.
double Staggered::push_on(std::size_t f, double t) const {
  return setup_.forcing ? modulation::force_per_dislocation(setup_.forcing(place_[f], t)) * charge_around(f) : 0;
}

/// Power that enters through a face at velocity U.
double Staggered::power_through(std::size_t f, double U) const {
  if (!is_edge(f) || edge_at(f) != Edge::continued) return 0;
  const std::size_t cell = f == 0 ? 0 : f - 1;
  const double work = a_[cell] * a_[cell] * pressure_[cell] * U;
  return f == 0 ? work : -work;
}

/// A wall balances the force of a train that presses against it.
double Staggered::held_by_wall(std::size_t f, double force) const {
  if (edge_at(f) != Edge::wall) return force;
  return f == 0 ? std::fmax(force, 0) : std::fmin(force, 0);
}

void Staggered::operator()(double t, const double* z, double* dz) {
  const ConstFaceValues values(z, faces());
  const FaceValues rates(dz, faces());
  find_masses(t, z);
  face_velocities(faces(), on_one_.data(), face_mass_.data(), sinh_phi_.data(), cosh_phi_.data(), U_.data());
  find_loss_rates();
  double before = 0, dissipation = 0, supply = 0, through_ends = 0;
  for (std::size_t f = 0; f < faces(); ++f) {
    const double U = U_[f], loss = loss_rate_[f] * values.momentum(f), push = push_on(f, t);
    const double force = setup_.contact ? force_on(f) / cosh_phi_[f] : force_on(f);
    rates.width_left_of(f) = U - before;
    rates.momentum(f) = held_by_wall(f, force + push - loss);
    through_ends += power_through(f, U);
    dissipation += U * loss;
    supply += U * push;
    before = U;
  }
  rates.dissipated() = dissipation;
  rates.supplied() = supply;
  rates.through_ends() = through_ends;
}

/// Finds sinh(phi) at the faces after friction has acted for a time on the momenta `free` >= 0 of single dislocations:
/// M(phi) (1 + time rate(phi)) = free, solved in logarithms, in which it is nearly a straight line for any power of the
/// velocity. sinh(phi) is 0 where the velocity is less than a double holds.
void Staggered::slow_down(const std::vector<double>& free, double time) {
  constexpr double slowest = -690, precision = 1e-13;
  constexpr int most_tries = 100;
  brackets_.clear();
  for (std::size_t f = 0; f < faces(); ++f) {
    FaceBracket b{{.low = slowest, .high = std::log(free[f] / face_mass_[f])}};
    b.done = !(b.high > b.low);
    b.x = b.done ? slowest : b.high;
    brackets_.push_back(b);
  }
  const auto take_excess = [&](const auto& take) {
    for (std::size_t f = 0; f < faces(); ++f) sinh_phi_[f] = std::exp(brackets_[f].x);
    find_loss_rates();
    for (std::size_t f = 0; f < faces(); ++f) {
      FaceBracket& b = brackets_[f];
      if (!b.done) take(b, std::log(face_mass_[f] / free[f]) + b.x + std::log1p(time * loss_rate_[f]));
    }
  };
  take_excess([](FaceBracket& b, double excess) {
    b.at_high = excess;
    b.done = excess <= precision;
    if (!b.done) b.x = b.low;
  });
  take_excess([](FaceBracket& b, double excess) {
    b.at_low = excess;
    b.done = excess >= 0;
    if (!b.done) b.aim();
  });
  const auto all_done = [&] {
    return std::all_of(brackets_.begin(), brackets_.end(), [](const FaceBracket& b) { return b.done; });
  };
  for (int i = 0; i < most_tries && !all_done(); ++i)
    take_excess([](FaceBracket& b, double excess) {
      b.done = std::fabs(excess) <= precision || b.high - b.low <= precision;
      if (b.done) return;
      b.take(excess);
      b.aim();
    });
  for (std::size_t f = 0; f < faces(); ++f) sinh_phi_[f] = brackets_[f].x > slowest ? std::exp(brackets_[f].x) : 0;
}

void Staggered::split_step(double t, double dt, const double* z, double* next) {
  const ConstFaceValues now(z, faces());
  const FaceValues then(next, faces());
  find_masses(t, z);
  then.dissipated() = now.dissipated();
  then.supplied() = now.supplied();
  then.through_ends() = now.through_ends();
  std::vector<double>&free = free_, &of_one = free_on_one_, &pushes = pushes_;
  for (std::size_t f = 0; f < faces(); ++f) {
    pushes[f] = push_on(f, t);
    const double cosh_phi = std::sqrt(1 + std::pow(on_one_[f] / face_mass_[f], 2));
    const double force = setup_.contact ? force_on(f) / cosh_phi : force_on(f);
    free[f] = now.momentum(f) + dt * held_by_wall(f, force + pushes[f]);
    of_one[f] = std::fabs(free[f]) / charge_around(f);
  }
  slow_down(of_one, dt);
  double before = 0;
  for (std::size_t f = 0; f < faces(); ++f) {
    const double U = std::copysign(sinh_phi_[f] / std::sqrt(1 + sinh_phi_[f] * sinh_phi_[f]), free[f]);
    then.momentum(f) = std::copysign(charge_around(f) * face_mass_[f] * sinh_phi_[f], free[f]);
    then.width_left_of(f) = now.width_left_of(f) + dt * (U - before);
    then.dissipated() += U * (free[f] - then.momentum(f));
    then.supplied() += dt * U * pushes[f];
    then.through_ends() += dt * power_through(f, U);
    before = U;
  }
}

}  // namespace slipfront::pulse
