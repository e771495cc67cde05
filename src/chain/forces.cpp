#include "forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Site j of the problem's grid, also beyond its ends.
std::size_t folded(const Problem& p, long j) {
  const long n = static_cast<long>(p.grid.sites);
  if (p.boundary.periodic) return static_cast<std::size_t>((j % n + n) % n);
  while (j < 0 || j >= n) j = j < 0 ? -j : 2 * (n - 1) - j;
  return static_cast<std::size_t>(j);
}

}  // namespace

Forces::Forces(const Problem& problem, const Scheme& scheme, long level, std::size_t begin, std::size_t end)
    : problem_(problem),
      scheme_(scheme),
      sine_(substrate_force(0)),
      dt_(scheme.dt),
      level_(level),
      first_(static_cast<long>(begin) - static_cast<long>(beyond)),
      last_(static_cast<long>(end + beyond)),
      nonlinear_(problem.friction.acts() && !problem.friction.linear_coefficient()),
      variables_(problem.friction.variables()),
      memory_(variables_ * problem.grid.sites) {
  for (std::size_t j = 0; j < memory_.size(); j += variables_)
    problem_.friction.law().start(std::span(memory_).subspan(j, variables_));
  if (problem_.contact) {
    for (long j = first_; j < last_; ++j) {
      const double a = problem_.contact(problem_.grid.x(folded(problem_, j)));
      a2_.push_back(a * a);
    }
  }
  if (problem_.forcing) {
    F_now_ = forcing_at(problem_.steady_forcing ? 0 : level_);
    if (problem_.steady_forcing) return;
    F_next_ = forcing_at(level_ + 1);
    F_before_ = forcing_at(level_ - 1);
  }
}

std::vector<double> Forces::forcing_at(long level) const {
  std::vector<double> F(at(last_));
  if (level < 0) {  // before the start, where F need not be defined: by extrapolation
    const std::vector<double> zero = forcing_at(0), one = forcing_at(1), two = forcing_at(2);
    for (std::size_t j = 0; j < F.size(); ++j) F[j] = 3 * zero[j] - 3 * one[j] + two[j];
    return F;
  }
  const double t = static_cast<double>(level) * dt_;
  for (long j = first_; j < last_; ++j) F[at(j)] = problem_.forcing(problem_.grid.x(folded(problem_, j)), t);
  return F;
}

const double* Forces::memory_of(long j) const { return memory_.data() + variables_ * folded(problem_, j); }

void Forces::age(long first, std::size_t size, const double* now, const double* next) {
  if (variables_ == 0) return;
  const std::span<double> all(memory_);
  for (std::size_t j = 0; j < size; ++j)
    problem_.friction.law().advance((next[j] - now[j]) / dt_ * turn, dt_,
                                    all.subspan(variables_ * (static_cast<std::size_t>(first) + j), variables_));
}

std::vector<double> Forces::memories(std::size_t begin, std::size_t end) const {
  const auto at = [&](std::size_t j) { return memory_.begin() + static_cast<std::ptrdiff_t>(variables_ * j); };
  return {at(begin), at(end)};
}

void Forces::set_memories(std::size_t begin, const std::vector<double>& memories) {
  std::copy(memories.begin(), memories.end(), memory_.begin() + static_cast<std::ptrdiff_t>(variables_ * begin));
}

void Forces::proceed() {
  ++level_;
  if (steady()) return;
  F_before_.swap(F_now_);
  F_now_.swap(F_next_);
  F_next_ = forcing_at(level_ + 1);
}

void Forces::steps_from(long j, std::size_t size, const double* before, const double* now, const double* next,
                        double* u, double* D, double* B, double* u_next, double* S) const {
  if (a2_.empty()) {
    take_steps(scheme_.rule.f, scheme_.eps, before, now, next, u, D, B, size);
    return;
  }
  displacements(sine_, scheme_.eps, a2(j), next, u_next, S, size);
  take_steps(before, now, next, u_next, u, D, B, size);
}

void Forces::displacements_from(long j, std::size_t size, const double* z, double* u, double* S) const {
  if (a2_.empty())
    displacements(scheme_.rule.f, scheme_.eps, z, u, size);
  else
    displacements(sine_, scheme_.eps, a2(j), z, u, S, size);
}

void Forces::level(const Sides& sides, long offset, std::size_t size, const double* before, const double* now,
                   double* next, double* y, Outflow& outflow) const {
  if (!a2_.empty()) {
    const double* a2 = this->a2(offset - 1);
    local_part_with_contact(scheme_.rule, sine_, scheme_.eps, a2, now - 1, before - 1, next - 1, y - 1, 0, size + 2);
  } else {
    local_part(scheme_.rule, now - 1, before - 1, next - 1, y - 1, 0, (size + 2 + lanes - 1) / lanes * lanes);
  }
  // Counted from two sites before, so that a seam's other side has an index.
  const EndSites bare = before_neighbours(sides, next - 2, 2, size + 1);
  add_neighbours(scheme_.rule.spread, y, next, 0, (size + lanes - 1) / lanes * lanes);
  const auto given = [](Side side) { return side == Side::fixed || side == Side::absorbing; };
  const std::size_t from = given(sides.left) ? 1 : 0, to = given(sides.right) ? size - 1 : size;
  mend_ends(sides, bare, scheme_.rule.spread, now - 2, y - 2, next - 2, 2, size + 1, outflow);
  if (!F_now_.empty()) {
    const long first = offset + static_cast<long>(from);
    const double strength = scheme_.force / turn;
    const DriveRule rule{strength * scheme_.share_next, strength * scheme_.share_before, strength * scheme_.share_now,
                         strength * scheme_.share_beside};
    add_drive(rule, F_before(first), F_now(first), F_next(first), next + from, to - from);
  }
  if (nonlinear_) add_friction(offset, from, to, before, now, next);
}

void Forces::add_friction(long offset, std::size_t begin, std::size_t end, const double* before, const double* now,
                          double* next) const {
  const friction::Friction& f = problem_.friction;
  if (const auto strength = f.law().constant_strength()) {
    shorten_steps(dt_ * dt_ * *strength / turn, now + begin, next + begin, end - begin);
    return;
  }
  // Centred on the level where that is stable. Laws that are steep at rest act on the half step after it: they can stop
  // a site but not throw it back.
  const bool centred = !f.steep_at_rest();
  const double time = centred ? 2 * dt_ : dt_, weight = dt_ * dt_ / time;
  for (std::size_t j = begin; j < end; ++j) {
    const double from = centred ? before[j] : now[j];
    const double free = (next[j] - from) / time * turn;
    next[j] = from + time / turn * f.velocity_after(free, weight, memory(offset + static_cast<long>(j)));
  }
}

}  // namespace slipfront::chain
