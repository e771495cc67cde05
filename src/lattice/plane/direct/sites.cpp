#include "lattice/plane/direct/sites.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "lattice/plane/direct/rows.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::plane {

std::vector<char> patch_of(const Problem& p, const Sites& sites) {
  if (!p.nucleation) return {};
  std::vector<char> patch(sites.size(), 0);
  const Nucleation& n = *p.nucleation;
  sites.for_each_in_reach(
      [&](std::size_t at, double x, double y) { patch[at] = std::hypot(x - n.x, y - n.y) <= n.radius ? 1 : 0; });
  return patch;
}

Loads::Loads(const Problem& problem, const Sites& sites)
    : problem_(problem), sites_(sites), patch_(patch_of(problem, sites)) {}

void Loads::hold(const std::vector<double>& acceleration) {
  held_.assign(sites_.size(), 0);
  for (std::size_t i = 0; i < held_.size(); ++i) held_[i] = -acceleration[i];
  is_known_ = false;
}

void Loads::find(double time) {
  const bool released = problem_.nucleation_has_begun(time);
  if (is_known_ && released == released_ && (!problem_.forcing || problem_.steady_forcing)) return;
  is_known_ = true;
  released_ = released;
  force_ = held_;
  if (!force_.empty() && released)
    for (std::size_t at = 0; at < force_.size(); ++at)
      if (patch_[at] != 0) force_[at] = 0;
  if (!problem_.forcing) return;
  force_.resize(sites_.size());
  sites_.for_each_in_reach(
      [&](std::size_t at, double x, double y) { force_[at] += problem_.forcing(x, y, time) / sites_.scale; });
}

SiteFriction::SiteFriction(const Problem& problem, const Sites& sites, double dt)
    : problem_(problem), sites_(sites), dt_(dt) {
  if (!is_viscous() && problem.friction.acts()) friction_ = problem.friction.scaled_by(sites.scale);
  each_ = friction_.state_size();
  if (friction_.steep_at_rest()) patch_ = patch_of(problem, sites);
  states_.resize(each_ * sites.nx * sites.ny);
  for (std::size_t site = 0; each_ > 0 && site < sites.nx * sites.ny; ++site)
    friction_.start(sites.scale * sites.x(site % sites.nx), sites.scale * sites.y(site / sites.nx),
                    std::span(states_).subspan(each_ * site, each_));
}

FrictionWork SiteFriction::slow(const RowPart& part, bool began, const Rates& rates, const double* before,
                                double* after) const {
  FrictionWork work;
  if (problem_.edges == Edges::absorbing) work.radiated = absorb(part, before, after);
  if (is_viscous())
    work.dissipated =
        rub_viscous(part.size, dt_, &sites_.viscous[sites_.at(part.begin, part.row)], rates, before, after);
  else if (friction_.acts())
    work.dissipated = rub_by_law(part, began, before, after);
  return work;
}

/// A wave that meets an edge at a right angle leaves if the stress there is -u_t, in the unit of u_x. The site next to
/// the edge, of the width h, is slowed by u_t / h.
double SiteFriction::absorb(const RowPart& part, const double* before, double* after) const {
  double work = 0;
  const auto slow_site = [&](std::size_t i, double rate) {
    after[i] = before[i] + (after[i] - before[i]) / (1 + 0.5 * dt_ * rate);
    const double velocity = (after[i] - before[i]) / (2 * dt_);
    work += rate * velocity * velocity * dt_;
  };
  const double by_row = sites_.on_edge(static_cast<std::ptrdiff_t>(part.row)) ? 1 / sites_.hy : 0;
  const std::size_t last = part.begin + part.size - 1;
  for (std::size_t i = part.begin; i <= last; ++i) {
    const bool at_end = i == 0 || i + 1 == sites_.nx;
    if (by_row == 0 && !at_end) i = std::max(i, std::min(last, sites_.nx - 2));  // the next is the last, or none
    if (by_row != 0 || at_end) slow_site(i - part.begin, by_row + (at_end ? 1 / sites_.hx : 0));
  }
  return work;
}

