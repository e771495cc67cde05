#include "slipfront/pulse/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "kernels.hpp"
#include "layout.hpp"
#include "semidiscrete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/rupture/inverse.hpp"
#include "slipfront/train/train.hpp"
#include "time_step.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Friction times in which a wave crosses a cell of average width, above which steps are implicit: there the pulse
/// diffuses.
constexpr double stiff_above = 1;

void check(const Problem& p) {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw InputError({.key = key, .value = std::to_string(value), .problem = "out of range", .allowed = allowed});
  };
  if (!(p.left < p.right) || !std::isfinite(p.right - p.left)) refuse("domain.left", p.left, "left < right, finite");
  if (p.cells < 4) refuse("pulse.cells", p.cells, ">= 4");
  if (!(p.tolerance > 0 && p.tolerance < 1)) refuse("pulse.tolerance", p.tolerance, "0 < tolerance < 1");
  if (!(p.friction.coefficient >= 0)) refuse("friction.coefficient", p.friction.coefficient, ">= 0");
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
                        .problem = "jumps from " + std::to_string(from) + " to " + std::to_string(to) +
                                   " at x = " + std::to_string(a),
                        .allowed = "a continuous profile, such as tanh of a width of some cells"});
  }
}

/// Dry friction cannot reverse a cell: one that would have is at rest, and moves on only if pushed hard enough.
void stop_reversals(const std::vector<double>& before, std::vector<double>& after) {
  for (std::size_t i = 1; i + Semidiscrete::extra < after.size(); i += 2)
    if (before[i] * after[i] < 0) after[i] = 0;
}

/// Whether a step has changed the rapidity of some cell by about a half or more: a dense train that runs into a sparse
/// one, or a contact as steep as a wall.
bool thrown(const std::vector<double>& before, const std::vector<double>& after, const std::vector<double>& charge) {
  for (std::size_t i = 0; i < charge.size(); ++i) {
    const double was = before[2 * i + 1], is = after[2 * i + 1];
    if (std::fabs(is - was) > 4 * charge[i] + std::fabs(was) / 2) return true;
  }
  return false;
}

/// The step to take where `left` is left and `dt` is wanted: steps end on the target exactly, and the last two share
/// what is left, so that none is a sliver.
double share_of(double left, double dt) { return dt >= left ? left : dt > left / 2 ? left / 2 : dt; }

}  // namespace

Solver::Solver(Problem problem) : problem_(std::move(problem)) {
  check(problem_);
  if (problem_.contact) refuse_jumps(problem_.contact, problem_.left, problem_.right);
  const Layout layout = lay_cells(problem_.stress, problem_.left, problem_.right, problem_.cells, problem_.corner);
  cells_.charge = layout.charge;
  left_free_ = layout.left_free;
  right_free_ = layout.right_free;
  const std::size_t n = size();
  cells_.y.assign(2 * n + Semidiscrete::extra, 0.0);
  cells_.s.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    cells_.y[2 * i] = layout.faces[i + 1] - layout.faces[i];
    if (cells_.charge[i] == 0) continue;
    const double a = problem_.contact ? problem_.contact((layout.faces[i] + layout.faces[i + 1]) / 2) : 1;
    const double local = 2 * pi * cells_.charge[i] / (a * cells_.y[2 * i]);
    if (!(local >= train::smallest_stress))
      throw InputError({.key = problem_.contact ? "interface.contact" : "initial",
                        .problem = "stress over contact ratio is " + std::to_string(local) +
                                   " at x = " + std::to_string(layout.faces[i]),
                        .allowed = "at least 0.0045 where there is stress: dislocations farther apart have no psi"});
    cells_.s[i] = std::tanh(rupture::psi_of_stress(local));
  }
  cells_.y[2 * n] = layout.faces.front();
  lay_equations();
  first_ = view();
}

Solver::Solver(Problem problem, Cells cells) : Solver(std::move(problem)) { restore(std::move(cells)); }

void Solver::lay_equations() {
  equations_ = std::make_shared<Semidiscrete>(Semidiscrete::Setup{
      cells_.charge, left_free_, right_free_, problem_.friction, problem_.forcing, problem_.contact});
}

void Solver::restore(Cells cells) {
  const std::size_t n = cells.charge.size();
  // Cells may have been joined and gaps may have gone since t = 0; what faces are left have the dislocations left of
  // them that they had.
  const std::vector<double>& faces = first_.charge_faces;
  const double all = faces.back();
  double left = 0;
  bool fits = n > 0 && cells.s.size() == n && cells.y.size() == 2 * n + Semidiscrete::extra && cells.charge[0] > 0 &&
              cells.charge[n - 1] > 0;
  for (std::size_t i = 0; i < n && fits; ++i) {
    left += cells.charge[i];
    const auto near = std::lower_bound(faces.begin(), faces.end(), left - 1e-9 * all);
    fits = cells.charge[i] >= 0 && near != faces.end() && *near <= left + 1e-9 * all;
  }
  fits = fits && std::fabs(left - all) <= 1e-9 * all;
  if (!fits)
    throw InputError({.key = "resume",
                      .value = std::to_string(n) + " cells",
                      .problem = "does not fit the scenario",
                      .allowed = "cells as laid for it, " + std::to_string(faces.size() - 1) + " at first"});
  cells_ = std::move(cells);
  lay_equations();
}

