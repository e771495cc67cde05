#include "lattice/chain/explicit/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "lattice/chain/explicit/levels/kernel.hpp"

namespace slipfront::chain {

WorkMeter::WorkMeter(const Problem& p, const Scheme& s, const Blocks& blocks, std::size_t first_block,
                     std::size_t end_block)
    : sums(sums_of_block(p) * (end_block - first_block), 0.0),
      problem_(&p),
      dt_(s.dt),
      energy_of_turn_(turn * p.grid.spacing),
      blocks_(blocks),
      first_block_(first_block),
      sums_of_block_(sums_of_block(p)) {
  if (!p.forcing && !p.friction.acts()) return;
  for (std::size_t b = first_block; b <= end_block; ++b) begins_.push_back(blocks.begin(b));
  const friction::Friction& f = p.friction;
  const bool alone = !needs_step_before();  // the work of a force needs the steps, too
  if (!f.acts())
    of_each_step_ = alone ? Measured::nothing : Measured::steps;
  else if (f.linear_coefficient())
    of_each_step_ = Measured::squares;
  else if (f.constant_strength())
    of_each_step_ = alone ? Measured::only_absolutes : Measured::absolutes;
  else
    of_each_step_ = alone && f.square_coefficient() ? Measured::only_cubes : Measured::steps;
}

BlockSums WorkMeter::sums_of(Kind kind, std::vector<double>& energies, std::size_t begin, std::size_t end,
                             std::size_t at) const {
  const std::size_t first = blocks_.of(begin) - first_block_, after = blocks_.of(end - 1) + 1 - first_block_;
  const bool has_ends = !problem_->boundary.periodic;  // half a spacing belongs to the site at an end
  return {.begins = &begins_[first],
          .blocks = after - first,
          .sums = &energies[sums_of_block_ * first + lanes * kind],
          .stride = sums_of_block_,
          .at = at,
          .half_first = has_ends && begin == 0,
          .half_last = has_ends && end == problem_->grid.sites};
}

StepOfU WorkMeter::step(std::size_t begin, std::size_t end, std::size_t at) {
  const friction::Friction& f = problem_->friction;
  const double rate_of_turn = turn / dt_;
  const double factor = of_each_step_ == Measured::squares      ? *f.linear_coefficient() * rate_of_turn
                        : of_each_step_ == Measured::only_cubes ? *f.square_coefficient() * rate_of_turn * rate_of_turn
                                                                : f.constant_strength().value_or(0);
  return {.what = of_each_step_, .to = sums_of(dissipated, sums, begin, end, at), .factor = factor * energy_of_turn_};
}

void WorkMeter::add_potential(double strength, const double* F, std::size_t begin, std::size_t end, const double* u,
                              std::vector<double>& energies) const {
  add_products(sums_of(supplied, energies, begin, end), strength * energy_of_turn_, F, u);
}

void WorkMeter::add(const Forces& forces, std::size_t begin, std::size_t end, const Steps& s) {
  if (needs_step_before()) {
    const auto &before = forces.weights(s.ahead - 2), &now = forces.weights(s.ahead - 1),
               &next = forces.weights(s.ahead);
    ForceTerms::Weights of_D{}, of_B{};
    for (std::size_t i = 0; i < of_D.size(); ++i) {
      of_D[i] = (now[i] + next[i]) * 0.5;
      of_B[i] = (next[i] - before[i]) * (1.0 / 12);
    }
    add_works(sums_of(supplied, sums, begin, end), energy_of_turn_, forces.terms(static_cast<long>(begin)), of_D, of_B,
              s.D, s.D_before);
  }
  if (forces.contacts().acts()) {
    forces.energies_of_contacts(static_cast<long>(begin), end - begin, s.u, s.D, s.scratch);
    add_values(sums_of(by_contacts, sums, begin, end), problem_->grid.spacing, s.scratch);
  }
  if (problem_->friction.acts() && of_each_step_ == Measured::steps) add_friction(begin, end, s);
}

void WorkMeter::add_friction(std::size_t begin, std::size_t end, const Steps& s) {
  const friction::Friction& friction = problem_->friction;
  if (friction.steep_at_rest()) {
    add_products(sums_of(dissipated, sums, begin, end), energy_of_turn_, s.applied, s.D);
    return;
  }
  friction.loops().powers(end - begin, turn / dt_, s.D, s.states, s.scratch);
  add_values(sums_of(dissipated, sums, begin, end), dt_ * problem_->grid.spacing, s.scratch);
}

namespace {

constexpr std::size_t pad = lanes;       // the second loop reads y one site outside the tile and its halos
constexpr std::size_t own = pad + halo;  // index of the first site of a tile

void copy(const double* from, double* to, std::size_t count) { std::memcpy(to, from, count * sizeof(double)); }

/// Copies the first `count` variables of some sites.
void copy_states(std::size_t count, friction::LocalStates from, friction::EvolvingStates to, std::size_t sites) {
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t i = 0; i < sites; ++i) to(i, v) = from(i, v);
}

std::size_t whole_vectors(std::size_t size) { return (size + lanes - 1) / lanes * lanes; }

std::size_t room_for(const std::vector<std::size_t>& cuts) {
  std::size_t widest = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) widest = std::max(widest, cuts[i + 1] - cuts[i]);
  return whole_vectors(widest) + 2 * halo + 2 * pad;
}

}  // namespace

