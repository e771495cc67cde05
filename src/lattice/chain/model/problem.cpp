#include "slipfront/lattice/chain/problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lattice/chain/model/blocks.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/chain/chain.hpp"
#include "system/machine.hpp"
#include "system/ranks.hpp"

namespace slipfront::chain {
namespace {

[[noreturn]] void refuse(const char* key, double value, std::string problem, std::string allowed) {
  throw InputError({.key = key, .value = digits(value), .problem = std::move(problem), .allowed = std::move(allowed)});
}

/// Nothing changes the train outside an absorbing end.
void check_ends(const Problem& p) {
  const Boundary& ends = p.boundary;
  if (!p.friction.changes_contacts() || ends.periodic) return;
  for (const auto& [end, key] : {std::pair{ends.left, "left end"}, {ends.right, "right end"}})
    if (end == End::absorbing)
      throw InputError({.key = key,
                        .value = "absorbing",
                        .problem = "the train outside an absorbing end has contacts that do not change",
                        .allowed = "free or fixed, or friction without contact_ageing and dilatancy"});
}

void check_precision(const Problem& p) {
  if (!p.phases_of_32_bits) return;
  const friction::Friction& f = p.friction;
  const auto absorbs = [&](End end) { return !p.boundary.periodic && end == End::absorbing; };
  const char* const refused = p.implicit                                              ? "implicit steps"
                              : p.contact || f.changes_contacts()                     ? "a contact ratio"
                              : p.forcing                                             ? "forces"
                              : f.acts() && !f.linear_coefficient()                   ? "this friction"
                              : absorbs(p.boundary.left) || absorbs(p.boundary.right) ? "absorbing ends"
                                                                                      : nullptr;
  if (refused == nullptr) return;
  throw InputError({.key = "precision",
                    .value = "single",
                    .problem = std::string("not possible with ") + refused,
                    .allowed = "double; single is for explicit steps, a contact ratio of 1, no force, no friction or a "
                               "uniform viscous one, and ends that are fixed, free or periodic"});
}

/// The step at which the amplitude f of the shortest wave in x and t, (-1)^(site + level) f, obeys
///     f_tt - f_xx + ((a^2 - a^2 cos u) / 3 + mass^2) f = 0:
/// 4 / dt^2 = 4 / h^2 + a^2 / 3 + mass^2. It is pumped where cos u varies at twice its least frequency, mass, or more
/// (docs/chain.md).
double step_for(double h, double a, double mass2) { return 1 / std::sqrt(1 / (h * h) + a * a / 12 + mass2 / 4); }

double chosen(const Problem& p, double a) {
  const double h = p.grid.spacing;
  if (p.model == Model::sine_gordon) {
    const double crossing = p.crossing_stress > 0 ? a * a / 2 + 2 * a * p.crossing_stress : 0;
    return step_for(h, a, a * a / 2 + crossing);
  }
  return std::fmin(0.05, 0.9 * h / std::sqrt(1 + a * a * h * h / 4));
}

double largest(const Problem& p, double a) {
  const double h = p.grid.spacing;
  return p.model == Model::sine_gordon ? h * std::sqrt(1 - a * a * h * h / 12) : h / std::sqrt(1 + a * a * h * h / 4);
}

}  // namespace

double largest_contact(const Problem& p) {
  double most = 1;
  if (p.contact) {
    most = 0;
    for (std::size_t j = 0; j < p.grid.sites; ++j) {
      const double a = p.contact(p.grid.x(j));
      if (!(a > 0) || !std::isfinite(a))
        refuse("contact", a, "not a contact ratio at x = " + digits(p.grid.x(j)), "> 0, finite");
      most = std::fmax(most, a);
    }
  }
  return p.substrate ? most * p.friction.contact_growth(p.longest) : most;
}

double chosen_step(const Problem& p) { return p.step > 0 ? p.step : chosen(p, largest_contact(p)); }

double memory_needed(const Problem& p) {
  // Implicit steps store the motion at three times, a step that is tried, and a matrix. Explicit steps store two
  // levels, the initial displacement and the state of friction, and the contact. A steady force has its effect too, one
  // that changes its positions, sixteen times of a polynomial and up to eight terms. Contacts that change add the
  // pressure and six numbers each.
  const auto state = static_cast<double>(p.friction.state_size());
  const bool changes = p.friction.changes_contacts();
  const double by_implicit = 40 + 3 * state + (p.loading.stiffness_at ? 1 : 0) + (p.loading.velocity_at ? 1 : 0);
  const double by_explicit = 3 + state + (p.contact || changes ? 1 : 0) + (changes ? 7 : 0) +
                             (!p.forcing         ? 0
                              : p.steady_forcing ? 2
                                                 : 25);
  return static_cast<double>(p.grid.sites) * 8 * (p.implicit ? by_implicit : by_explicit);
}

double disk_needed(double sites) { return 2 * sizeof(double) * sites; }  // two time levels

void check(const Problem& p, double share_of_machine) {
  const double h = p.grid.spacing;
  if (!(h > 0) || !std::isfinite(h)) refuse("spacing", h, "out of range", "> 0, finite");
  if (!std::isfinite(p.grid.left)) refuse("left", p.grid.left, "out of range", "finite");
  if (p.grid.sites < 8) refuse("sites", static_cast<double>(p.grid.sites), "too few", ">= 8");
  check_ends(p);
  check_precision(p);
  const double need = memory_needed(p) * share_of_machine, have = usable_memory();
  if (need > have)
    refuse("sites", static_cast<double>(p.grid.sites),
           "a run needs " + digits(need / 1e9) + " GB, this process may have " + digits(have / 1e9) + " GB",
           "at most " + digits(have / need * static_cast<double>(p.grid.sites)) + " sites");
  if (!(p.crossing_stress >= 0) || !std::isfinite(p.crossing_stress))
    refuse("crossing_stress", p.crossing_stress, "out of range", ">= 0, finite");
  const double a = largest_contact(p), sites_per_width = 1 / (a * h);
  if (p.substrate && p.model == Model::sine_gordon && sites_per_width < least_sites_per_width)
    refuse("spacing", h,
           "too coarse: " + digits(sites_per_width) + " sites to the width of a dislocation, " +
               digits(least_sites_per_width) + " are needed",
           "at most " + digits(1 / (a * least_sites_per_width)));
  const double most = largest(p, a);
  if (!(p.step >= 0) || p.step > most)
    refuse("step", p.step, "unstable at this spacing", "0 (chosen) to " + digits(most));
}

namespace {

/// (all) Joins the windows of all ranks, in one message.
void join(const Ranks& ranks, Window& window) {
  std::vector<double> mine;
  for (std::size_t j = 0; j < window.x.size(); ++j)
    for (const auto column : Window::columns) mine.push_back((window.*column)[j]);
  const std::vector<double> all = ranks.joined(mine);
  for (std::size_t i = 0; i < std::size(Window::columns); ++i) {
    std::vector<double>& column = window.*Window::columns[i];
    column.clear();
    for (std::size_t at = i; at < all.size(); at += std::size(Window::columns)) column.push_back(all[at]);
  }
}

}  // namespace

Sites::Sites(const Problem& problem, const Ranks* ranks)
    : problem_(problem), ranks_(ranks == nullptr ? &Ranks::single() : ranks) {}

Window Sites::window(std::size_t begin, std::size_t end, double time) const {
  const auto step = constant_step();
  const double most = step ? 1.0001 * *step : 1e-9 * (1 + time);
  if (!(begin < end) || end > problem_.grid.sites || !(std::fabs(time - this->time()) <= most))
    throw InputError(
        {.key = "window", .problem = "outside the chain or its present step", .allowed = "sites of the chain, now"});
  exchange();
  const Blocks blocks{problem_.grid.sites};
  const std::size_t from = std::max(begin, blocks.begin(blocks.first_of(ranks_->rank(), ranks_->size())));
  const std::size_t to = std::min(end, blocks.begin(blocks.first_of(ranks_->rank() + 1, ranks_->size())));
  Window window;
  if (from < to) window = own_window(from, to, time);
  window.begin = begin;
  if (ranks_->size() > 1) join(*ranks_, window);
  return window;
}

bool Chain::reached(double time) const {
  const auto step = constant_step();
  return step ? steps() >= std::lround(time / *step) : this->time() >= time;
}

}  // namespace slipfront::chain
