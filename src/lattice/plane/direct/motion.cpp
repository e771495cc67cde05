#include "lattice/plane/direct/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "system/team.hpp"

namespace slipfront::plane {
namespace {

constexpr std::size_t g = Sites::ghosts;
/// Each block of rows finds the accelerations of four more rows than it steps.
constexpr std::size_t fewest_rows_of_a_block = 32;
/// Steps in spacings. The scheme is stable to 1.06, and next to absorbing edges, where it is of second order, to 0.61.
constexpr double courant = 0.8, courant_with_absorbing_edges = 0.6;

/// A row of an array with ghosts, and its neighbours.
FiveRows rows_around(const std::vector<double>& array, const Sites& sites, std::ptrdiff_t row) {
  const std::size_t n = sites.stride(), at = sites.start_of(row);
  return {&array[at - 2 * n], &array[at - n], &array[at], &array[at + n], &array[at + 2 * n]};
}

/// A row of an array; null if the array is empty.
const double* row_of(const std::vector<double>& array, const Sites& sites, std::ptrdiff_t row) {
  return array.empty() ? nullptr : &array[sites.start_of(row)];
}

/// Sites next to absorbing edges have no acceleration in v_tt, because v does not contain their dashpots.
void drop_edges(const Sites& sites, std::ptrdiff_t row, double* v) {
  if (sites.on_edge(row)) std::fill_n(v, sites.nx, 0.0);
  v[0] = v[sites.nx - 1] = 0;
}

}  // namespace

Stepper::Stepper(const Problem& problem, const Sites& sites, int threads, const Ranks& ranks)
    : problem_(problem),
      sites_(sites),
      threads_(threads),
      ranks_(ranks),
      shape_{.sites = sites.nx, .per_hx2 = 1 / (sites.hx * sites.hx), .per_hy2 = 1 / (sites.hy * sites.hy)},
      dt_((problem.edges == Edges::absorbing ? courant_with_absorbing_edges : courant) *
          std::sqrt(2 / (shape_.per_hx2 + shape_.per_hy2))),
      loads_(problem, sites),
      friction_(problem, sites, dt_),
      work_of_row_(sites.ny) {}

void Stepper::fill_ends(double* row) const {
  double* const last = row + sites_.nx;
  for (std::size_t i = 0; i < g; ++i) {
    row[-1 - static_cast<std::ptrdiff_t>(i)] = row[i];
    last[i] = last[-1 - static_cast<std::ptrdiff_t>(i)];
  }
}

void Stepper::fill_ghosts(std::vector<double>& f) const {
  for (std::size_t j = 0; j < sites_.ny; ++j) fill_ends(&f[sites_.at(0, j)]);
  constexpr std::size_t ghosts = Sites::ghost_rows;
  const std::size_t n = sites_.stride(), top = sites_.ny + ghosts;
  for (std::size_t i = 0; i < ghosts; ++i) {
    if (sites_.has_bottom()) std::copy_n(&f[(ghosts + i) * n], n, &f[(ghosts - 1 - i) * n]);
    if (sites_.has_top()) std::copy_n(&f[(top - 1 - i) * n], n, &f[(top + i) * n]);
  }
  const std::span<double> all(f);
  const auto rows = [&](std::size_t first) { return all.subspan(first * n, ghosts * n); };
  ranks_.exchange(rows(ghosts), rows(top - ghosts), rows(0), rows(top), false);
}

/// The row itself, or the row that it mirrors outside of the domain, because the edge is free.
std::ptrdiff_t Stepper::inside(std::ptrdiff_t row) const {
  const auto rows = static_cast<std::ptrdiff_t>(sites_.ny);
  if (row < 0 && sites_.has_bottom()) return -row - 1;
  if (row >= rows && sites_.has_top()) return 2 * rows - row - 1;
  return row;
}

/// Finds the acceleration of a row of u.
void Stepper::accelerate_row(const std::vector<double>& u, std::ptrdiff_t row, const Acceleration& result) const {
  accelerate(shape_, rows_around(u, sites_, row),
             {.contact2 = row_of(sites_.contact2, sites_, row),
              .force = row_of(loads_.force(), sites_, row),
              .moves = row_of(sites_.moves, sites_, row)},
             result);
}

/// Calls each(row, acceleration) for all rows, on several threads.
template <class Each>
void Stepper::for_each_acceleration(const std::vector<double>& u, const Each& each) const {
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    std::vector<double> v(sites_.nx), sine(sites_.nx), cosine(sites_.nx);
    const Acceleration now{v.data(), sine.data(), cosine.data()};
    accelerate_row(u, static_cast<std::ptrdiff_t>(j), now);
    each(j, now);
  });
}