Sweep::Sweep(Slab& slab, Forces& forces, WorkMeter& meter, std::vector<std::size_t> cuts)
    : slab_(slab),
      forces_(forces),
      meter_(meter),
      cuts_(std::move(cuts)),
      room_(room_for(cuts_)),
      arrays_{Aligned(room_), Aligned(room_), Aligned(room_)},
      before_(arrays_[0].data()),
      now_(arrays_[1].data()),
      spare_(arrays_[2].data()),
      y_(room_),
      coefficients_(forces.has_contact() ? PeriodicForce::terms * room_ : 0),
      states_(forces.variables() * room_),
      applied_(forces.implicit_speed() ? room_ : 0),
      u_(meter.of_each_step() != Measured::nothing ? room_ : 0),
      steps_{Aligned(meter.of_each_step() != Measured::nothing ? room_ : 0),
             Aligned(meter.needs_step_before() ? room_ : 0)},
      D_(steps_[0].data()),
      D_before_(meter.needs_step_before() ? steps_[1].data() : D_),
      left_now_(halo),
      left_old_(halo),
      left_states_(forces.variables() * halo),
      right_states_(forces.variables() * halo) {
  if (forces.phases_of_32_bits()) phases_.emplace(forces.scheme(), room_, meter.of_each_step() != Measured::nothing);
}

std::size_t Sweep::bytes(const Forces& forces, const WorkMeter& meter) {
  const Measured what = meter.of_each_step();
  const bool keeps_steps = what != Measured::only_absolutes && what != Measured::only_cubes;
  const std::size_t measuring = what == Measured::nothing ? 0 : keeps_steps ? 2 : 1;
  if (forces.phases_of_32_bits()) return (3 + measuring) * sizeof(Phase);
  return usual_bytes +
         sizeof(double) * ((forces.has_contact() ? PeriodicForce::terms / 2 : 0) + forces.variables() + measuring +
                           (forces.implicit_speed() ? 2 : 0) + (meter.needs_step_before() ? 2 : 0));
}

void Sweep::exchange_states() {
  const std::size_t count = forces_.variables() * halo;
  if (count == 0) return;
  const long begin = static_cast<long>(slab_.begin());
  copy(forces_.state_of(begin - static_cast<long>(halo)), left_states_.data(), count);
  copy(forces_.state_of(begin + static_cast<long>(slab_.size())), right_states_.data(), count);
}

Sweep::Tile Sweep::tile(std::size_t piece) const {
  const std::size_t from = cuts_[piece] - slab_.begin(), width = cuts_[piece + 1] - cuts_[piece];
  Tile t{from, width, static_cast<long>(cuts_[piece]) - static_cast<long>(own), slab_.ends()};
  if (from > 0) t.ends.left = EndCondition::joined;
  if (from + width < slab_.size()) t.ends.right = EndCondition::joined;
  return t;
}

