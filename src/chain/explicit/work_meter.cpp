#include "chain/explicit/work_meter.hpp"

#include <algorithm>
#include <cmath>

#include "chain/explicit/levels/kernel.hpp"

namespace slipfront::chain {

WorkMeter::WorkMeter(const Problem& p, const Scheme& s, const Blocks& blocks, std::size_t first_block,
                     std::size_t end_block)
    : sums(sums_of_block(p) * (end_block - first_block), 0.0),
      problem_(&p),
      dt_(s.dt),
      blocks_(blocks),
      first_block_(first_block),
      sums_of_block_(sums_of_block(p)) {
  if (!p.forcing && !p.friction.acts()) return;
  for (std::size_t b = first_block; b <= end_block; ++b) begins_.push_back(blocks.begin(b));
  needs_two_steps_ = p.friction.acts() && p.friction.linear_coefficient();
  needs_B_ = p.forcing && !p.steady_forcing;
}

template <class AddTo>
void WorkMeter::add(std::size_t which, std::size_t begin, std::size_t end, double strength, const AddTo& add_to) {
  const std::size_t first = blocks_.of(begin) - first_block_, after = blocks_.of(end - 1) + 1 - first_block_;
  const BlockSums to{&begins_[first], after - first, &sums[sums_of_block_ * first + lanes * which], sums_of_block_};
  const double factor = strength * problem_->grid.spacing;
  add_to(to, factor, 0);
  if (problem_->boundary.periodic) return;
  // Half a spacing belongs to the last site at an end.
  constexpr std::size_t one[] = {0, 1};
  if (begin == 0) add_to({one, 1, to.sums, 0}, -factor / 2, 0);
  if (end == problem_->grid.sites)
    add_to({one, 1, to.sums + to.stride * (to.blocks - 1), 0}, -factor / 2, end - 1 - begin);
}

void WorkMeter::add(const Forces& forces, std::size_t begin, std::size_t end, const Steps& s) {
  constexpr std::size_t supplied = 0, by_contacts = 2;
  const long site = static_cast<long>(begin);
  const auto add_scratch = [&](std::size_t which) {
    add(which, begin, end, 1,
        [&](const BlockSums& to, double factor, std::size_t at) { add_values(to, factor, s.scratch + at); });
  };
  if (problem_->forcing && forces.steady())
    add(supplied, begin, end, 1, [&, F = forces.F_now(site)](const BlockSums& to, double factor, std::size_t at) {
      add_products(to, factor, F + at, s.D + at);
    });
  if (problem_->forcing && !forces.steady()) {
    works_of_force(forces.F_before(site), forces.F_now(site), forces.F_next(site), s.D, s.B, s.scratch, end - begin);
    add_scratch(supplied);
  }
  if (forces.contacts().acts()) {
    forces.energies_of_contacts(site, end - begin, s.u, s.D, s.scratch);
    add_scratch(by_contacts);
  }
  if (problem_->friction.acts()) add_friction(begin, end, s);
}

void WorkMeter::add_friction(std::size_t begin, std::size_t end, const Steps& s) {
  constexpr std::size_t dissipated = 1;
  const auto add_product = [&](double strength, const double* a, const double* b) {
    add(dissipated, begin, end, strength,
        [=](const BlockSums& to, double factor, std::size_t at) { add_products(to, factor, a + at, b + at); });
  };
  const friction::Friction& friction = problem_->friction;
  if (const auto C = friction.linear_coefficient()) {
    add(dissipated, begin, end, *C / dt_, [&](const BlockSums& to, double factor, std::size_t at) {
      add_squares(to, factor, s.D + at, s.D_before + at);
    });
  } else if (const auto f = friction.constant_strength()) {
    add(dissipated, begin, end, *f,
        [&](const BlockSums& to, double factor, std::size_t at) { add_absolutes(to, factor, s.D + at); });
  } else if (friction.steep_at_rest()) {
    add_product(1, s.applied, s.D);
  } else {
    const std::size_t size = end - begin;
    for (std::size_t j = 0; j < size; ++j) s.scratch[j] = std::fabs(s.D[j]) / dt_;
    friction.loops().strengths(size, s.scratch, s.states, s.further);
    add_product(dt_, s.scratch, s.further);
  }
}

}  // namespace slipfront::chain