/// The second rate of v of a row, v_xx + v_yy - a^2 v cos u: v_tt of the acceleration v at rest, u_ttt of the velocity
/// v = u_t.
std::vector<double> Stepper::rates_of_change(const std::vector<double>& v, std::size_t j,
                                             const Acceleration& now) const {
  std::vector<double> rates(sites_.nx);
  const auto row = static_cast<std::ptrdiff_t>(j);
  laplacian(shape_, rows_around(v, sites_, row), rates.data());
  add_substrate_rate(sites_.nx, &v[sites_.at(0, j)], nullptr, now, row_of(sites_.moves, sites_, row), rates.data());
  return rates;
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

/// Applies friction to the step of a part of a row, and adds the work.
void Stepper::rub(const Motion& m, const RowPart& part, const Rates& rates, const double* before, double* after) {
  const FrictionWork work = friction_.slow(part, problem_.nucleation_has_begun(time_of(m)), rates, before, after);
  const double* const force = row_of(loads_.force(), sites_, static_cast<std::ptrdiff_t>(part.row));
  RowWork& of_row = work_of_row_[part.row];
  of_row.dissipated += work.dissipated;
  of_row.radiated += work.radiated;
  if (force) of_row.supplied += work_of(part.size, force + part.begin, before, after);
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
    const std::ptrdiff_t row = stepper_.inside(j);
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
void Stepper::step_rows(const Motion& m, std::size_t first, std::size_t last, Stepped to) {
  Window window(*this);
  const auto begin = static_cast<std::ptrdiff_t>(first);
  for (std::ptrdiff_t j = begin - 2; j < begin + 2; ++j) window.find(m.u, j);
  for (std::size_t row = first; row < last; ++row) {
    const auto j = static_cast<std::ptrdiff_t>(row);
    window.find(m.u, j + 2);
    work_of_row_[row] = {};
    for (RowPart part{row, 0, 0}; part.begin < sites_.nx; part.begin += part.size) {
      part.size = std::min(RowPart::most, sites_.nx - part.begin);
      step_part(m, part, window, to);
    }
  }
}

/// Asks the processor to load what the next row reads from memory.
void Stepper::prefetch(const Motion& m, const RowPart& part, const Stepped& to) const {
  if (part.row + 1 >= sites_.ny) return;
  constexpr std::size_t together = 8;
  const std::size_t next = sites_.at(part.begin, part.row + 1), two_rows = 2 * sites_.stride();
  const auto load = [&](const std::vector<double>& values, std::size_t from) {
    if (!values.empty())
      for (std::size_t i = 0; i < part.size; i += together) __builtin_prefetch(&values[from + i], 1, 2);
  };
  load(to.next, next);
  load(to.v_old, next);
  load(sites_.viscous, next);
  load(m.u, next + 2 * two_rows);
  load(sites_.contact2, next + two_rows);
  load(loads_.force(), next + two_rows);
}

void Stepper::step_part(const Motion& m, const RowPart& part, Window& window, Stepped to) {
  const auto j = static_cast<std::ptrdiff_t>(part.row);
  const std::size_t begin = part.begin, at = sites_.at(begin, part.row);
  std::array<double, RowPart::most> v_tt, before;
  const Acceleration row = window.at(j), now{row.v + begin, row.sine + begin, row.cosine + begin};
  FiveRows rated = window.rated_around(j);
  for (const double*& from : rated) from += begin;
  const double* const moves = row_of(sites_.moves, sites_, j);
  double* const after = &to.next[at];
  RowShape shape = shape_;
  shape.sites = part.size;
  prefetch(m, part, to);
  if (acts_on_steps_) std::copy_n(after, part.size, before.data());
  step_row(shape, dt_, &m.u[at], now, rated, moves ? moves + begin : nullptr, v_tt.data(), after);
  if (acts_on_steps_)
    rub(m, part, {now.v, v_tt.data(), to.v_old.empty() ? nullptr : &to.v_old[at]}, before.data(), after);
}

void Stepper::step(const Motion& m, Stepped to) {
  loads_.find(time_of(m));
  acts_on_steps_ = acts_on_steps();
  const auto threads = static_cast<std::size_t>(std::max(threads_, 1));
  const std::size_t rows = std::max(fewest_rows_of_a_block, (sites_.ny + threads - 1) / threads);
  for_each_on_team((sites_.ny + rows - 1) / rows, threads_,
                   [&](std::size_t block) { step_rows(m, block * rows, std::min((block + 1) * rows, sites_.ny), to); });
  fill_ghosts(to.next);
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
    const std::vector<double> v_tt = rates_of_change(v, j, now);
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      m.old[first + i] = u[first + i] + dt2 / 2 * (v[first + i] + dt2 / 12 * v_tt[i]);
      if (!m.v_old.empty()) m.v_old[first + i] += dt2 / 2 * v_tt[i];  // so that v_t = 0
    }
  });
  fill_ghosts(m.old);
  m.work.resize(sites_.ny);
  m.u = std::move(u);
  return m;
}

