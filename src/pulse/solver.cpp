#include "slipfront/pulse/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "../digits.hpp"
#include "kernels.hpp"
#include "layout.hpp"
#include "semidiscrete.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/rupture/inverse.hpp"
#include "slipfront/train/train.hpp"
#include "staggered.hpp"
#include "time_step.hpp"

namespace slipfront::pulse {
namespace {

using std::numbers::pi;

/// Friction times in which a wave crosses a cell of average width, above which steps are implicit: there the pulse
/// diffuses.
constexpr double stiff_above = 1;
/// Explicit steps are stable up to 4 or so.
constexpr double longest_in_friction_times = 2;
/// And below which they are explicit again.
constexpr double stiff_below = 0.3;

void check(const Problem& p) {
  const auto refuse = [](const char* key, double value, const char* allowed) {
    throw InputError({.key = key, .value = digits(value), .problem = "out of range", .allowed = allowed});
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
                        .problem = "jumps from " + digits(from) + " to " + digits(to) + " at x = " + digits(a),
                        .allowed = "a continuous profile, such as tanh of a width of some cells"});
  }
}

/// Dry friction cannot reverse a cell: one that would have is at rest, and moves on only if pushed hard enough. So is
/// one that `friction` (that of a dislocation) holds, as it has turned it back in a stage of the step and nothing else
/// acts as strongly: what the step would have made of its momentum is no error then, nor what its friction does in the
/// means over the cells beside it.
void stop_reversals(const ExplicitStep& step, double friction, const std::vector<double>& charge,
                    const std::vector<double>& before, std::vector<double>& after, std::vector<double>& scale) {
  for (std::size_t cell = 0; cell < charge.size(); ++cell) {
    const std::size_t i = 2 * cell + 1;
    const bool reversed = before[i] * after[i] < 0;
    const bool held =
        (reversed || step.returns_to_zero(i, before[i])) && step.largest_rate(i) <= 2 * friction * charge[cell];
    if (!reversed && !held) continue;
    after[i] = 0;
    if (!held) continue;
    for (std::size_t j = cell > 1 ? cell - 2 : 0; j <= std::min(cell + 2, charge.size() - 1); ++j)
      scale[2 * j + 1] = HUGE_VAL;
  }
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

/// The step to take where `dt` is wanted: steps end on the target exactly, and the last two share what remains, so that
/// none is a sliver.
double next_step(double remaining, double dt) {
  return dt >= remaining ? remaining : dt > remaining / 2 ? remaining / 2 : dt;
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
      throw InputError(
          {.key = problem_.contact ? "interface.contact" : "initial",
           .problem = "stress over contact ratio is " + digits(local) + " at x = " + digits(layout.faces[i]),
           .allowed = "at least 0.0045 where there is stress: dislocations farther apart have no psi"});
    cells_.s[i] = std::tanh(rupture::psi_of_stress(local));
  }
  cells_.y[2 * n] = layout.faces.front();
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
  s.friction = problem_.friction;
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
              cells.y.size() == 2 * n + Semidiscrete::extra && cells.charge[0] > 0 && cells.charge[n - 1] > 0;
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
                      .allowed = "cells as laid for it, " + std::to_string(faces.size() - 1) + " at first"});
  cells_ = std::move(cells);
  lay_equations();
}

/// Time until the edges of a gap meet, or a train that has left a wall is back at it.
double Solver::gaps_close_in(const std::vector<double>& rate) const {
  double least = HUGE_VAL;
  const std::size_t last = 2 * size();
  if (problem_.left_end == End::fixed && rate[last] < 0)
    least = std::fmax((problem_.left - cells_.y[last]) / rate[last], 0.0);
  if (problem_.right_end == End::fixed) {
    double speed = rate[last];
    for (std::size_t i = 0; i < size(); ++i) speed += rate[2 * i];
    if (speed > 0) least = std::fmin(least, std::fmax((problem_.right - left_face(size())) / speed, 0.0));
  }
  if (least == 0) least = HUGE_VAL;  // at the wall
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
  if (!closed) return;
  cells_.face_momentum.clear();
  lay_equations();
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
  std::vector<double> rate, next, scale;
  std::unique_ptr<ImplicitStep> implicit_step;  // made when friction first rules

  explicit Work(Semidiscrete& equations, std::size_t cells, std::size_t size)
      : f([&equations](double t, const double* y, double* dy) { equations(t, y, dy); }),
        explicit_step(size),
        rate(size),
        next(size),
        scale(2 * cells) {}
};

