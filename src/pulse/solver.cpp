#include "slipfront/pulse/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "foundation/text/digits.hpp"
#include "pulse/grid/layout.hpp"
#include "pulse/grid/state_grid.hpp"
#include "pulse/space/kernels.hpp"
#include "pulse/space/semidiscrete.hpp"
#include "pulse/space/staggered.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

void check(const Problem& p) {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw InputError({.key = key, .value = digits(value), .problem = "out of range", .allowed = allowed});
  };
  if (!(p.left < p.right) || !std::isfinite(p.right - p.left)) refuse("domain.left", p.left, "left < right, finite");
  if (p.cells < 4) refuse("pulse.cells", p.cells, ">= 4");
  if (!(p.tolerance > 0 && p.tolerance < 1)) refuse("pulse.tolerance", p.tolerance, "0 < tolerance < 1");
  p.friction.check();
  if (!p.friction.defined_by(p.friction.closure()))
    throw InputError({.key = "friction.closure",
                      .value = "paper",
                      .problem = "is not defined for a law that remembers, such as " + std::string(p.friction.name()),
                      .allowed = "consistent"});
  if (p.friction.state_size() > 0 && p.periodic)
    throw InputError({.key = "pulse.periodic",
                      .value = "true",
                      .problem = "a ring of places that remember is not among what pulse can do",
                      .allowed = "false, or a run of the chain"});
  if (p.periodic && p.friction.acts() && p.friction.steep_at_rest() && !p.friction.sticks())
    throw InputError({.key = "pulse.periodic",
                      .value = "true",
                      .problem =
                          "friction whose slope is infinite at rest, as of exponents below 1, leaves no time step "
                          "short enough on a ring",
                      .allowed = "false, or a run of the chain"});
}

/// A contact that jumps would be a wall to some cells and nothing to others: there must be a slope to climb.
void refuse_jumps(const std::function<double(double)>& contact, double left, double right) {
  constexpr int samples = 4096;
  const double h = (right - left) / samples;
  for (int i = 0; i < samples; ++i) {
    double a = left + i * h, b = a + h, at_a = contact(a), at_b = contact(b);
    const double whole = std::fabs(at_b - at_a), from = at_a, to = at_b;
    if (whole < 1e-3 * at_a) continue;
    while (b - a > 1e-6 * h) {  // the half that changes more
      const double middle = (a + b) / 2, at_middle = contact(middle);
      const bool first = std::fabs(at_middle - at_a) > std::fabs(at_b - at_middle);
      (first ? b : a) = middle;
      (first ? at_b : at_a) = at_middle;
    }
    if (std::fabs(at_b - at_a) > whole / 2)
      throw InputError({.key = "interface.contact",
                        .problem = "jumps from " + digits(from) + " to " + digits(to) + " at x = " + digits(a),
                        .allowed = "a continuous profile, such as tanh of a width of some cells"});
  }
}

Edge edge_of(End end) { return end == End::fixed ? Edge::wall : end == End::free ? Edge::free : Edge::continued; }

}  // namespace

Solver::Solver(Problem problem) : problem_(std::move(problem)) {
  check(problem_);
  if (problem_.contact) refuse_jumps(problem_.contact, problem_.left, problem_.right);
  const Layout layout = lay_cells(
      problem_.stress, problem_.left, problem_.right, problem_.cells, problem_.corner,
      {!problem_.periodic && problem_.left_end == End::free, !problem_.periodic && problem_.right_end == End::free});
  if (problem_.periodic && (layout.left_free || layout.right_free))
    throw InputError({.key = "pulse.periodic",
                      .problem = "there is no stress at an end of the domain",
                      .allowed = "a ring that is stressed where its ends meet: move domain.left and domain.right"});
  cells_.charge = layout.charge;
  const auto differs = [&](double x) { return problem_.contact(x) != problem_.contact(layout.faces.front()); };
  contact_varies_ = problem_.contact && std::any_of(layout.faces.begin(), layout.faces.end(), differs);
  left_free_ = layout.left_free;
  right_free_ = layout.right_free;
  const std::size_t n = size();
  cells_.unknowns.assign(Values::size(n), 0.0);
  cells_.s.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    cells_.width(i) = layout.faces[i + 1] - layout.faces[i];
    if (cells_.charge[i] == 0) continue;
    const double a = problem_.contact ? problem_.contact((layout.faces[i] + layout.faces[i + 1]) / 2) : 1;
    const double local = 2 * pi * cells_.charge[i] / (a * cells_.width(i));
    if (!(local >= train::smallest_stress))
      throw InputError(
          {.key = problem_.contact ? "interface.contact" : "initial",
           .problem = "stress over contact ratio is " + digits(local) + " at x = " + digits(layout.faces[i]),
           .allowed = "at least 0.0045 where there is stress: dislocations farther apart have no psi"});
    cells_.s[i] = std::tanh(train::psi_of_stress(local));
  }
  cells_.left_edge() = layout.faces.front();
  if (problem_.friction.state_size() > 0) cells_.memory = places().values();
  lay_equations();
  first_ = view();
}

