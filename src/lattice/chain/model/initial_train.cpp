#include "lattice/chain/model/initial_train.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "lattice/chain/model/blocks.hpp"
#include "math/constants.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::chain {

double barrier_force(double spacing) {
  constexpr double pi = std::numbers::pi;
  return 40 * pi / (spacing * spacing) * std::exp(-pi * pi / spacing);
}

double spacing_with_barrier_below(double force, double spacing) {
  double hundredths = std::floor(100 * spacing);
  while (hundredths > 1 && barrier_force(hundredths / 100) > force) --hundredths;
  return hundredths / 100;
}

namespace {

using std::numbers::pi;
using Stress = std::function<double(double)>;

double checked(const Stress& stress, double x) {
  const double k = stress(x);
  if (!(k >= 0) || !std::isfinite(k))
    throw InputError({.key = "initial stress at x = " + digits(x),
                      .value = digits(k),
                      .problem = "not a stress",
                      .allowed = "0 or greater, finite"});
  return k;
}

/// Integral of the stress over [a, b] by the Gauss-Legendre rule with three points. If the stress jumps or bends, we
/// halve the interval.
double integral(const Stress& stress, double a, double b, int depth = 0) {
  const double middle = (a + b) / 2, half = (b - a) / 2, node = std::sqrt(0.6) * half;
  const double f0 = checked(stress, middle - node), f1 = checked(stress, middle), f2 = checked(stress, middle + node);
  if (depth < 40 && std::fabs(f0 - 2 * f1 + f2) > 1e-3 * (f0 + f2))
    return integral(stress, a, middle, depth + 1) + integral(stress, middle, b, depth + 1);
  return half * (5 * f0 + 8 * f1 + 5 * f2) / 9;
}

}  // namespace

/// u of the train with stress k, in local units (stress / a), at the phase theta: Eq. 4 with beta x = K theta / pi. The
/// phase is 0 at the centre of a dislocation and grows by 2 pi from one to the next.
class LocalTrain {
 public:
  double operator()(double k, double theta) {
    if (k != stress_) {
      at_ = elliptic::at_psi(train::psi_of_stress(k));
      stress_ = k;
    }
    const double turn = std::nearbyint(theta / (2 * pi));  // reduced separately, so that whole periods are exact
    return 2 * elliptic::jacobi(at_.K * (theta / pi - 2 * turn), at_).coamplitude - 2 * pi * turn;
  }

 private:
  double stress_ = -1;
  elliptic::AtPsi at_{};
};

void StaticTrain::Charge::add(double more) {
  const double corrected = more - lost, next = sum + corrected;
  lost = (next - sum) - corrected;
  sum = next;
}

StaticTrain::StaticTrain(Stress stress, const Grid& grid, bool whole, std::function<double(double)> contact)
    : contact_(std::move(contact)), grid_(grid), whole_(whole) {
  stress_ = [given = std::move(stress), a = contact_](double x) {
    const double k = given(x);
    return k > 0 && k < train::smallest_stress * (a ? a(x) : 1.0) ? 0.0 : k;
  };
  const std::size_t n = grid_.sites;
  Charge charge;
  double last_stress = 0, hardest_jump = 0.1;  // relative jump of the stress; smaller jumps do not count
  for (std::size_t j = 0; j < n; ++j) {
    const double before = charge.sum;
    if (j > 0) charge.add(integral(stress_, grid_.x(j - 1), grid_.x(j)) / (2 * pi));
    if (j % piece == 0) charges_.push_back(charge);
    const double k = checked(stress_, grid_.x(j)), jump = std::fabs(k - last_stress) / std::fmax(k, last_stress);
    if (j > 0 && k > 0 && last_stress > 0 && jump > hardest_jump) {
      hardest_jump = jump;
      jump_at_ = (before + charge.sum) / 2;
    }
    last_stress = k;
    const bool empty = k == 0;
    if (j > 0 && segments_.back().empty == empty) continue;
    if (j > 0) {
      segments_.back().end = j;
      segments_.back().to = charge.sum;
    }
    segments_.push_back({.begin = j, .empty = empty, .from = before});
  }
  if (n == 0) return;
  // Around a periodic chain there is one more interval, from the last site to the first.
  segments_.back().end = n;
  segments_.back().to = whole_ ? charge.sum + integral(stress_, grid_.x(n - 1), grid_.x(n)) / (2 * pi) : charge.sum;
  double wells = 0;
  for (auto s = segments_.rbegin(); s != segments_.rend(); ++s) {
    s->wells = wells;
    if (!s->empty) wells += std::nearbyint(s->to - s->from);
  }
}

double StaticTrain::u(const Segment& s, std::size_t site, double charge, LocalTrain& train) const {
  const bool closed = (s.begin > 0 && s.end < grid_.sites) || whole_;
  const double charge_of_it = s.to - s.from, count = closed ? std::nearbyint(charge_of_it) : charge_of_it;
  if (s.empty || (closed && count == 0)) return 2 * pi * s.wells;
  const double factor = closed ? count / charge_of_it : 1;
  // The last dislocation is half a spacing from the right edge. If only the left side is empty, the first dislocation
  // is half a spacing from the left edge instead.
  const bool from_left = s.begin > 0 && s.end == grid_.sites && !whole_;
  const bool stressed_throughout = s.begin == 0 && s.end == grid_.sites && !whole_;
  const double anchor = stressed_throughout && jump_at_ ? *jump_at_ : s.to;
  const double turns = from_left ? charge - s.from - 0.5 : (charge - anchor) * factor + 0.5;
  const double right = from_left ? s.wells + std::nearbyint(count) - 1 : s.wells;
  const double x = grid_.x(site), local = stress_(x) / (contact_ ? contact_(x) : 1.0);
  return train(local * factor, 2 * pi * turns) + 2 * pi * right;
}