double Solver::gaps_close_in(const std::vector<double>& rate) const {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] == 0 && rate[2 * i] < 0) least = std::fmin(least, -cells_.y[2 * i] / rate[2 * i]);
  return least;
}

/// Where the edges of a gap have met, to a millionth of the cells beside it, these become neighbours. Cells are small
/// at free edges; in the dense state that grows where two have met they would only shorten the steps, and are joined.
void Solver::close_gaps() {
  std::vector<double>& y = cells_.y;
  bool closed = false;
  for (std::size_t i = size(); i-- > 0;) {
    if (cells_.charge[i] != 0 || y[2 * i] > 1e-6 * std::fmin(y[2 * i - 2], y[2 * i + 2])) continue;
    y[2 * i - 2] += y[2 * i] / 2;
    y[2 * i + 2] += y[2 * i] / 2;
    y[2 * i] = 0;
    drop_cell(i);
    std::vector<double> sorted = cells_.charge;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double enough = 0.4 * *middle;
    const auto small = [&](std::size_t j) { return cells_.charge[j] > 0 && cells_.charge[j] < enough; };
    for (std::size_t j = i; j < size() && small(j); ++j)
      while (small(j) && j + 1 < size() && cells_.charge[j + 1] > 0) join(j + 1, j);
    for (std::size_t j = i - 1; small(j) && j > 0; --j)
      for (; small(j) && j > 0 && cells_.charge[j - 1] > 0; --j) join(j - 1, j);
    closed = true;
  }
  if (closed) lay_equations();
}

/// Puts what is in a cell into a neighbour of it.
void Solver::join(std::size_t cell, std::size_t into) {
  if (cells_.charge[cell] > cells_.charge[into]) cells_.s[into] = cells_.s[cell];
  cells_.charge[into] += cells_.charge[cell];
  cells_.y[2 * into] += cells_.y[2 * cell];
  cells_.y[2 * into + 1] += cells_.y[2 * cell + 1];
  drop_cell(cell);
}

void Solver::drop_cell(std::size_t i) {
  const auto at = static_cast<std::ptrdiff_t>(i);
  cells_.y.erase(cells_.y.begin() + 2 * at, cells_.y.begin() + 2 * at + 2);
  cells_.s.erase(cells_.s.begin() + at);
  cells_.charge.erase(cells_.charge.begin() + at);
}

bool Solver::advance_to(double time, const std::function<bool()>& interrupted) {
  while (cells_.time < time)
    if (!advance_until_gap_closes(time, interrupted)) break;
  return cells_.time >= time;
}

/// What steps work with, as long as the cells stay the same.
struct Solver::Work {
  Rates f;
  ExplicitStep explicit_step;
  std::unique_ptr<ImplicitStep> implicit_step;  ///< made when first needed
  std::vector<double> rate, next, scale;

  explicit Work(Semidiscrete& equations, std::size_t cells, std::size_t size)
      : f([&equations](double t, const double* y, double* dy) { equations(t, y, dy); }),
        explicit_step(size),
        rate(size),
        next(size),
        scale(2 * cells) {}
};

double Solver::step_explicitly(Work& work, double left, double crossing) {
  double dt = share_of(left, crossing);
  work.next = cells_.y;
  // What comes up within a step may be too hard for it: shorter, then.
  for (int halvings = 0;; ++halvings) {
    try {
      work.explicit_step(work.f, cells_.time, dt, cells_.y, work.rate);
      if (!thrown(work.next, cells_.y, cells_.charge)) break;
      if (halvings == 40)
        throw NumericsError("t = " + std::to_string(cells_.time) +
                            ": what acts on a cell throws it, however short the step");
    } catch (const NumericsError&) {
      if (halvings == 40) throw;
    }
    cells_.y = work.next;
    equations_->start_from(cells_.s);
    dt /= 2;
  }
  if (problem_.friction.law == modulation::FrictionLaw::coulomb) stop_reversals(work.next, cells_.y);
  return dt;
}

/// Momenta are measured by the largest, or at rest by what the pressure soon makes of the densest cell: a sparse cell
/// is pushed by its neighbours.
void Solver::find_scale(double crossing, std::vector<double>& scale) const {
  double fastest = 8e-3 * *std::max_element(equations_->s().begin(), equations_->s().end()) /
                   (1 + equations_->largest_friction_rate() * crossing);
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] > 0) fastest = std::fmax(fastest, std::fabs(cells_.y[2 * i + 1] / cells_.charge[i]));
  for (std::size_t i = 0; i < size(); ++i) {
    scale[2 * i] = cells_.y[2 * i];
    scale[2 * i + 1] = cells_.charge[i] > 0 ? cells_.charge[i] * fastest : 1;
  }
}

