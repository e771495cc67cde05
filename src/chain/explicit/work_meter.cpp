#include "chain/explicit/work_meter.hpp"

#include <algorithm>
#include <cmath>

#include "chain/explicit/levels/kernel.hpp"

namespace slipfront::chain {
WorkMeter::WorkMeter(const Problem& p, bool active, const Scheme& s, const Blocks& blocks, std::size_t first_block,
                     std::size_t end_block)
    : sums(kinds(p) * (end_block - first_block), 0.0),
      problem_(&p),
      dt_(s.dt),
      blocks_(blocks),
      first_block_(first_block),
      begin_(blocks.begin(first_block)) {
  if (!active) return;
  u_.resize(blocks.begin(end_block) - begin_);
  for (std::size_t b = first_block; b <= end_block; ++b) begins_.push_back(blocks.begin(b));
}

void WorkMeter::start(const Forces& forces, std::size_t begin, std::size_t size, const double* z) {
  if (u_.empty()) return;
  forces.displacements_from(static_cast<long>(begin), size, z, &u_[begin - begin_]);
}

void WorkMeter::add(const Forces& forces, std::size_t begin, std::size_t end, const double* before, const double* now,
                    const double* next, Room& room) {
  const long site = static_cast<long>(begin);
  const double *D = room.D.data(), *B = room.B.data();
  forces.steps_from(site, end - begin, before, now, next, &u_[begin - begin_], room.D.data(), room.B.data());
  if (problem_->forcing) {
    const double *F_before = forces.F_before(site), *F_now = forces.F_now(site), *F_next = forces.F_next(site);
    add_to_blocks(begin, end, 0, 1, [=](std::size_t at, std::size_t size) {
      return work_of_force(F_before + at, F_now + at, F_next + at, D + at, B + at, size);
    });
  }
  if (forces.contacts().acts())
    add_to_blocks(begin, end, 2, 1, [&, D](std::size_t at, std::size_t size) {
      return forces.energy_of_contacts(site + static_cast<long>(at), size, &u_[begin - begin_] + at, D + at);
    });
  const friction::Friction& friction = problem_->friction;
  if (!friction.acts()) return;
  if (const auto C = friction.linear_coefficient()) {
    add_to_blocks(begin, end, 1, *C / dt_,
                  [=](std::size_t at, std::size_t size) { return work_of_viscous_friction(D + at, B + at, size); });
  } else if (const auto f = friction.constant_strength()) {
    add_to_blocks(begin, end, 1, *f,
                  [=](std::size_t at, std::size_t size) { return work_of_coulomb_friction(D + at, size); });
  } else {
    const double* applied = room.friction.data();
    add_to_blocks(begin, end, 1, 1, [&, D, applied](std::size_t at, std::size_t size) {
      return forces.work_of_friction(site + static_cast<long>(at), size, D + at, applied + at);
    });
  }
}

template <class Work>
void WorkMeter::add_to_blocks(std::size_t begin, std::size_t end, std::size_t which, double strength,
                              const Work& work) {
  const bool ends = !problem_->boundary.periodic;
  for (std::size_t b = blocks_.of(begin) - first_block_; b + 1 < begins_.size() && begins_[b] < end; ++b) {
    const std::size_t from = std::max(begin, begins_[b]), to = std::min(end, begins_[b + 1]);
    double sum = work(from - begin, to - from);
    // Half a spacing belongs to the last site at an end.
    if (ends && from == 0) sum -= work(0, 1) / 2;
    if (ends && to == problem_->grid.sites) sum -= work(to - 1 - begin, 1) / 2;
    sums[kinds(*problem_) * b + which] += strength * problem_->grid.spacing * sum;
  }
}

}  // namespace slipfront::chain