Solver::Solver(Problem problem, Cells cells) : Solver(std::move(problem)) { restore(std::move(cells)); }

template <class Setup>
Setup Solver::setup() const {
  Setup s;
  s.charge = cells_.charge;
  const auto edge = [&](End end, bool free) {  // a wall knows by itself whether the train is at it
    if (problem_.periodic) return Edge::ring;
    return free && end != End::fixed ? Edge::free : edge_of(end);
  };
  s.left = edge(problem_.left_end, left_free_);
  s.right = edge(problem_.right_end, right_free_);
  s.left_wall = problem_.left;
  s.right_wall = problem_.right;
  if (problem_.friction.state_size() == 0) s.friction = problem_.friction;  // else CellFriction has it
  if constexpr (requires { s.friction_apart; }) s.friction_apart = steps_by_parts();
  s.forcing = problem_.forcing;
  s.contact = problem_.contact;
  if (problem_.periodic) {
    const auto on_ring = [left = problem_.left, period = problem_.right - problem_.left](double x) {
      return x - std::floor((x - left) / period) * period;
    };
    if (s.forcing) s.forcing = [on_ring, f = s.forcing](double x, double t) { return f(on_ring(x), t); };
    if (s.contact) s.contact = [on_ring, f = s.contact](double x) { return f(on_ring(x)); };
  }
  return s;
}

void Solver::lay_equations() {
  equations_ = std::make_shared<Semidiscrete>(setup<Semidiscrete::Setup>());
  staggered_.reset();
}

Staggered& Solver::staggered() const {
  if (!staggered_) staggered_ = std::make_shared<Staggered>(setup<Staggered::Setup>());
  return *staggered_;
}

void Solver::restore(Cells cells) {
  const std::size_t n = cells.charge.size();
  // Cells may have been joined and gaps may have gone since t = 0; what faces are left have the dislocations left of
  // them that they had.
  const std::vector<double>& faces = first_.charge_faces;
  const double all = faces.back();
  double left = -cells.entered_left;
  bool fits = std::isfinite(left) && std::isfinite(cells.entered_right) && n > 0 && cells.s.size() == n &&
              (cells.face_momentum.empty() || cells.face_momentum.size() == n + 1) &&
              cells.unknowns.size() == Values::size(n) && cells.memory.size() == cells_.memory.size() &&
              cells.charge[0] > 0 && cells.charge[n - 1] > 0;
  for (std::size_t i = 0; i < n && fits; ++i) {
    left += cells.charge[i];
    const auto near = std::lower_bound(faces.begin(), faces.end(), left - 1e-9 * all);
    const bool beyond = left < -1e-9 * all || left > (1 + 1e-9) * all;  // came in through an end
    fits = cells.charge[i] >= 0 && (beyond || (near != faces.end() && *near <= left + 1e-9 * all));
  }
  fits = fits && std::fabs(left - all - cells.entered_right) <= 1e-9 * (all + std::fabs(cells.entered_right));
  if (!fits)
    throw InputError({.key = "resume",
                      .value = std::to_string(n) + " cells",
                      .problem = "does not fit the scenario",
                      .allowed = "cells of this scenario, " + std::to_string(faces.size() - 1) + " at first"});
  cells_ = std::move(cells);
  lay_equations();
}