double Solver::step_explicitly(Work& work, double remaining, double crossing) {
  if (!cells_.face_momentum.empty()) {
    cells_.face_momentum.clear();
    cells_.step = 0;
  }
  const double wanted = cells_.step > 0 ? std::fmin(crossing, cells_.step) : crossing;
  double dt = next_step(remaining, wanted);
  const bool dry = problem_.friction.law == modulation::FrictionLaw::coulomb;
  const double friction = 2 * pi * problem_.friction.coefficient;
  work.next = cells_.y;
  // What comes up within a step may be too hard for it: shorter, then.
  for (int tries = 0;; ++tries) {
    double factor = 0.5;
    try {
      find_scale(crossing, work.scale);
      work.explicit_step(work.f, cells_.time, dt, cells_.y, work.rate);
      if (dry) stop_reversals(work.explicit_step, friction, cells_.charge, work.next, cells_.y, work.scale);
      const double error =
          std::fmax(work.explicit_step.error(dt, work.rate, work.scale, equations_->shocked()), unseen_push(dt)) /
          problem_.explicit_tolerance;
      const bool jumped = thrown(work.next, cells_.y, cells_.charge);
      factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
      if (error <= 1 && !jumped) {
        cells_.step = dt * factor;
        break;
      }
      if (jumped) factor = std::fmin(factor, 0.5);
      if (tries == 80)
        throw NumericsError("t = " + digits(cells_.time) +
                            ": the time step failed: the forces on a cell exceed what any step can resolve");
    } catch (const NumericsError&) {
      if (tries == 80) throw;
    }
    cells_.y = work.next;
    equations_->start_from(cells_.s);
    dt *= factor;
  }
  cells_.s = equations_->s();
  return dt;
}

/// A forcing that jumps after the last stage of a step is seen by none of them. Returns the momentum that the step has
/// missed, in units of the largest that the forcing gives or there is; of a few cells.
double Solver::unseen_push(double dt) const {
  if (!problem_.forcing) return 0;
  constexpr double last = ExplicitStep::last_stage;
  const std::size_t stride = std::max<std::size_t>(size() / 64, 1);
  const double before = cells_.time + (2 * last - 1) * dt, stage = cells_.time + last * dt, end = cells_.time + dt;
  double missed = 0, largest = 0;
  for (std::size_t i = 0; i < size(); i += stride) {
    if (cells_.charge[i] == 0) continue;
    const double x = left_face(i) + cells_.y[2 * i] / 2;
    const double at_stage = problem_.forcing(x, stage), at_end = problem_.forcing(x, end);
    const double expected = 2 * at_stage - problem_.forcing(x, before);
    missed = std::fmax(missed, 2 * pi * (1 - last) * dt * std::fabs(at_end - expected));
    const double pushed = 2 * pi * dt * std::fmax(std::fabs(at_stage), std::fabs(at_end));
    largest = std::fmax(largest, std::fmax(pushed, std::fabs(cells_.y[2 * i + 1] / cells_.charge[i])));
  }
  return largest > 0 ? missed / largest : 0;
}

/// How far the dislocations have come on average in a unit of time, at most; of some of them.
double Solver::mean_speed() const {
  if (cells_.time == 0) return 0;
  const std::size_t stride = std::max<std::size_t>(size() / 64, 1);
  double x = cells_.y[2 * size()], charge = -cells_.entered_left, way = 0;
  for (std::size_t f = 0; f < size(); ++f) {
    if (f % stride == 0) way = std::fmax(way, std::fabs(x - first_place(charge)));
    x += cells_.y[2 * f];
    charge += cells_.charge[f];
  }
  return way / cells_.time;
}

/// Momenta are measured by the largest, or at rest by what the pressure soon makes of the densest cell: a sparse cell
/// is pushed by its neighbours. What is slower by a thousandth than the mean so far, as after a push that has ended,
/// adds nothing to slip; and the forces of a contact profile are differences of numbers of size 1.
void Solver::find_scale(double crossing, std::vector<double>& scale) const {
  double fastest = 8e-3 * *std::max_element(equations_->s().begin(), equations_->s().end()) /
                   (1 + equations_->largest_friction_rate() * crossing);
  constexpr double slow = 8e-3, rounding = 1e-8;
  if (!cells_.face_momentum.empty()) fastest = std::fmax(fastest, slow * mean_speed());
  if (problem_.contact) fastest = std::fmax(fastest, rounding / (1 + equations_->largest_friction_rate()));
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] > 0) fastest = std::fmax(fastest, std::fabs(cells_.y[2 * i + 1] / cells_.charge[i]));
  for (std::size_t i = 0; i < size(); ++i) {
    scale[2 * i] = cells_.y[2 * i];
    scale[2 * i + 1] = cells_.charge[i] > 0 ? cells_.charge[i] * fastest : 1;
  }
}