void Sweep::advance(std::size_t count) {
  copy(slab_.now() - halo, left_now_.data(), halo);
  copy(slab_.old() - halo, left_old_.data(), halo);
  for (std::size_t piece = 0; piece + 1 < cuts_.size(); ++piece) {
    const Tile t = tile(piece);
    load(t);
    if (phases_)
      advance_phases(t, count);
    else
      advance(t, count);
    store(t);
  }
}

/// Copies the sites of a tile and of its halos, and keeps those left of the next tile, which this one will change.
void Sweep::load(const Tile& t) {
  const double *const now = slab_.now() + t.from, *const old = slab_.old() + t.from;
  copy(left_now_.data(), now_ + pad, halo);
  copy(left_old_.data(), before_ + pad, halo);
  copy(now, now_ + own, t.width + halo);
  copy(old, before_ + own, t.width + halo);
  if (t.width >= halo) {
    copy(now + t.width - halo, left_now_.data(), halo);
    copy(old + t.width - halo, left_old_.data(), halo);
  }
  if (forces_.variables() > 0) load_states(t);
}

void Sweep::load_states(const Tile& t) {
  const std::size_t each = forces_.variables(), here = std::min(t.width + halo, slab_.size() - t.from);
  const double* const states = forces_.state_of(static_cast<long>(slab_.begin() + t.from));
  copy_states(each, {left_states_.data(), each}, columns(pad), halo);
  copy_states(each, {states, each}, columns(own), here);
  copy_states(each, {right_states_.data(), each}, columns(own + here), t.width + halo - here);
  if (t.width >= halo) copy(states + each * (t.width - halo), left_states_.data(), each * halo);
}

void Sweep::store(const Tile& t) {
  copy(now_ + own, slab_.now() + t.from, t.width);
  copy(before_ + own, slab_.old() + t.from, t.width);
  if (!wrong_site_) find_wrong_site(t);
  if (forces_.ages())
    copy_states(forces_.evolving(), columns(own),
                {forces_.state_of(static_cast<long>(slab_.begin() + t.from)), forces_.variables()}, t.width);
}

void Sweep::find_wrong_site(const Tile& t) {
  const double* const z = now_ + own;
  const double most = phases_ ? most_turns_of_phases : most_turns;
  std::size_t j = phases_ ? phases_->first_not_followed() - own : t.width;
  if (!bounded(z, t.width, most))
    for (j = 0; bounded(z + j, 1, most);) ++j;
  if (j < t.width) wrong_site_ = slab_.begin() + t.from + j;
}

/// Asks the processor to load some sites of the next tile into its cache while it computes this one.
void Sweep::prefetch(const Tile& t, std::size_t level, std::size_t count) const {
#if defined(__GNUC__)
  const std::size_t next = t.from + t.width;
  if (next >= slab_.size()) return;
  const std::size_t share = whole_vectors(std::min(t.width, slab_.size() - next) / count + 1);
  const std::size_t begin = next + halo + level * share;
  for (std::size_t j = begin; j < begin + share; j += lanes) {
    __builtin_prefetch(slab_.now() + j, 1, 2);
    __builtin_prefetch(slab_.old() + j, 1, 2);
  }
#endif
}

/// The sites to compute at a level after which `rest` levels follow.
LevelSites Sweep::sites_at(const Tile& t, std::size_t rest) {
  LevelSites s{.offset = t.offset,
               .left = is_end(t.ends.left) ? own : own - rest,
               .right = is_end(t.ends.right) ? own + t.width : own + t.width + rest,
               .before = before_,
               .now = now_,
               .next = forces_.implicit_speed() ? spare_ : before_,
               .y = y_.data()};
  if (forces_.has_contact()) s.coefficients = coefficients_.data();
  s.states = columns(0);
  if (forces_.implicit_speed()) s.applied = applied_.data();
  return s;
}

