#include "work_meter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipfront::chain {
namespace {

using modulation::FrictionLaw;
constexpr double turn = 2 * std::numbers::pi;

}  // namespace

WorkMeter::WorkMeter(const Problem& p, const Scheme& s, const Blocks& blocks, std::size_t first_block,
                     std::size_t end_block)
    : sums(2 * (end_block - first_block), 0.0),
      problem_(&p),
      dt_(s.dt),
      blocks_(blocks),
      first_block_(first_block),
      end_block_(end_block),
      begin_(blocks.begin(first_block)) {
  if (!p.forcing && (p.friction.law == FrictionLaw::none || p.friction.coefficient == 0)) return;  // no work to meter
  u_.resize(blocks.begin(end_block) - begin_);
  next_.resize(u_.size());
  room_.resize(u_.size());
  known_.resize(end_block - first_block, 0);
}

void WorkMeter::look(const Forces& forces, const Slab& slab) {
  if (u_.empty()) return;
  for (std::size_t b = first_block_; b < end_block_; ++b) {
    const std::size_t begin = blocks_.begin(b), end = blocks_.begin(b + 1), at = begin - begin_;
    if (begin < slab.begin() || end > slab.begin() + slab.size() || known_[b - first_block_] != 0) continue;
    forces.displacements_from(static_cast<long>(begin), end - begin, slab.now() + (begin - slab.begin()), &u_[at],
                              &room_[at]);
    known_[b - first_block_] = 1;
  }
}

void WorkMeter::add(const Forces& forces, const Slab& slab, const double* before, const double* now,
                    const double* next) {
  if (u_.empty()) return;
  const modulation::FrictionLaw law = problem_->friction.law;
  const double C = problem_->friction.coefficient, h = problem_->grid.spacing;
  for (std::size_t b = first_block_; b < end_block_; ++b) {
    const std::size_t begin = blocks_.begin(b), end = blocks_.begin(b + 1);
    if (begin < slab.begin() || end > slab.begin() + slab.size()) continue;
    forces.displacements_from(static_cast<long>(begin), end - begin, next + (begin - slab.begin()),
                              &next_[begin - begin_], &room_[begin - begin_]);
    double supplied = 0, dissipated = 0;
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t i = j - slab.begin(), at = j - begin_;
      const long site = static_cast<long>(j);
      const bool last = !problem_->boundary.periodic && (j == 0 || j + 1 == problem_->grid.sites);
      const double weight = last ? h / 2 : h, D = turn * (next_[at] - u_[at]);
      const double B = turn * ((next[i] - now[i]) - (now[i] - before[i]));
      if (problem_->forcing)
        supplied += weight * ((forces.now(site) + forces.next(site)) / 2 * D + forces.rate(site) * dt_ * B / 6);
      if (law == FrictionLaw::viscous)
        dissipated += weight * C / dt_ * (D * D + B * B / 12);
      else if (C > 0 && law != FrictionLaw::none)
        dissipated += weight * std::fabs(forces.friction(D / dt_) * D);
    }
    sums[2 * (b - first_block_)] += supplied;
    sums[2 * (b - first_block_) + 1] += dissipated;
    std::swap_ranges(u_.begin() + static_cast<std::ptrdiff_t>(begin - begin_),
                     u_.begin() + static_cast<std::ptrdiff_t>(end - begin_),
                     next_.begin() + static_cast<std::ptrdiff_t>(begin - begin_));
  }
}

}  // namespace slipfront::chain