double SiteFriction::rub_by_law(const RowPart& part, bool began, const double* before, double* after) const {
  const char* const patch = began && !patch_.empty() ? &patch_[sites_.at(part.begin, part.row)] : nullptr;
  std::array<double, RowPart::most> free, force;
  if (patch != nullptr) std::copy_n(after, part.size, free.data());
  friction_.loops().slow_steps(part.size, {0.5 / dt_, before, after}, nullptr, dt_ / 2, states_of(part.row, part.begin),
                               force.data());
  for (std::size_t i = 0; patch != nullptr && i < part.size; ++i) {
    if (patch[i] == 0) continue;  // nothing holds the patch
    after[i] = free[i];
    force[i] = 0;
  }
  return work_of(part.size, force.data(), before, after);
}

void SiteFriction::age(std::size_t j, const double* now, const double* after) {
  if (!friction_.state_evolves()) return;
  std::vector<double> speed(sites_.nx);
  for (std::size_t i = 0; i < sites_.nx; ++i) speed[i] = std::fabs(after[i] - now[i]) / dt_;
  friction_.evolution().advance_all(sites_.nx, friction::Slips::at(speed.data()), dt_,
                                    {states_.data() + j * sites_.nx * each_, each_});
}

void SiteFriction::resist(std::size_t j, bool began, double* acceleration) const {
  if (!friction_.sticks()) return;
  const char* const patch = began && !patch_.empty() ? &patch_[sites_.at(0, j)] : nullptr;
  for (std::size_t i = 0; i < sites_.nx; ++i) {
    if (patch && patch[i] != 0) continue;
    const double strength = friction_.law().strength(0, states_of(j, i).at(0));
    acceleration[i] = std::copysign(std::fmax(std::fabs(acceleration[i]) - strength, 0), acceleration[i]);
  }
}

namespace {

constexpr double most_sites = 1e10;

InputError refusal(const char* key, double value, const char* problem, const char* allowed) {
  return InputError({.key = key, .value = digits(value), .problem = problem, .allowed = allowed});
}

/// The largest contact ratio on a grid of samples.
double largest_contact(const Problem& p) {
  if (!p.contact) return 1;
  constexpr int samples = 200;
  double largest = 0;
  for (int j = 0; j <= samples; ++j)
    for (int i = 0; i <= samples; ++i)
      largest = std::fmax(
          largest, p.contact(p.left + (p.right - p.left) * i / samples, p.bottom + (p.top - p.bottom) * j / samples));
  return largest;
}

template <class Value>
std::vector<double> at_each(const Sites& sites, const Value& value) {
  std::vector<double> all(sites.size(), 0.0);
  sites.for_each_in_reach([&](std::size_t at, double x, double y) { all[at] = value(x, y); });
  return all;
}

void fix_edges(Sites& sites) {
  if (sites.moves.empty()) sites.moves = at_each(sites, [](double, double) { return 1.0; });
  const auto ghosts = static_cast<std::ptrdiff_t>(Sites::ghost_rows), rows = static_cast<std::ptrdiff_t>(sites.ny);
  for (std::ptrdiff_t row = -ghosts; row < rows + ghosts; ++row) {
    double* const moves = &sites.moves[sites.start_of(row)];
    if (sites.on_edge(row)) std::fill_n(moves, sites.nx, 0.0);
    moves[0] = moves[sites.nx - 1] = 0;
  }
}

/// Finds what acts on each site.
void fill(const Problem& p, Sites& sites) {
  if (p.contact)
    sites.contact2 = at_each(sites, [&](double x, double y) {
      const double a = p.contact(x, y);
      return a * a;
    });
  if (p.friction.is_viscous())
    sites.viscous =
        at_each(sites, [&](double x, double y) { return *p.friction.linear_coefficient(x, y) / sites.scale; });
  if (p.fixed) sites.moves = at_each(sites, [&](double x, double y) { return p.fixed(x, y) == 0 ? 1.0 : 0.0; });
  if (p.edges == Edges::fixed) fix_edges(sites);
}

/// The first row of a band.
std::size_t first_of(int number, int bands, std::size_t rows) {
  return rows * static_cast<std::size_t>(number) / static_cast<std::size_t>(bands);
}

}  // namespace