std::vector<double> Solver::faces_of_cells(const Staggered& staggered) const {
  const std::size_t n = size();
  std::vector<double> faces(staggered.size()), momenta = cells_.face_momentum;
  if (momenta.empty()) {
    std::vector<double> in_cells(n);
    for (std::size_t i = 0; i < n; ++i) in_cells[i] = cells_.y[2 * i + 1];
    momenta = staggered.face_momenta(in_cells);
  }
  for (std::size_t f = 0; f <= n; ++f) {
    faces[2 * f] = f == 0 ? cells_.y[2 * n] : cells_.y[2 * f - 2];
    faces[2 * f + 1] = momenta[f];
  }
  for (std::size_t i = 0; i < Staggered::sums; ++i) faces[2 * n + 2 + i] = cells_.y[2 * n + 1 + i];
  return faces;
}

void Solver::cells_of_faces(const Staggered& staggered, const std::vector<double>& faces) {
  const std::size_t n = size();
  cells_.face_momentum.resize(n + 1);
  for (std::size_t f = 0; f <= n; ++f) {
    (f == 0 ? cells_.y[2 * n] : cells_.y[2 * f - 2]) = faces[2 * f];
    cells_.face_momentum[f] = faces[2 * f + 1];
  }
  const std::vector<double> momenta = staggered.cell_momenta(cells_.face_momentum);
  for (std::size_t i = 0; i < n; ++i) cells_.y[2 * i + 1] = momenta[i];
  for (std::size_t i = 0; i < Staggered::sums; ++i) cells_.y[2 * n + 1 + i] = faces[2 * n + 2 + i];
}

double Solver::step_implicitly(Work& work, double remaining, double crossing) {
  Staggered& staggered = this->staggered();
  if (!work.implicit_step)
    work.implicit_step =
        std::make_unique<ImplicitStep>(staggered.faces(), staggered.size(), Staggered::reach, bool(problem_.forcing));
  if (cells_.face_momentum.empty()) cells_.step = 0;
  const Rates f = [&staggered](double t, const double* z, double* dz) { staggered(t, z, dz); };
  const std::vector<double> z = faces_of_cells(staggered);
  std::vector<double> rate(z.size()), next(z.size()), scale(2 * staggered.faces());
  find_scale(crossing, work.scale);
  double fastest = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (cells_.charge[i] > 0) fastest = std::fmax(fastest, work.scale[2 * i + 1] / cells_.charge[i]);
  for (std::size_t face = 0; face < staggered.faces(); ++face) {
    scale[2 * face] = work.scale[face == 0 ? 0 : 2 * face - 2];
    scale[2 * face + 1] = staggered.charge_around(face) * fastest;
  }
  staggered.start_from(cells_.s);
  f(cells_.time, z.data(), rate.data());
  work.implicit_step->linearise(f, cells_.time, z, rate, scale);
  double dt = cells_.step > 0 ? cells_.step : std::fmin(crossing, 1 / equations_->largest_friction_rate());
  while (true) {
    const double wanted = dt;
    dt = next_step(remaining, dt);
    double error = HUGE_VAL;
    try {
      error = (*work.implicit_step)(f, cells_.time, dt, z, rate, scale, equations_->largest_friction_rate(),
                                    problem_.tolerance, next);
    } catch (const NumericsError&) {  // a stage left the range of states: as good as a large error
    }
    const double factor = std::clamp(0.9 * std::pow(error, -0.25), 0.2, 4.0);
    if (error <= 1) {
      cells_.step = dt < wanted ? std::fmax(wanted, dt * factor) : dt * factor;
      cells_of_faces(staggered, next);
      cells_.s = staggered.s();
      return dt;
    }
    dt *= factor;
    if (!(cells_.time + dt > cells_.time))
      throw NumericsError("t = " + digits(cells_.time) + ": the time step fell below rounding");
    staggered.start_from(cells_.s);
  }
}

/// From the rates at the present time.
void Solver::look_for_crossing() {
  const std::size_t cell = equations_->crossing(cells_.time, cells_.y.data());
  if (cell >= size()) return;
  cells_.crossing_time = cells_.time;
  cells_.crossing_position = left_face(cell) + cells_.y[2 * cell] / 2;
}

