#include "plane/direct/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "foundation/team.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {
namespace {

constexpr std::size_t g = Sites::ghosts;
/// Each block of rows finds the accelerations of four more rows than it steps.
constexpr std::size_t fewest_rows_of_a_block = 32;
/// Steps in spacings. The scheme is stable to 1.06, and next to absorbing edges, where it is of second order, to 0.61.
constexpr double courant = 0.8, courant_with_absorbing_edges = 0.6;

/// A row of an array with ghosts, and its neighbours.
FiveRows rows_around(const std::vector<double>& array, const Sites& sites, std::size_t j) {
  const std::size_t n = sites.stride(), at = sites.at(0, j);
  return {&array[at - 2 * n], &array[at - n], &array[at], &array[at + n], &array[at + 2 * n]};
}

/// A row of an array; null if the array is empty.
const double* row_of(const std::vector<double>& array, const Sites& sites, std::size_t j) {
  return array.empty() ? nullptr : &array[sites.at(0, j)];
}

/// Sites next to absorbing edges have no acceleration in v_tt, because v does not contain their dashpots.
void drop_edges(const Sites& sites, std::size_t row, double* v) {
  if (row == 0 || row + 1 == sites.ny) std::fill_n(v, sites.nx, 0.0);
  v[0] = v[sites.nx - 1] = 0;
}

/// The row which a row outside of the domain mirrors, because its edge is free.
std::size_t mirrored(std::ptrdiff_t row, std::size_t rows) {
  const auto n = static_cast<std::ptrdiff_t>(rows);
  return static_cast<std::size_t>(row < 0 ? -row - 1 : row >= n ? 2 * n - row - 1 : row);
}

}  // namespace

Stepper::Stepper(const Problem& problem, const Sites& sites, int threads)
    : problem_(problem),
      sites_(sites),
      threads_(threads),
      shape_{.sites = sites.nx, .per_hx2 = 1 / (sites.hx * sites.hx), .per_hy2 = 1 / (sites.hy * sites.hy)},
      dt_((problem.edges == Edges::absorbing ? courant_with_absorbing_edges : courant) *
          std::sqrt(2 / (shape_.per_hx2 + shape_.per_hy2))),
      loads_(problem, sites),
      friction_(problem, sites, dt_),
      work_of_row_(sites.ny),
      supply_of_row_(sites.ny),
      v_(friction_.is_viscous() ? sites.size() : 0) {}

void Stepper::fill_ends(double* row) const {
  double* const last = row + sites_.nx;
  for (std::size_t i = 0; i < g; ++i) {
    row[-1 - static_cast<std::ptrdiff_t>(i)] = row[i];
    last[i] = last[-1 - static_cast<std::ptrdiff_t>(i)];
  }
}

void Stepper::fill_ghosts(std::vector<double>& f) const {
  for (std::size_t j = 0; j < sites_.ny; ++j) fill_ends(&f[sites_.at(0, j)]);
  const std::size_t n = sites_.stride(), top = sites_.ny + g;
  for (std::size_t i = 0; i < g; ++i) {
    std::copy_n(&f[(g + i) * n], n, &f[(g - 1 - i) * n]);
    std::copy_n(&f[(top - 1 - i) * n], n, &f[(top + i) * n]);
  }
}

/// Finds the acceleration of a row of u.
void Stepper::accelerate_row(const std::vector<double>& u, std::size_t row, const Acceleration& result) const {
  accelerate(shape_, rows_around(u, sites_, row), row_of(sites_.contact2, sites_, row), result);
  load(sites_.nx, row_of(sites_.moves, sites_, row), row_of(loads_.force(), sites_, row), result.v);
}

/// Calls each(row, acceleration) for all rows, on several threads.
template <class Each>
void Stepper::for_each_acceleration(const std::vector<double>& u, const Each& each) const {
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    std::vector<double> v(sites_.nx), sine(sites_.nx), cosine(sites_.nx);
    const Acceleration now{v.data(), sine.data(), cosine.data()};
    accelerate_row(u, j, now);
    each(j, now);
  });
}

/// u_xx + u_yy - a^2 sin u + F of all sites.
std::vector<double> Stepper::accelerations(const std::vector<double>& u) const {
  std::vector<double> v(sites_.size(), 0.0);
  for_each_acceleration(
      u, [&](std::size_t j, const Acceleration& now) { std::copy_n(now.v, sites_.nx, &v[sites_.at(0, j)]); });
  fill_ghosts(v);
  return v;
}

bool Stepper::acts_on_steps() const {
  return friction_.acts() || problem_.edges == Edges::absorbing || !loads_.force().empty();
}

/// Applies friction to the step of a row, and keeps its accelerations for the next step.
void Stepper::rub(const Motion& m, std::size_t row, const double* v, const double* v_tt, const double* before,
                  double* after) {
  const std::size_t first = sites_.at(0, row);
  if (friction_.is_viscous()) std::copy_n(v, sites_.nx, &v_[first]);
  const Rates rates{v, friction_.is_viscous() ? &m.v_old[first] : nullptr, v_tt};
  work_of_row_[row] = friction_.slow(row, problem_.nucleation_has_begun(time_of(m)), rates, before, after);
}