Counts count_sites(const Problem& p, double scale, double spacing) {
  assert(scale > 0 && std::isfinite(scale));
  if (!(spacing > 0 && spacing <= 0.5)) throw refusal("spacing", spacing, "out of range", "> 0 and <= 0.5");
  const double widest = spacing / largest_contact(p);
  const Counts n{std::ceil((p.right - p.left) * scale / widest), std::ceil((p.top - p.bottom) * scale / widest)};
  if (!(n.nx >= 4 && n.ny >= 4)) throw refusal("scale", scale, "fewer than 4 x 4 sites", "a larger scale");
  if (!(n.nx * n.ny <= most_sites)) throw refusal("scale", scale, "more than ten billion sites", "a smaller scale");
  return n;
}

Sites make_sites(const Problem& p, double scale, double spacing, Band band) {
  const auto [nx, ny] = count_sites(p, scale, spacing);
  Sites sites;
  sites.nx = static_cast<std::size_t>(nx);
  sites.all_rows = static_cast<std::size_t>(ny);
  if (!(sites.all_rows >= Sites::ghost_rows * static_cast<std::size_t>(band.bands)))
    throw refusal("ranks", band.bands, "too many for so few rows of sites", "a rank for each four rows, or fewer");
  sites.first_row = first_of(band.number, band.bands, sites.all_rows);
  sites.ny = first_of(band.number + 1, band.bands, sites.all_rows) - sites.first_row;
  sites.scale = scale;
  sites.left = p.left;
  sites.bottom = p.bottom;
  sites.hx = (p.right - p.left) * scale / nx;
  sites.hy = (p.top - p.bottom) * scale / ny;
  fill(p, sites);
  return sites;
}

Sites widened(const Problem& p, const Sites& sites, std::size_t rows) {
  Sites wide = sites;
  wide.first_row -= std::min(rows, sites.first_row);
  wide.ny = std::min(sites.first_row + sites.ny + rows, sites.all_rows) - wide.first_row;
  fill(p, wide);
  return wide;
}

namespace {

using std::numbers::pi;

/// A line crosses the edge from a site to the next one along x, or along y.
struct Crossing {
  std::size_t site;
  bool along_y;
  int number;  ///< number of the line

  bool operator==(const Crossing&) const = default;
};

struct Hash {
  std::size_t operator()(const Crossing& c) const {
    const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(c.number));
    const std::uint64_t mixed = (static_cast<std::uint64_t>(c.site) * 2 + (c.along_y ? 1 : 0)) ^ (number << 44);
    return static_cast<std::size_t>(mixed * 0x9e3779b97f4a7c15u >> 7);
  }
};

/// Crossings in the order in which they were found, each joined to at most two others.
class Contours {
 public:
  Contours(const std::vector<double>& u, const Sites& sites, int crossings_a_point)
      : u_(u), sites_(sites), crossings_a_point_(crossings_a_point) {
    for (std::size_t j = 0; j + 1 < sites.ny; ++j)
      for (std::size_t i = 0; i + 1 < sites.nx; ++i) add_square(sites.at(i, j));
  }

