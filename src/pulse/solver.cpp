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

/// Dry friction cannot reverse a cell: one that would have is at rest, and moves on only if pushed hard enough.
void stop_reversals(const std::vector<double>& before, std::vector<double>& after) {
  for (std::size_t i = 1; i + Semidiscrete::extra < after.size(); i += 2)
    if (before[i] * after[i] < 0) after[i] = 0;
}

/// The step to take where `left` is left and `dt` is wanted: steps end on the target exactly, and the last two share
/// what is left, so that none is a sliver.
double share_of(double left, double dt) { return dt >= left ? left : dt > left / 2 ? left / 2 : dt; }

}  // namespace

Solver::Solver(Problem problem) : problem_(std::move(problem)) {
  check(problem_);
  const Layout layout = lay_cells(problem_.stress, problem_.left, problem_.right, problem_.cells, problem_.corner);
  charge_ = layout.charge;
  const std::size_t n = size();
  cells_.y.assign(2 * n + Semidiscrete::extra, 0.0);
  cells_.s.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    cells_.y[2 * i] = layout.faces[i + 1] - layout.faces[i];
    cells_.s[i] = std::tanh(rupture::psi_of_stress(2 * pi * charge_[i] / cells_.y[2 * i]));
  }
  cells_.y[2 * n] = layout.faces.front();
  equations_ = std::make_shared<Semidiscrete>(
      Semidiscrete::Setup{charge_, layout.left_free, layout.right_free, problem_.friction, problem_.forcing});
  first_ = view();
}

Solver::Solver(Problem problem, Cells cells) : Solver(std::move(problem)) { restore(std::move(cells)); }

void Solver::restore(Cells cells) {
  if (cells.y.size() != cells_.y.size() || cells.s.size() != cells_.s.size())
    throw InputError({.key = "resume",
                      .value = std::to_string(cells.s.size()) + " cells",
                      .problem = "does not fit the scenario",
                      .allowed = std::to_string(cells_.s.size()) + " cells"});
  cells_ = std::move(cells);
}

bool Solver::advance_to(double time, const std::function<bool()>& interrupted) {
  Semidiscrete& equations = *equations_;
  const Rates f = [&equations](double t, const double* y, double* dy) { equations(t, y, dy); };
  const std::size_t n = size();
  ExplicitStep explicit_step(cells_.y.size());
  std::unique_ptr<ImplicitStep> implicit_step;
  std::vector<double> rate(cells_.y.size()), next(cells_.y.size()), scale(2 * n);
  while (cells_.time < time) {
    equations.start_from(cells_.s);  // as a resumed run does, whoever has looked at the equations since the last step
    f(cells_.time, cells_.y.data(), rate.data());
    const double left = time - cells_.time;
    const double crossing = problem_.cfl * equations.crossing_time(cells_.y.data(), rate.data());
    const bool stiff = equations.largest_friction_rate() * equations.mean_crossing_time(cells_.y.data()) > stiff_above;
    double dt = crossing;
    if (!stiff) {
      dt = share_of(left, dt);
      next = cells_.y;
      explicit_step(f, cells_.time, dt, cells_.y, rate);
      if (problem_.friction.law == modulation::FrictionLaw::coulomb) stop_reversals(next, cells_.y);
    } else {
      equations.use_compact(true);
      f(cells_.time, cells_.y.data(), rate.data());
      if (!implicit_step)
        implicit_step = std::make_unique<ImplicitStep>(2 * n, Semidiscrete::extra, Semidiscrete::compact_reach);
      double fastest = 0;
      for (std::size_t i = 0; i < n; ++i) fastest = std::fmax(fastest, std::fabs(cells_.y[2 * i + 1] / charge_[i]));
      for (std::size_t i = 0; i < n; ++i) {
        scale[2 * i] = cells_.y[2 * i];
        scale[2 * i + 1] = charge_[i] * std::fmax(fastest, 8e-3 * equations.s()[i] /
                                                               (1 + equations.largest_friction_rate() * crossing));
      }
      implicit_step->linearise(f, cells_.time, cells_.y, rate, scale);
      dt = cells_.step > 0 ? cells_.step : std::fmin(crossing, 1 / equations.largest_friction_rate());
      while (true) {
        const double wanted = dt;
        dt = share_of(left, dt);
        double error = HUGE_VAL;
        try {
          error = (*implicit_step)(f, cells_.time, dt, cells_.y, rate, scale, problem_.tolerance, next);
        } catch (const NumericsError&) {  // a stage left the range of states: as good as a large error
        }
        const double factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
        if (error <= 1) {
          cells_.step = dt < wanted ? std::fmax(wanted, dt * factor) : dt * factor;
          cells_.y.swap(next);
          break;
        }
        dt *= factor;
        if (!(cells_.time + dt > cells_.time))
          throw NumericsError("t = " + std::to_string(cells_.time) + ": the time step fell below rounding");
        equations.start_from(cells_.s);
      }
    }
    equations.use_compact(false);
    cells_.time = dt == left ? time : cells_.time + dt;
    ++cells_.steps;
    cells_.s = equations.s();
    if (interrupted && interrupted()) return cells_.time >= time;
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
    v.charge_faces[i + 1] = v.charge_faces[i] + charge_[i];
  }
  v.states = equations_->states();
  for (std::size_t f = 0; f <= n; ++f) v.face_states.push_back({equations_->face_phi()[f], equations_->face_psi()[f]});
  for (std::size_t i = 0; i < n; ++i) {
    const double middle = (v.faces[i] + v.faces[i + 1]) / 2;
    const bool inside = i > 0 && i + 1 < n;  // fourth order in the cells' own coordinate
    v.centres.push_back(inside ? (9 * (v.faces[i] + v.faces[i + 1]) - v.faces[i - 1] - v.faces[i + 2]) / 16 : middle);
  }
  return v;
}

State Solver::state_in(std::size_t cell) const {
  constexpr std::size_t reach = 2, stencil = 2 * reach + 1;
  const bool inside = cell >= reach && cell + reach < size();
  const double psi = std::atanh(cells_.s[cell]);
  if (!inside)
    return modulation::state_of({cells_.y[2 * cell] / charge_[cell], cells_.y[2 * cell + 1] / charge_[cell]}, psi);
  double width[stencil], momentum[stencil], width_at[stencil], momentum_at[stencil], charge_at[stencil];
  split(stencil, cells_.y.data() + 2 * (cell - reach), width, momentum);
  centre_values(stencil, width, width_at);
  centre_values(stencil, momentum, momentum_at);
  centre_values(stencil, charge_.data() + (cell - reach), charge_at);
  return modulation::state_of({width_at[reach] / charge_at[reach], momentum_at[reach] / charge_at[reach]}, psi);
}

double Solver::initial_charge_left_of(double x) const { return charge_left_of(first_, x); }

}  // namespace slipfront::pulse