/// Time until the edges of a gap meet, or a train that has left a wall is back at it.
double Solver::gaps_close_in(const std::vector<double>& rates) const {
  const ConstValues rate(rates.data(), size());
  double least = HUGE_VAL;
  if (problem_.left_end == End::fixed && rate.left_edge() < 0)
    least = std::fmax((problem_.left - cells_.left_edge()) / rate.left_edge(), 0.0);
  if (problem_.right_end == End::fixed) {
    double speed = rate.left_edge();
    for (std::size_t i = 0; i < size(); ++i) speed += rate.width(i);
    if (speed > 0) least = std::fmin(least, std::fmax((problem_.right - left_face(size())) / speed, 0.0));
  }
  if (least == 0) least = HUGE_VAL;  // at the wall
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] == 0 && rate.width(i) < 0) least = std::fmin(least, -cells_.width(i) / rate.width(i));
  return least;
}

/// Whether the edges of a gap have met, to a millionth of the cells next to it.
bool Solver::gap_has_closed(std::size_t i) const {
  return cells_.charge[i] == 0 && cells_.width(i) <= 1e-6 * std::fmin(cells_.width(i - 1), cells_.width(i + 1));
}

/// Cells next to a closed gap become neighbours. Cells are small at free edges; in the dense state that grows where two
/// edges have met they would only shorten the steps, and are joined.
void Solver::close_gap(std::size_t i) {
  cells_.width(i - 1) += cells_.width(i) / 2;
  cells_.width(i + 1) += cells_.width(i) / 2;
  cells_.width(i) = 0;
  drop_cell(i);
  std::vector<double> sorted = cells_.charge;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double enough = 0.4 * *middle;
  const auto small = [&](std::size_t j) { return cells_.charge[j] > 0 && cells_.charge[j] < enough; };
  for (std::size_t j = i; j < size() && small(j); ++j)
    while (small(j) && j + 1 < size() && cells_.charge[j + 1] > 0) join(j + 1, j);
  std::size_t j = i;
  while (j > 0 && small(j - 1)) {
    --j;
    while (small(j) && j > 0 && cells_.charge[j - 1] > 0) {
      join(j - 1, j);
      --j;  // the index of the joined cell
    }
  }
}

/// Closes gaps from right to left. The first and the last cell are never gaps: layout and saved runs begin and end with
/// stress, and no end drops a cell next to a gap.
void Solver::close_gaps() {
  bool closed = false;
  for (std::size_t i = size() - 1; i-- > 1;) {
    if (!gap_has_closed(i)) continue;
    close_gap(i);
    i = std::min(i, size() - 1);  // joining may have removed cells on both sides
    closed = true;
  }
  if (!closed) return;
  cells_.face_momentum.clear();
  lay_equations();
}

/// Puts what is in a cell into a neighbour of it.
void Solver::join(std::size_t cell, std::size_t into) {
  if (cells_.charge[cell] > cells_.charge[into]) cells_.s[into] = cells_.s[cell];
  cells_.charge[into] += cells_.charge[cell];
  cells_.width(into) += cells_.width(cell);
  cells_.momentum(into) += cells_.momentum(cell);
  drop_cell(cell);
}

void Solver::drop_cell(std::size_t i) {
  const auto at = static_cast<std::ptrdiff_t>(i);
  cells_.unknowns.erase(cells_.unknowns.begin() + static_cast<std::ptrdiff_t>(size() + i));
  cells_.unknowns.erase(cells_.unknowns.begin() + at);
  cells_.s.erase(cells_.s.begin() + at);
  cells_.charge.erase(cells_.charge.begin() + at);
}

double Solver::energy_in(std::size_t cell) const {
  const double x = left_face(cell) + cells_.width(cell) / 2;
  const double q = cells_.charge[cell], width = cells_.width(cell), a = problem_.contact ? problem_.contact(x) : 1;
  const State state =
      modulation::state_of({a * width / q, cells_.momentum(cell) / (a * q)}, std::atanh(cells_.s[cell]));
  return train::averages(state, a).H * width;
}

}  // namespace slipfront::pulse