/// The accelerations of the five rows around one. Each row is found once, and replaces the one five rows before it.
class Stepper::Window {
 public:
  explicit Window(const Stepper& stepper)
      : stepper_(stepper),
        absorbing_(stepper.problem_.edges == Edges::absorbing),
        stride_(stepper.sites_.stride()),
        v_(5 * stride_),
        rated_(absorbing_ ? 5 * stride_ : 0),
        sine_(v_),
        cosine_(v_) {}

  /// Row j of v, with the sine and the cosine in it. Rows outside of the domain mirror those inside.
  Acceleration at(std::ptrdiff_t j) { return {&v_[start_of(j)], &sine_[start_of(j)], &cosine_[start_of(j)]}; }
  /// The rows around row j, of the accelerations whose rate a step takes into account.
  FiveRows rated_around(std::ptrdiff_t j) { return {rated(j - 2), rated(j - 1), rated(j), rated(j + 1), rated(j + 2)}; }
  void find(const std::vector<double>& u, std::ptrdiff_t j) {
    const Sites& sites = stepper_.sites_;
    const std::size_t row = mirrored(j, sites.ny);
    const Acceleration now = at(j);
    stepper_.accelerate_row(u, row, now);
    if (absorbing_) {
      std::copy_n(now.v, sites.nx, rated(j));
      drop_edges(sites, row, rated(j));
    }
    stepper_.fill_ends(rated(j));
  }

 private:
  std::size_t start_of(std::ptrdiff_t j) const { return static_cast<std::size_t>((j + 5) % 5) * stride_ + g; }
  double* rated(std::ptrdiff_t j) { return absorbing_ ? &rated_[start_of(j)] : &v_[start_of(j)]; }

  const Stepper& stepper_;
  bool absorbing_;
  std::size_t stride_;
  std::vector<double> v_, rated_, sine_, cosine_;
};

/// Steps rows [first, last).
void Stepper::step_rows(const Motion& m, std::size_t first, std::size_t last, std::vector<double>& next) {
  Window window(*this);
  std::vector<double> v_tt(sites_.nx), before(acts_on_steps() ? sites_.nx : 0);
  const auto begin = static_cast<std::ptrdiff_t>(first);
  for (std::ptrdiff_t j = begin - 2; j < begin + 2; ++j) window.find(m.u, j);
  for (std::size_t row = first; row < last; ++row) {
    const auto j = static_cast<std::ptrdiff_t>(row);
    window.find(m.u, j + 2);
    const Acceleration now = window.at(j);
    double* const after = &next[sites_.at(0, row)];
    std::copy_n(after, before.size(), before.data());
    step_row(shape_, dt_, &m.u[sites_.at(0, row)], now, window.rated_around(j), row_of(sites_.moves, sites_, row),
             v_tt.data(), after);
    if (before.empty()) continue;
    rub(m, row, now.v, v_tt.data(), before.data(), after);
    const double* const force = row_of(loads_.force(), sites_, row);
    supply_of_row_[row] = force ? work_of(sites_.nx, force, before.data(), after) : 0;
  }
}

Stepper::Work Stepper::step(const Motion& m, std::vector<double>& next) {
  loads_.find(time_of(m));
  const auto threads = static_cast<std::size_t>(std::max(threads_, 1));
  const std::size_t rows = std::max(fewest_rows_of_a_block, (sites_.ny + threads - 1) / threads);
  for_each_on_team((sites_.ny + rows - 1) / rows, threads_, [&](std::size_t block) {
    step_rows(m, block * rows, std::min((block + 1) * rows, sites_.ny), next);
  });
  fill_ghosts(next);
  Work work{0, 0, 0};
  const double area = sites_.hx * sites_.hy;
  for (std::size_t j = 0; j < sites_.ny; ++j) {
    work.dissipated += area * work_of_row_[j].dissipated;
    work.radiated += area * work_of_row_[j].radiated;
    work.supplied += area * supply_of_row_[j];
  }
  return work;
}

std::vector<double> Stepper::accelerations_at_rest(std::vector<double> u) const {
  fill_ghosts(u);
  return accelerations(u);
}