void Sweep::advance(const Tile& t, std::size_t count) {
  const std::size_t last = own + t.width;
  forces_.contact_coefficients(t.offset, pad, whole_vectors(last + halo), coefficients_.data());
  StepOfU measured = step(t);
  for (std::size_t i = 0; i < count; ++i) {
    prefetch(t, i, count);
    LevelSites s = sites_at(t, count - 1 - i);
    s.ahead = static_cast<long>(i);
    take_turns(measured);
    s.step = i == 0 ? first_step(t, s, measured) : measured;
    forces_.begin_level(t.ends, s, slab_.outflow);
    if (i > 0) finish_step(t, s);
    forces_.add_load_and_friction(t.ends, s);
    if (s.next == before_) {
      std::swap(before_, now_);
    } else {
      spare_ = std::exchange(before_, std::exchange(now_, spare_));
    }
  }
  last_step(t, count);
}

void Sweep::advance_phases(const Tile& t, std::size_t count) {
  const std::size_t last = own + t.width;
  phases_->load(before_, now_, {pad, last + halo}, {own, last});
  for (std::size_t i = 0; i < count; ++i) {
    prefetch(t, i, count);
    const LevelSites s = sites_at(t, count - 1 - i);
    StepOfU measured = step(t);
    if (i == 0 && measured.what != Measured::nothing) measured.what = Measured::steps;  // it was measured before
    phases_->advance(t.ends, {s.left, s.right}, measured);
  }
  phases_->finish(before_, now_, step(t));
}

/// The measure of the first loop for the steps of a tile.
StepOfU Sweep::step(const Tile& t) {
  if (meter_.of_each_step() == Measured::nothing) return {};
  const std::size_t first = slab_.begin() + t.from;
  StepOfU step = meter_.step(first, first + t.width, own);
  step.eps = forces_.eps();
  step.u = u_.data();
  return step;
}

/// The step before moves to the array of that before it.
void Sweep::take_turns(StepOfU& step) {
  std::swap(D_, D_before_);
  step.D = D_;
  step.D_before = D_before_;
}

/// Lets the first loop of a sweep keep u and the step before, which it does not measure again.
StepOfU Sweep::first_step(const Tile& t, const LevelSites& s, StepOfU measured) {
  const std::size_t end = whole_vectors(own + t.width);
  if (measured.what == Measured::squares || meter_.needs_step_before())
    forces_.displacements(s.coefficients, before_, u_.data(), own, end);
  if (measured.what != Measured::nothing) measured.what = Measured::steps;
  return measured;
}

/// Measures the work of the step to this level, and then advances the state variables by it.
void Sweep::finish_step(const Tile& t, const LevelSites& s) {
  if (meter_.of_each_step() != Measured::nothing) {
    const std::size_t first = slab_.begin() + t.from;
    meter_.add(forces_, first, first + t.width,
               {.D = D_ + own,
                .D_before = D_before_ + own,
                .u = u_.data() + own,
                .ahead = s.ahead,
                .applied = applied_.data() + own,
                .states = s.states.from(own),
                .scratch = y_.data() + own});
  }
  if (forces_.ages() && !forces_.contacts().acts())
    forces_.age(t.offset + static_cast<long>(s.left), s.right - s.left, s.before + s.left, s.now + s.left,
                columns(s.left));
}

/// Finishes the step to the last level. Contacts that change must be advanced first, because the displacement at the
/// next level depends on them. Friction has acted already.
void Sweep::last_step(const Tile& t, std::size_t count) {
  const std::size_t last = own + t.width;
  LevelSites s = sites_at(t, 0);
  s.ahead = static_cast<long>(count);
  if (forces_.contacts().acts()) {
    forces_.age(t.offset + static_cast<long>(own), t.width, before_ + own, now_ + own, columns(own));
    forces_.next_coefficients(t.offset, own, whole_vectors(last), coefficients_.data());
  }
  if (meter_.of_each_step() != Measured::nothing) {
    s.next = spare_;
    s.step = step(t);
    take_turns(s.step);
    forces_.local_part(s, own, whole_vectors(last));
  }
  finish_step(t, s);
}

}  // namespace slipfront::chain
