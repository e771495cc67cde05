#include "lattice/chain/implicit/watched_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipfront::chain {
namespace {

constexpr std::size_t sums = 3;

std::size_t count_of_parts(const Problem& p, const std::vector<double>& ends) {
  const double turns = std::fabs(ends.front() - ends.back()) / (2 * std::numbers::pi);
  const double dislocations = std::max(turns, std::fabs(static_cast<double>(p.boundary.charge)));
  const double length = static_cast<double>(p.grid.sites) * p.grid.spacing;
  const double wanted = !p.substrate        ? static_cast<double>(p.grid.sites) / 8
                        : dislocations >= 8 ? dislocations / 8
                                            : length / 60;
  return static_cast<std::size_t>(std::clamp(wanted, 1.0, 64.0));
}

/// The mean stiffness of the springs of each part.
std::vector<double> stiffness_of_parts(const Problem& p, std::size_t count) {
  std::vector<double> means(count, p.loading.stiffness);
  if (!p.loading.stiffness_at) return means;
  const Blocks blocks{p.grid.sites};
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    const std::size_t begin = blocks.part_begin(i, count), end = blocks.part_begin(i + 1, count);
    for (std::size_t j = begin; j < end; ++j) sum += p.loading.stiffness_at(p.grid.x(j));
    means[i] = sum / static_cast<double>(end - begin);
  }
  return means;
}

}  // namespace

std::vector<double> middles_of_parts(const Problem& p, std::size_t count) {
  const Blocks blocks{p.grid.sites};
  std::vector<double> x;
  for (std::size_t i = 0; i < count; ++i)
    x.push_back((p.grid.x(blocks.part_begin(i, count)) + p.grid.x(blocks.part_begin(i + 1, count) - 1)) / 2);
  return x;
}

WatchedParts::WatchedParts(const SiteForces& forces, const ChainState& now)
    : forces_(forces), direction_(forces.problem().loading.velocity < 0 ? -1 : 1), first_(0) {
  const Problem& p = forces.problem();
  const OwnBlocks& own = forces.own();
  const std::size_t count = count_of_parts(p, forces.ranks().joined({now.u.front(), now.u.back()}));
  const std::size_t intervals = p.boundary.periodic ? p.grid.sites : p.grid.sites - 1;
  parts_.length = static_cast<double>(intervals) * p.grid.spacing / static_cast<double>(count);
  parts_.ring = p.boundary.periodic;
  if (p.loading.where == Pulled::everywhere) parts_.stiffness = stiffness_of_parts(p, count);
  for (auto* column : {&parts_.u, &parts_.velocity}) column->resize(count);
  parts_.x = middles_of_parts(p, count);
  own.blocks.each_piece(count, [&](std::size_t part, std::size_t begin, std::size_t end) {
    if (begin < own.begin) ++first_;
    if (begin >= own.begin && begin < own.end) ++count_;
    pieces_.push_back({part, begin, end});
  });
  mine_.resize(sums * count_);
  all_.resize(sums * pieces_.size());
}

void WatchedParts::add_up(const ChainState& m) {
  const CompactSprings& springs = forces_.springs();
  const Pulled where = forces_.problem().loading.where;
  const std::size_t offset = forces_.own().begin;
  for (std::size_t i = 0; i < count_; ++i) {
    const Piece& piece = pieces_[first_ + i];
    double u = 0, w = 0, load = 0;
    for (std::size_t j = piece.begin - offset; j < piece.end - offset; ++j) {
      u += direction_ * m.u[j];
      w += direction_ * m.w[j];
      if (where == Pulled::everywhere || forces_.pull(j) > 0) load += springs.weight(j) * forces_.forcing(m, j);
    }
    double* const to = &mine_[sums * i];
    to[0] = u;
    to[1] = w;
    to[2] = load;
  }
  forces_.ranks().join(mine_, all_);
}

double WatchedParts::load_by_sums() const {
  const Problem& p = forces_.problem();
  if (!p.loading.acts()) return 0;
  double load = 0;
  for (std::size_t i = 0; i < pieces_.size(); ++i) load += all_[sums * i + 2];
  if (p.loading.where != Pulled::everywhere) return load;
  return load / (p.grid.spacing * static_cast<double>(p.boundary.periodic ? p.grid.sites : p.grid.sites - 1));
}

double WatchedParts::load(const ChainState& m) {
  if (!forces_.problem().loading.acts()) return 0;
  add_up(m);
  return load_by_sums();
}

void WatchedParts::look(ChainState& m) {
  add_up(m);
  std::fill(parts_.u.begin(), parts_.u.end(), 0.0);
  std::fill(parts_.velocity.begin(), parts_.velocity.end(), 0.0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    parts_.u[pieces_[i].part] += all_[sums * i];
    parts_.velocity[pieces_[i].part] += all_[sums * i + 1];
  }
  const std::size_t count = parts_.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto sites = static_cast<double>(forces_.own().blocks.part_size(i, count));
    parts_.u[i] /= sites;
    parts_.velocity[i] /= sites;
  }
  m.log.look(m.time, direction_ * load_by_sums(), parts_);
}

}  // namespace slipfront::chain