/// Everything is at rest, so that u one step before the start is u one step after it, in which friction does no work.
Motion Stepper::start(std::vector<double> u) {
  Motion m;
  fill_ghosts(u);
  if (problem_.hold) loads_.hold(accelerations(u));
  loads_.find(0);
  std::vector<double> v = accelerations(u);
  if (friction_.is_viscous()) m.v_old = v;
  for (std::size_t j = 0; j < sites_.ny; ++j)
    friction_.resist(j, problem_.nucleation_has_begun(0), &v[sites_.at(0, j)]);
  fill_ghosts(v);
  m.old.assign(sites_.size(), 0);
  const double dt2 = dt_ * dt_;
  for_each_acceleration(u, [&](std::size_t j, const Acceleration& now) {
    const std::size_t first = sites_.at(0, j);
    std::vector<double> v_tt(sites_.nx);
    laplacian(shape_, rows_around(v, sites_, j), v_tt.data());
    add_substrate_rate(sites_.nx, &v[first], nullptr, now, row_of(sites_.moves, sites_, j), v_tt.data());
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      m.old[first + i] = u[first + i] + dt2 / 2 * (v[first + i] + dt2 / 12 * v_tt[i]);
      if (!m.v_old.empty()) m.v_old[first + i] += dt2 / 2 * v_tt[i];  // so that v_t = 0
    }
  });
  fill_ghosts(m.old);
  m.u = std::move(u);
  return m;
}

bool Stepper::advance(Motion& m, double time, const std::function<bool()>& interrupted) {
  const double near = time - dt_ / 2 / sites_.scale;
  while (time_of(m) < near) {
    const Work work = step(m, m.old);
    std::swap(m.u, m.old);
    std::swap(m.v_old, v_);
    m.dissipated += work.dissipated;
    m.supplied += work.supplied;
    m.radiated += work.radiated;
    for_each_on_team(sites_.ny, threads_,
                     [&](std::size_t j) { friction_.age(j, &m.old[sites_.at(0, j)], &m.u[sites_.at(0, j)]); });
    ++m.steps;
    if (interrupted && interrupted()) break;
  }
  return time_of(m) >= near;
}

template <class Each>
void Stepper::for_each_site(const Each& each) const {
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    const std::size_t first = sites_.at(0, j);
    for (std::size_t at = first; at < first + sites_.nx; ++at) each(at);
  });
}

/// u_t of fourth order, from u one step before and one step after: (after - before) / (2 dt) - dt^2 / 6 u_ttt.
void Stepper::find_velocity(const std::vector<double>& u, const std::vector<double>& before,
                            const std::vector<double>& after, std::vector<double>& velocity) const {
  std::vector<double> central(sites_.size());
  for_each_site([&](std::size_t at) { central[at] = (after[at] - before[at]) / (2 * dt_); });
  fill_ghosts(central);
  for_each_acceleration(u, [&](std::size_t j, const Acceleration& now) {
    const std::size_t first = sites_.at(0, j);
    std::vector<double> third(sites_.nx);
    laplacian(shape_, rows_around(central, sites_, j), third.data());
    add_substrate_rate(sites_.nx, &central[first], nullptr, now, row_of(sites_.moves, sites_, j), third.data());
    for (std::size_t i = 0; i < sites_.nx; ++i) velocity[first + i] = central[first + i] - dt_ * dt_ / 6 * third[i];
  });
}

/// Takes one more step, for the velocity in the middle of two steps.
void Stepper::look_at(const Motion& m, double time, Look& look) {
  next_ = m.old;
  const Work work = step(m, next_);
  const double half = m.steps == 0 ? 0 : 0.5;  // the work is counted to the middle of the last step
  look.time = time;
  look.dissipated = m.dissipated + half * work.dissipated;
  look.supplied = m.supplied + half * work.supplied;
  look.radiated = m.radiated + half * work.radiated;
  look.u.resize(sites_.size());
  look.velocity.resize(sites_.size());
  find_velocity(m.u, m.old, next_, look.velocity);
  find_energy(m.u, look);
  const double later = (time - time_of(m)) * sites_.scale;
  for_each_site([&](std::size_t at) {
    const double v = (next_[at] - 2 * m.u[at] + m.old[at]) / (dt_ * dt_);
    look.u[at] = m.u[at] + later * (look.velocity[at] + later / 2 * v);
    look.velocity[at] += later * v;
  });
  if (!std::isfinite(look.kinetic + look.elastic))
    throw NumericsError("t = " + digits(time) + ": the displacement is not finite");
}

void Stepper::find_energy(const std::vector<double>& u, Look& look) const {
  std::vector<double> kinetic(sites_.ny), elastic(sites_.ny);
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    const std::size_t at = sites_.at(0, j);
    std::vector<double> curvature(sites_.nx);
    laplacian(shape_, rows_around(u, sites_, j), curvature.data());
    elastic[j] = substrate_energy(sites_.nx, &u[at], row_of(sites_.contact2, sites_, j));
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      kinetic[j] += look.velocity[at + i] * look.velocity[at + i] / 2;
      elastic[j] -= u[at + i] * curvature[i] / 2;
    }
  });
  look.kinetic = look.elastic = 0;
  for (std::size_t j = 0; j < sites_.ny; ++j) {
    look.kinetic += kinetic[j] * sites_.hx * sites_.hy;
    look.elastic += elastic[j] * sites_.hx * sites_.hy;
  }
}

}  // namespace slipfront::plane
