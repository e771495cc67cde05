#include "parts.hpp"

#include <algorithm>
#include <string>

#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

Sides sides_of(const Problem& p, const Scheme& s) {
  const auto side = [](End end) {
    return end == End::free ? Side::free : end == End::fixed ? Side::fixed : Side::absorbing;
  };
  Sides sides{side(p.boundary.left), side(p.boundary.right), 0, s.dt / s.h};
  if (p.boundary.periodic) sides = {Side::seam, Side::seam, static_cast<double>(p.boundary.charge), 1};
  return sides;
}

}  // namespace

Chain::Parts::Parts(const Problem& p, const Execution& e, long at)
    : problem(p), scheme(scheme_of(p)), sides(sides_of(p, scheme)), execution(e), forces(p, scheme, at), level(at) {
  if (e.threads < 1)
    throw InputError(
        {.key = "threads", .value = std::to_string(e.threads), .problem = "out of range", .allowed = ">= 1"});
  const std::size_t n = p.grid.sites;
  const std::size_t count = std::clamp<std::size_t>(n / (2 * halo), 1, static_cast<std::size_t>(e.threads));
  execution.tile = std::max(e.tile / lanes * lanes, 2 * halo);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t begin = n * i / count, end = n * (i + 1) / count;
    Sides s = sides;
    if (i > 0) s.left = Side::joined;
    if (i + 1 < count) s.right = Side::joined;
    slabs.emplace_back(begin, end - begin, s);
  }
  depth = forces.none() ? std::min(halo, n) : 1;
}

void Chain::Parts::fill(const Levels& levels) {
  for (Slab& slab : slabs) {
    std::copy_n(levels.now.data() + slab.begin(), slab.size(), slab.now());
    std::copy_n(levels.before.data() + slab.begin(), slab.size(), slab.old());
  }
}

void Chain::Parts::exchange(std::size_t i) {
  Slab& slab = slabs[i];
  const std::size_t count = slabs.size(), most = std::min(halo, problem.grid.sites);
  if (slab.sides().left == Side::joined || slab.sides().left == Side::seam) {
    const Slab& from = slabs[(i + count - 1) % count];
    std::copy_n(from.now() + from.size() - most, most, slab.now() - most);
    std::copy_n(from.old() + from.size() - most, most, slab.old() - most);
  }
  if (slab.sides().right == Side::joined || slab.sides().right == Side::seam) {
    const Slab& from = slabs[(i + 1) % count];
    std::copy_n(from.now(), most, slab.now() + slab.size());
    std::copy_n(from.old(), most, slab.old() + slab.size());
  }
}

void Chain::Parts::advance_slab(Slab& slab, std::size_t count) {
  if (forces.none()) {
    slab.advance(scheme.rule, count, execution.tile);
    return;
  }
  constexpr std::size_t pad = lanes;
  Aligned y(slab.size() + 4 * pad), before(slab.size());
  forces.level(slab.sides(), static_cast<long>(slab.begin()), slab.size(), slab.now(), slab.old(), y.data() + pad,
               before.data());
  slab.swap();
}

void Chain::Parts::advance(std::size_t count) {
  const int number = static_cast<int>(slabs.size());
  // Fewer site updates than this take less time than it takes to wake a thread.
  const bool worth = problem.grid.sites * count > 50000;
  static_cast<void>(worth);  // where there is no OpenMP
#ifdef _OPENMP
#pragma omp parallel for num_threads(number) schedule(static, 1) if (worth)
#endif
  for (int i = 0; i < number; ++i) exchange(static_cast<std::size_t>(i));
#ifdef _OPENMP
#pragma omp parallel for num_threads(number) schedule(static, 1) if (worth)
#endif
  for (int i = 0; i < number; ++i) advance_slab(slabs[static_cast<std::size_t>(i)], count);
  level += static_cast<long>(count);
  if (!forces.none()) forces.proceed();
}

void Chain::Parts::check_numbers() const {
  for (const Slab& slab : slabs) {
    if (bounded(slab.now(), slab.size())) continue;
    std::size_t j = 0;
    while (bounded(slab.now() + j, 1)) ++j;
    const std::size_t site = slab.begin() + j;
    throw NumericsError("t = " + std::to_string(static_cast<double>(level) * scheme.dt) + ": displacement of site " +
                        std::to_string(site) + " (x = " + std::to_string(problem.grid.x(site)) + ") is not a number");
  }
}

std::pair<double, double> Chain::Parts::site(long j) const {
  const long n = static_cast<long>(problem.grid.sites);
  double now_shift = 0, old_shift = 0, sign = 1;
  const auto reflect = [&](long end, End kind) {
    j = 2 * end - j;
    if (kind != End::fixed) return;
    const auto [now, old] = site(end);
    sign = -1;
    now_shift = 2 * now;
    old_shift = 2 * old;
  };
  if (problem.boundary.periodic) {
    const long around = j < 0 ? -1 : j >= n ? 1 : 0;
    j -= around * n;
    now_shift = old_shift = -static_cast<double>(around * problem.boundary.charge);
  } else if (j < 0) {
    reflect(0, problem.boundary.left);
  } else if (j >= n) {
    reflect(n - 1, problem.boundary.right);
  }
  const auto at = static_cast<std::size_t>(j);
  std::size_t i = std::min(at * slabs.size() / problem.grid.sites, slabs.size() - 1);
  while (at < slabs[i].begin()) --i;
  while (at >= slabs[i].begin() + slabs[i].size()) ++i;
  const std::size_t k = at - slabs[i].begin();
  return {sign * slabs[i].now()[k] + now_shift, sign * slabs[i].old()[k] + old_shift};
}

}  // namespace slipfront::chain