bool Stepper::advance(Motion& m, double time, const std::function<bool()>& interrupted) {
  const double near = time - dt_ / 2 / sites_.scale;
  while (time_of(m) < near) {
    step(m, {m.old, m.v_old});
    std::swap(m.u, m.old);
    for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
      m.work[j].dissipated += work_of_row_[j].dissipated;
      m.work[j].supplied += work_of_row_[j].supplied;
      m.work[j].radiated += work_of_row_[j].radiated;
      friction_.age(j, &m.old[sites_.at(0, j)], &m.u[sites_.at(0, j)]);
    });
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
    const std::vector<double> third = rates_of_change(central, j, now);
    for (std::size_t i = 0; i < sites_.nx; ++i) velocity[first + i] = central[first + i] - dt_ * dt_ / 6 * third[i];
  });
}

/// Takes one more step, for the velocity in the middle of two steps.
void Stepper::look_at(const Motion& m, double time, Sums& look) {
  next_ = m.old;
  v_next_ = m.v_old;
  step(m, {next_, v_next_});
  look.time = time;
  look.u.resize(sites_.size());
  look.velocity.resize(sites_.size());
  find_velocity(m.u, m.old, next_, look.velocity);
  find_energy(m.u, look);
  find_work(m, look);
  const double later = (time - time_of(m)) * sites_.scale;
  for_each_site([&](std::size_t at) {
    const double v = (next_[at] - 2 * m.u[at] + m.old[at]) / (dt_ * dt_);
    look.u[at] = m.u[at] + later * (look.velocity[at] + later / 2 * v);
    look.velocity[at] += later * v;
  });
  if (!std::isfinite(look.kinetic + look.elastic))
    throw NumericsError("t = " + digits(time) + ": the displacement is not finite");
}

void Stepper::find_energy(const std::vector<double>& u, Sums& look) const {
  std::vector<double> kinetic(sites_.ny), elastic(sites_.ny);
  for_each_on_team(sites_.ny, threads_, [&](std::size_t j) {
    const std::size_t at = sites_.at(0, j);
    const auto row = static_cast<std::ptrdiff_t>(j);
    std::vector<double> curvature(sites_.nx);
    laplacian(shape_, rows_around(u, sites_, row), curvature.data());
    elastic[j] = substrate_energy(sites_.nx, &u[at], row_of(sites_.contact2, sites_, row));
    for (std::size_t i = 0; i < sites_.nx; ++i) {
      kinetic[j] += look.velocity[at + i] * look.velocity[at + i] / 2;
      elastic[j] -= u[at + i] * curvature[i] / 2;
    }
  });
  look.kinetic = integral(kinetic);
  look.elastic = integral(elastic);
}

/// The work until the time of the motion, half a step after the time to which it is counted.
void Stepper::find_work(const Motion& m, Sums& look) const {
  const double half = m.steps == 0 ? 0 : 0.5;
  const auto until_now = [&](double RowWork::*part) {
    std::vector<double> of_row(sites_.ny);
    for (std::size_t j = 0; j < sites_.ny; ++j) of_row[j] = m.work[j].*part + half * work_of_row_[j].*part;
    return integral(of_row);
  };
  look.dissipated = until_now(&RowWork::dissipated);
  look.supplied = until_now(&RowWork::supplied);
  look.radiated = until_now(&RowWork::radiated);
}

/// The integral over the plane of a density whose sum over the sites of each row is `of_row`.
double Stepper::integral(const std::vector<double>& of_row) const {
  double sum = 0;
  for (const double row : ranks_.joined(of_row)) sum += row;
  return sum * sites_.hx * sites_.hy;
}

}  // namespace slipfront::plane
