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
constexpr std::size_t rows_of_a_block = 32;
constexpr double courant = 0.8;  ///< the scheme is stable to 1.06 spacings

/// A row of an array with ghosts, and its neighbours.
FiveRows rows_around(const std::vector<double>& array, const Sites& sites, std::size_t j) {
  const std::size_t n = sites.stride(), at = sites.at(0, j);
  return {&array[at - 2 * n], &array[at - n], &array[at], &array[at + n], &array[at + 2 * n]};
}

/// A row of an array; null if the array is empty.
const double* row_of(const std::vector<double>& array, const Sites& sites, std::size_t j) {
  return array.empty() ? nullptr : &array[sites.at(0, j)];
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
      dt_(courant * std::sqrt(2 / (shape_.per_hx2 + shape_.per_hy2))) {
  work_of_row_.assign(sites.ny, 0);
  supply_of_row_.assign(sites.ny, 0);
}

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

void Stepper::find_force(double time) {
  if (!problem_.forcing) return;
  force_.resize(sites_.size());
  for (std::size_t j = 0; j < sites_.ny; ++j)
    for (std::size_t i = 0; i < sites_.nx; ++i)
      force_[sites_.at(i, j)] = problem_.forcing(sites_.x(i), sites_.y(j), time) / sites_.scale;
}

/// u_xx + u_yy - a^2 sin u + F of all sites.
std::vector<double> Stepper::accelerations(const std::vector<double>& u) const {
  std::vector<double> v(sites_.size(), 0.0);
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    double* const row = &v[sites_.at(0, j)];
    laplacian(shape_, rows_around(u, sites_, j), row);
    add_substrate(sites_.nx, &u[sites_.at(0, j)], row_of(sites_.contact2, sites_, j), row_of(sites_.moves, sites_, j),
                  row_of(force_, sites_, j), row);
  });
  fill_ghosts(v);
  return v;
}

/// Applies a law of friction to the step of a row from u(t - dt), `before`, to u(t + dt), `after`. Returns the work
/// against friction, of any kind, over the time dt.
double Stepper::rub(std::size_t j, const double* before, double* after) const {
  double work = 0;
  if (!sites_.viscous.empty()) {
    const double* const C = row_of(sites_.viscous, sites_, j);
    rub_viscous(sites_.nx, dt_, C, before, after);
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      const double velocity = (after[i] - before[i]) / (2 * dt_);
      work += C[i] * velocity * velocity;
    }
    return work * dt_;
  }
  if (!problem_.friction.acts()) return 0;
  const friction::Law& law = problem_.friction.law();
  for (std::size_t i = 0; i < sites_.nx; ++i) {
    const double free = (after[i] - before[i]) / (2 * dt_);
    const double speed = law.speed_after(std::fabs(free), dt_ / 2 / sites_.scale, {});
    after[i] = before[i] + 2 * dt_ * std::copysign(speed, free);
    work += speed * (std::fabs(free) - speed) * 2 / dt_;
  }
  return work * dt_;
}

/// Steps rows [first, last). Five rows of v are enough at a time.
void Stepper::step_rows(const std::vector<double>& u, std::size_t first, std::size_t last, std::vector<double>& next) {
  const std::size_t n = sites_.stride();
  std::vector<double> window(5 * n), v_tt(sites_.nx), before(sites_.nx);
  const auto v_row = [&](std::ptrdiff_t j) { return &window[static_cast<std::size_t>((j + 5) % 5) * n + g]; };
  const auto find_v = [&](std::ptrdiff_t j) {
    const std::size_t row = mirrored(j, sites_.ny);
    double* const v = v_row(j);
    laplacian(shape_, rows_around(u, sites_, row), v);
    add_substrate(sites_.nx, &u[sites_.at(0, row)], row_of(sites_.contact2, sites_, row),
                  row_of(sites_.moves, sites_, row), row_of(force_, sites_, row), v);
    fill_ends(v);
  };
  const auto begin = static_cast<std::ptrdiff_t>(first);
  for (std::ptrdiff_t j = begin - 2; j < begin + 2; ++j) find_v(j);
  for (std::size_t row = first; row < last; ++row) {
    const auto j = static_cast<std::ptrdiff_t>(row);
    find_v(j + 2);
    laplacian(shape_, {v_row(j - 2), v_row(j - 1), v_row(j), v_row(j + 1), v_row(j + 2)}, v_tt.data());
    double* const after = &next[sites_.at(0, row)];
    std::copy_n(after, sites_.nx, before.data());
    step_row(sites_.nx, dt_, &u[sites_.at(0, row)], v_row(j), row_of(sites_.contact2, sites_, row),
             row_of(sites_.moves, sites_, row), v_tt.data(), after);
    work_of_row_[row] = rub(row, before.data(), after);
    supply_of_row_[row] = 0;
    if (const double* const force = row_of(force_, sites_, row))
      for (std::size_t i = 0; i < sites_.nx; ++i) supply_of_row_[row] += force[i] * (after[i] - before[i]) / 2;
  }
}