double Solver::step_implicitly(Work& work, double left, double crossing) {
  equations_->use_compact(true);
  work.f(cells_.time, cells_.y.data(), work.rate.data());
  if (!work.implicit_step)
    work.implicit_step =
        std::make_unique<ImplicitStep>(size(), cells_.y.size(), Semidiscrete::compact_reach, bool(problem_.forcing));
  find_scale(crossing, work.scale);
  work.implicit_step->linearise(work.f, cells_.time, cells_.y, work.rate, work.scale);
  double dt = cells_.step > 0 ? cells_.step : std::fmin(crossing, 1 / equations_->largest_friction_rate());
  while (true) {
    const double wanted = dt;
    dt = share_of(left, dt);
    double error = HUGE_VAL;
    try {
      error = (*work.implicit_step)(work.f, cells_.time, dt, cells_.y, work.rate, work.scale, problem_.tolerance,
                                    work.next);
    } catch (const NumericsError&) {  // a stage left the range of states: as good as a large error
    }
    const double factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
    if (error <= 1) {
      cells_.step = dt < wanted ? std::fmax(wanted, dt * factor) : dt * factor;
      cells_.y.swap(work.next);
      equations_->use_compact(false);
      return dt;
    }
    dt *= factor;
    if (!(cells_.time + dt > cells_.time))
      throw NumericsError("t = " + std::to_string(cells_.time) + ": the time step fell below rounding");
    equations_->start_from(cells_.s);
  }
}

/// Returns false if interrupted.
bool Solver::advance_until_gap_closes(double time, const std::function<bool()>& interrupted) {
  Semidiscrete& equations = *equations_;
  const std::size_t n = size();
  Work work(equations, n, cells_.y.size());
  while (cells_.time < time && size() == n) {
    equations.start_from(cells_.s);  // as a resumed run does, whoever has looked at the equations since the last step
    work.f(cells_.time, cells_.y.data(), work.rate.data());
    const double left = std::fmin(time - cells_.time, gaps_close_in(work.rate));
    const double crossing = problem_.cfl * equations.crossing_time(cells_.y.data(), work.rate.data());
    const bool stiff = equations.largest_friction_rate() * equations.mean_crossing_time(cells_.y.data()) > stiff_above;
    const double dt = stiff ? step_implicitly(work, left, crossing) : step_explicitly(work, left, crossing);
    cells_.time = dt == time - cells_.time ? time : cells_.time + dt;
    ++cells_.steps;
    cells_.s = equations.s();
    close_gaps();
    if (interrupted && interrupted()) return false;
  }
  return true;
}

Solver::View Solver::view() const {
  const std::size_t n = size();
  std::vector<double> rate(cells_.y.size());
  equations_->start_from(cells_.s);
  (*equations_)(cells_.time, cells_.y.data(), rate.data());
  View v;
  v.faces.resize(n + 1);
  v.charge_faces.resize(n + 1);
  v.faces[0] = cells_.y[2 * n];
  for (std::size_t i = 0; i < n; ++i) {
    v.faces[i + 1] = v.faces[i] + cells_.y[2 * i];
    v.charge_faces[i + 1] = v.charge_faces[i] + cells_.charge[i];
  }
  v.states = equations_->states();
  v.contact = problem_.contact;
  for (std::size_t f = 0; f <= n; ++f) v.face_states.push_back({equations_->face_phi()[f], equations_->face_psi()[f]});
  for (std::size_t f = 0; f <= n; ++f)
    v.face_density.push_back(averages_of(v, v.face_states[f], v.faces[f]).k / (2 * pi));
  v.centres.resize(n);
  middles(equations_->stretches(), v.faces, v.centres);
  return v;
}

State Solver::state_in(std::size_t cell) const {
  constexpr std::size_t reach = 2, stencil = 2 * reach + 1;
  const std::vector<double>& charge = cells_.charge;
  if (problem_.contact) return view().states[cell];
  if (charge[cell] == 0) return {};
  const double psi = std::atanh(cells_.s[cell]);
  const bool inside = cell >= reach && cell + reach < size() &&
                      std::find(&charge[cell - reach], &charge[cell + reach] + 1, 0.0) == &charge[cell + reach] + 1;
  if (!inside)
    return modulation::state_of({cells_.y[2 * cell] / charge[cell], cells_.y[2 * cell + 1] / charge[cell]}, psi);
  double width[stencil], momentum[stencil], width_at[stencil], momentum_at[stencil], charge_at[stencil];
  split(stencil, cells_.y.data() + 2 * (cell - reach), width, momentum);
  centre_values(stencil, width, width_at);
  centre_values(stencil, momentum, momentum_at);
  centre_values(stencil, &charge[cell - reach], charge_at);
  return modulation::state_of({width_at[reach] / charge_at[reach], momentum_at[reach] / charge_at[reach]}, psi);
}

double Solver::initial_charge_left_of(double x) const { return charge_left_of(first_, x); }

}  // namespace slipfront::pulse