/// Returns false if interrupted.
bool Solver::advance_until_gap_closes(double time, const std::function<bool()>& interrupted) {
  Semidiscrete& equations = *equations_;
  const std::size_t n = size();
  Work work(equations, n, cells_.y.size());
  while (cells_.time < time && &equations == equations_.get()) {  // until the cells are others
    equations.start_from(cells_.s);  // as a resumed run does, whoever has looked at the equations since the last step
    work.f(cells_.time, cells_.y.data(), work.rate.data());
    if (std::isnan(cells_.crossing_time)) look_for_crossing();
    const double remaining = std::fmin(std::fmin(time - cells_.time, problem_.longest_step), gaps_close_in(work.rate));
    double crossing = problem_.cfl * equations.crossing_time(cells_.y.data(), work.rate.data());
    const double friction_times = equations.largest_friction_rate() * equations.mean_crossing_time(cells_.y.data());
    const bool stiff =
        !problem_.periodic && friction_times > (cells_.face_momentum.empty() ? stiff_above : stiff_below);
    if (!stiff) crossing = std::fmin(crossing, longest_in_friction_times / equations.largest_friction_rate());
    const double dt = stiff ? step_implicitly(work, remaining, crossing) : step_explicitly(work, remaining, crossing);
    cells_.time = dt == time - cells_.time ? time : cells_.time + dt;
    ++cells_.steps;
    close_gaps();
    adjust_ends();
    if (interrupted && interrupted()) return false;
  }
  return true;
}

namespace {

/// State at a face from the reconstructed phi and psi, between the states of two cells, or of one and the train that
/// goes on alike at an end. psi is half the difference of two invariants: where phi changes from cell to cell by as
/// much as psi is, that is the pressure of the collision, or rounding, and the train at the face is taken from the
/// cells.
State state_between(const State& left, const State& right, double phi, double psi) {
  constexpr double top = 0.02;  // of a smooth extremum, beyond both cells
  const double least = std::fmin(left.psi, right.psi), most = std::fmax(left.psi, right.psi);
  const bool between = psi >= (1 - top) * least && psi <= (1 + top) * most;
  return {phi, between ? psi : std::sqrt(left.psi) * std::sqrt(right.psi)};
}

}  // namespace

Solver::View Solver::view(bool densities) const {
  const std::size_t n = size();
  std::vector<double> rate(cells_.y.size());
  equations_->start_from(cells_.s);
  (*equations_)(cells_.time, cells_.y.data(), rate.data());
  View v;
  v.faces.resize(n + 1);
  v.charge_faces.resize(n + 1);
  v.faces[0] = cells_.y[2 * n];
  v.charge_faces[0] = -cells_.entered_left;
  if (problem_.periodic) v.period = problem_.right - problem_.left;
  for (std::size_t i = 0; i < n; ++i) {
    v.faces[i + 1] = v.faces[i] + cells_.y[2 * i];
    v.charge_faces[i + 1] = v.charge_faces[i] + cells_.charge[i];
  }
  v.states = equations_->states();
  v.contact = problem_.contact;
  v.shocked = equations_->shocked();
  v.left_free = equations_->stretches().front().left == Edge::free;
  v.right_free = equations_->stretches().back().right == Edge::free;
  const std::vector<double>* face_phi = &equations_->face_phi();
  if (!cells_.face_momentum.empty()) {  // where friction rules, velocities are those of the faces
    staggered().start_from(cells_.s);
    std::vector<double> face_rate(staggered().size());
    staggered()(cells_.time, faces_of_cells(staggered()).data(), face_rate.data());
    face_phi = &staggered().face_phi();
  }
  for (std::size_t f = 0; f <= n; ++f) {
    const double phi = (*face_phi)[f], psi = equations_->face_psi()[f];
    const bool edge = f == 0 ? v.left_free : f == n ? v.right_free : cells_.charge[f - 1] == 0 || cells_.charge[f] == 0;
    const State &left = v.states[f == 0 ? 0 : f - 1], &right = v.states[f == n ? n - 1 : f];
    v.face_states.push_back(edge ? State{phi, psi} : state_between(left, right, phi, psi));
  }
  for (std::size_t f = 0; f <= n && densities; ++f)
    v.face_density.push_back(averages_of(v, v.face_states[f], v.faces[f]).k / (2 * pi));
  v.centres.resize(n);
  middles(equations_->stretches(), v.faces, v.centres);
  return v;
}

double Solver::energy_in(std::size_t cell) const {
  const double x = left_face(cell) + cells_.y[2 * cell] / 2;
  const double q = cells_.charge[cell], width = cells_.y[2 * cell], a = problem_.contact ? problem_.contact(x) : 1;
  const State state =
      modulation::state_of({a * width / q, cells_.y[2 * cell + 1] / (a * q)}, std::atanh(cells_.s[cell]));
  return train::averages(state, a).H * width;
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

}  // namespace slipfront::pulse