Motion StaticTrain::operator()(std::size_t begin, std::size_t end) const {
  Motion motion;
  LocalTrain train;
  auto segment = std::upper_bound(segments_.begin(), segments_.end(), begin,
                                  [](std::size_t j, const Segment& s) { return j < s.end; });
  Charge charge;
  for (std::size_t j = begin / piece * piece; j < end; ++j) {
    if (j % piece == 0)
      charge = charges_[j / piece];
    else
      charge.add(integral(stress_, grid_.x(j - 1), grid_.x(j)) / (2 * pi));
    if (j < begin) continue;
    if (j == segment->end) ++segment;
    motion.u.push_back(u(*segment, j, charge.sum, train));
  }
  return motion;
}

Motion static_train(const Stress& stress, const Grid& grid, bool whole, const std::function<double(double)>& contact) {
  return StaticTrain(stress, grid, whole, contact)(0, grid.sites);
}

namespace {

[[noreturn]] void refuse_size(std::size_t size, const std::string& allowed) {
  throw InputError({.key = "initial motion",
                    .value = std::to_string(size) + " sites",
                    .problem = "does not fit the grid",
                    .allowed = allowed + " sites"});
}

std::vector<double> part(const std::vector<double>& all, std::size_t begin, std::size_t end) {
  const auto at = [&](std::size_t j) { return all.begin() + static_cast<std::ptrdiff_t>(j); };
  return {at(begin), at(end)};
}

}  // namespace

Motion sites_of(const MotionOf& start, const Problem& p, std::size_t begin, std::size_t end) {
  Motion m = start(begin, end);
  const std::size_t size = end - begin;
  if (m.u.size() != size || (!m.velocity.empty() && m.velocity.size() != size))
    refuse_size(m.u.size(), std::to_string(size) + " of " + std::to_string(p.grid.sites));
  return m;
}

MotionOf pieces_of(const Motion& start, std::size_t sites) {
  return [&start, sites](std::size_t begin, std::size_t end) -> Motion {
    if (start.u.size() != sites || (!start.velocity.empty() && start.velocity.size() != sites))
      refuse_size(start.u.size(), std::to_string(sites));
    if (start.velocity.empty()) return {part(start.u, begin, end), {}};
    return {part(start.u, begin, end), part(start.velocity, begin, end)};
  };
}

void check_ranks(const Problem& p, const Ranks& ranks) {
  const Blocks blocks{p.grid.sites};
  if (static_cast<std::size_t>(ranks.size()) > blocks.count)
    throw InputError({.key = "ranks",
                      .value = std::to_string(ranks.size()),
                      .problem = "too many for " + std::to_string(p.grid.sites) + " sites",
                      .allowed = "1 to " + std::to_string(blocks.count)});
}

void StartCheck::look(const Problem& p, const Motion& m, std::size_t first) {
  for (std::size_t j = 0; j < m.u.size(); ++j) {
    if (!std::isfinite(m.u[j]) || (!m.velocity.empty() && !std::isfinite(m.velocity[j])))
      throw InputError({.key = "initial motion at x = " + digits(p.grid.x(first + j)),
                        .problem = "not a number",
                        .allowed = "finite displacement and velocity"});
    const double rise = j == 0 ? 0 : std::fabs(m.u[j] - m.u[j - 1]);
    if (rise > steepest_) {
      steepest_ = rise;
      at_ = p.grid.x(first + j);
    }
  }
}

void StartCheck::finish(const Problem& p, const Ranks& ranks) const {
  const std::vector<double> all = ranks.joined({steepest_, at_});
  double steepest = 0, at = 0;
  for (std::size_t r = 0; r < all.size(); r += 2) {
    if (!(all[r] > steepest)) continue;
    steepest = all[r];
    at = all[r + 1];
  }
  // A dislocation in a train has the greatest slope 2 beta, beta its inverse width.
  if (!p.substrate || p.model != Model::sine_gordon || !(steepest > 2 / least_sites_per_width)) return;
  ranks.together([&] {
    throw InputError(
        {.key = "spacing",
         .value = digits(p.grid.spacing),
         .problem = "too coarse: " + digits(2 / steepest) + " sites to the width of the dislocation at x = " +
                    digits(at) + ", " + digits(least_sites_per_width) + " are needed",
         .allowed = "about " + digits(p.grid.spacing * 2 / (least_sites_per_width * steepest)) + " or less"});
  });
}

void check_charge(const Problem& p, const MotionOf& start) {
  if (!p.boundary.periodic) return;
  const std::size_t n = p.grid.sites;
  const Motion first = sites_of(start, p, 0, 1), last = sites_of(start, p, n - 2, n);
  const double fits = (first.u[0] - (2 * last.u[1] - last.u[0])) / turn;
  if (std::fabs(fits - static_cast<double>(p.boundary.charge)) > 0.25)
    throw InputError({.key = "charge",
                      .value = std::to_string(p.boundary.charge),
                      .problem = "does not fit the initial state, which falls by " + digits(fits) + " turns",
                      .allowed = "the whole number of dislocations between the ends"});
}

}  // namespace slipfront::chain