  /// Lines that end at an edge come before those that are closed.
  std::vector<Line> lines() {
    std::vector<Line> all;
    for (std::size_t start = 0; start < nodes_.size(); ++start)
      if (!nodes_[start].used && nodes_[start].next[1] == none) all.push_back(follow(start));
    for (std::size_t start = 0; start < nodes_.size(); ++start)
      if (!nodes_[start].used) {
        all.push_back(follow(start));
        all.back().points.push_back(all.back().points.front());
      }
    return all;
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Node {
    Crossing at;
    std::array<std::size_t, 2> next{none, none};
    bool used = false;
  };

  /// Lines are where this is a whole number.
  double turns(std::size_t site) const { return u_[site] / (2 * pi) + 0.5; }

  std::size_t node(const Crossing& at) {
    const auto [found, is_new] = index_.try_emplace(at, nodes_.size());
    if (is_new) nodes_.push_back({at});
    return found->second;
  }
  void join(const Crossing& a, const Crossing& b) {
    const std::size_t i = node(a), j = node(b);
    for (const auto& [from, to] : {std::pair{i, j}, {j, i}}) {
      std::array<std::size_t, 2>& next = nodes_[from].next;
      (next[0] == none ? next[0] : next[1]) = to;
    }
  }

  /// Joins the crossings of the square whose lowest left site is `site`, around it: two, or four at a saddle, where the
  /// mean of the corners decides.
  void add_square(std::size_t site) {
    const std::size_t n = sites_.stride();
    const std::array<double, 4> corner{turns(site), turns(site + 1), turns(site + n + 1), turns(site + n)};
    const auto [lowest, highest] = std::minmax_element(corner.begin(), corner.end());
    if (!(std::fabs(*lowest) < 1e8 && *highest - *lowest < 1e6))
      return;  // not a displacement: the run ends with an error
    const std::array<std::pair<std::size_t, bool>, 4> edges{
        {{site, false}, {site + 1, true}, {site + n, false}, {site, true}}};
    for (int number = static_cast<int>(std::floor(*lowest)) + 1; number <= *highest; ++number) {
      std::array<Crossing, 4> found{};
      std::size_t count = 0;
      for (std::size_t e = 0; e < 4; ++e)
        if ((corner[e] < number) != (corner[(e + 1) % 4] < number))
          found[count++] = {edges[e].first, edges[e].second, number};
      if (count == 2) join(found[0], found[1]);
      if (count < 4) continue;
      const double middle = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
      const bool around_first = (middle < number) != (corner[0] < number);  // the first corner is alone
      join(found[0], found[around_first ? 3 : 1]);
      join(found[2], found[around_first ? 1 : 3]);
    }
  }

  Point point(const Crossing& c) const {
    const std::size_t other = c.site + (c.along_y ? sites_.stride() : 1);
    const double from = turns(c.site), part = (c.number - from) / (turns(other) - from);
    const std::size_t column = c.site % sites_.stride(), row = c.site / sites_.stride();
    const auto i = static_cast<double>(column - Sites::ghosts), j = static_cast<double>(row - Sites::ghost_rows);
    return {sites_.left + (i + 0.5 + (c.along_y ? 0 : part)) * sites_.hx / sites_.scale,
            sites_.bottom + (j + 0.5 + (c.along_y ? part : 0)) * sites_.hy / sites_.scale};
  }

  /// The line from `start` on, to its other end or around.
  Line follow(std::size_t start) {
    Line line{.number = nodes_[start].at.number, .points = {}};
    std::size_t at = start, last = start;
    int passed = 0;
    for (; at != none && !nodes_[at].used; ++passed) {
      Node& here = nodes_[at];
      here.used = true;
      if (passed % crossings_a_point_ == 0) line.points.push_back(point(here.at));
      last = at;
      at = here.next[0] != none && !nodes_[here.next[0]].used ? here.next[0] : here.next[1];
    }
    const bool is_open = nodes_[start].next[1] == none, has_last = (passed - 1) % crossings_a_point_ == 0;
    if (is_open && !has_last) line.points.push_back(point(nodes_[last].at));
    return line;
  }

  const std::vector<double>& u_;
  const Sites& sites_;
  int crossings_a_point_;
  std::vector<Node> nodes_;
  std::unordered_map<Crossing, std::size_t, Hash> index_;
};

}  // namespace

std::vector<Line> lines_of(const std::vector<double>& u, const Sites& sites, int crossings_a_point) {
  return Contours(u, sites, crossings_a_point).lines();
}