Stepper::Work Stepper::step(double time, const std::vector<double>& u, std::vector<double>& next) {
  find_force(time);
  const std::size_t blocks = (sites_.ny + rows_of_a_block - 1) / rows_of_a_block;
  for_each_on_team(blocks, threads_, [&](std::size_t block) {
    const std::size_t first = block * rows_of_a_block;
    step_rows(u, first, std::min(first + rows_of_a_block, sites_.ny), next);
  });
  fill_ghosts(next);
  Work work{0, 0};
  const double area = sites_.hx * sites_.hy;
  for (std::size_t j = 0; j < sites_.ny; ++j) {
    work.dissipated += area * work_of_row_[j];
    work.supplied += area * supply_of_row_[j];
  }
  return work;
}

/// Everything is at rest, so that u one step before the start is u one step after it, in which friction does no work.
Motion Stepper::start(std::vector<double> u) {
  Motion m;
  fill_ghosts(u);
  find_force(0);
  const std::vector<double> v = accelerations(u);
  m.old.assign(sites_.size(), 0);
  const double dt2 = dt_ * dt_;
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    const std::size_t first = sites_.at(0, j);
    std::vector<double> v_tt(sites_.nx);
    const std::vector<double> at_rest(sites_.nx, 0.0);
    laplacian(shape_, rows_around(v, sites_, j), v_tt.data());
    add_substrate_rate(sites_.nx, &u[first], &v[first], at_rest.data(), row_of(sites_.contact2, sites_, j),
                       row_of(sites_.moves, sites_, j), v_tt.data());
    for (std::size_t i = 0; i < sites_.nx; ++i)
      m.old[first + i] = u[first + i] + dt2 / 2 * (v[first + i] + dt2 / 12 * v_tt[i]);
  });
  fill_ghosts(m.old);
  m.u = std::move(u);
  return m;
}

bool Stepper::advance(Motion& m, double time, const std::function<bool()>& interrupted) {
  const double near = time - dt_ / 2 / sites_.scale;
  while (time_of(m) < near) {
    const Work work = step(time_of(m), m.u, m.old);
    std::swap(m.u, m.old);
    m.dissipated += work.dissipated;
    m.supplied += work.supplied;
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
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    const std::size_t first = sites_.at(0, j);
    std::vector<double> third(sites_.nx);
    const std::vector<double> none(sites_.nx, 0.0);
    laplacian(shape_, rows_around(central, sites_, j), third.data());
    add_substrate_rate(sites_.nx, &u[first], &central[first], none.data(), row_of(sites_.contact2, sites_, j),
                       row_of(sites_.moves, sites_, j), third.data());
    for (std::size_t i = 0; i < sites_.nx; ++i) velocity[first + i] = central[first + i] - dt_ * dt_ / 6 * third[i];
  });
}

/// Takes one more step, for the velocity in the middle of two steps.
void Stepper::look_at(const Motion& m, double time, Look& look) {
  next_ = m.old;
  const Work work = step(time_of(m), m.u, next_);
  const double half = m.steps == 0 ? 0 : 0.5;  // the work is counted to the middle of the last step
  look.time = time;
  look.dissipated = m.dissipated + half * work.dissipated;
  look.supplied = m.supplied + half * work.supplied;
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