namespace {

using std::numbers::pi;

/// A held site takes the density of a site so many rows away.
constexpr int passes = 4;
/// The start of a row depends on so many rows on each side: those of the density, and one more for its slope.
constexpr std::size_t reach = passes + 1;

/// The mean slip, stretched, at each site.
std::vector<double> mean_slip(const Problem& problem, const Sites& sites) {
  std::vector<double> mean(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const double x = sites.x(i), y = sites.y(j), slip = problem.slip(x, y);
      if (!(slip >= 0 && std::isfinite(slip)))
        throw InputError({.key = "slip",
                          .value = digits(slip),
                          .problem = "not a slip at x = " + digits(x, 4) + ", y = " + digits(y, 4),
                          .allowed = "a finite number >= 0"});
      mean[sites.at(i, j)] = sites.scale * slip;
    }
  return mean;
}

/// A difference over one or two spacings, that of the two sites which falls more steeply, so that the slip next to a
/// plateau or to the edge of the rupture keeps its slope.
double slope(double before, double here, double after, double h) {
  const double a = (here - before) / h, b = (after - here) / h;
  const bool even = std::fabs(a - b) < 0.2 * std::fmax(std::fabs(a), std::fabs(b));
  return even ? (a + b) / 2 : std::fabs(a) > std::fabs(b) ? a : b;
}

/// The density of lines at each site: the gradient of the mean slip.
std::vector<double> densities(const std::vector<double>& mean, const Sites& sites) {
  std::vector<double> density(sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = sites.at(i, j), n = sites.stride();
      const double west = i > 0 ? mean[c - 1] : mean[c], east = i + 1 < sites.nx ? mean[c + 1] : mean[c];
      const double south = j > 0 ? mean[c - n] : mean[c], north = j + 1 < sites.ny ? mean[c + n] : mean[c];
      density[c] = std::hypot(slope(west, mean[c], east, sites.hx), slope(south, mean[c], north, sites.hy));
    }
  return density;
}

/// Gives held sites next to the lines the density of these lines, because the slip of a held region has no slope, or
/// only a part of it next to the edge.
void extend_into_held(const Sites& sites, std::vector<double>& density) {
  if (sites.moves.empty()) return;
  const std::size_t n = sites.stride();
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = sites.at(i, j);
      if (sites.moves[c] != 0) continue;
      double next_to_it = 0;
      for (const std::size_t other : {c - 1, c + 1, c - n, c + n})
        next_to_it = std::fmax(next_to_it, density[other] * sites.moves[other]);
      if (next_to_it > 0) density[c] = next_to_it;
    }
  for (int pass = 1; pass < passes; ++pass) {
    const std::vector<double> before = density;
    for (std::size_t j = 0; j < sites.ny; ++j)
      for (std::size_t i = 0; i < sites.nx; ++i)
        if (const std::size_t c = sites.at(i, j); sites.moves[c] == 0 && before[c] == 0)
          density[c] = std::max({before[c - 1], before[c + 1], before[c - n], before[c + n]});
  }
}

/// u of the train with the density `k`, in local units, whose mean is `mean`. Lines are at odd multiples of pi.
double train_of(double k, double mean) {
  const double wells = std::floor(mean / (2 * pi)), phase = mean - 2 * pi * wells;
  if (k < train::smallest_stress) return 2 * pi * (phase < pi ? wells : wells + 1);
  const elliptic::AtPsi at = elliptic::at_psi(train::psi_of_stress(k));
  return 2 * pi * wells + 2 * elliptic::jacobi(at.K * (1 - phase / pi), at).coamplitude;
}

/// The start of the rows of `sites`, a part of the rows of `wide`.
Start in_band(const Problem& problem, const Sites& wide, const Sites& sites) {
  const std::vector<double> mean = mean_slip(problem, wide);
  std::vector<double> density = densities(mean, wide);
  extend_into_held(wide, density);
  Start start{.u = std::vector<double>(sites.size(), 0.0)};
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t c = wide.at(i, j + sites.first_row - wide.first_row);
      const double k = density[c] / (wide.contact2.empty() ? 1 : std::sqrt(wide.contact2[c]));
      start.u[sites.at(i, j)] = train_of(k, mean[c]);
      start.largest_density = std::fmax(start.largest_density, k);
    }
  return start;
}

}  // namespace

Start lines_at_rest(const Problem& problem, const Sites& sites) {
  if (sites.has_bottom() && sites.has_top()) return in_band(problem, sites, sites);
  return in_band(problem, widened(problem, sites, reach), sites);
}

}  // namespace slipfront::plane
