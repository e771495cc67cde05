#include "slipfront/chain/problem.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#if defined(__unix__) && !defined(__EMSCRIPTEN__)
#include <unistd.h>
#endif

#include "../digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::chain {
namespace {

[[noreturn]] void refuse(const char* key, double value, std::string problem, std::string allowed) {
  throw InputError({.key = key, .value = digits(value), .problem = std::move(problem), .allowed = std::move(allowed)});
}

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
  return most;
}

bool plain(const Problem& p) {
  return !p.contact && !p.forcing &&
         (p.friction.law == modulation::FrictionLaw::none || p.friction.law == modulation::FrictionLaw::viscous);
}

double chosen(const Problem& p, double a) {
  const double h = p.grid.spacing;
  // lambda^2 = 1 - h^2 / 12: the least departure from the light cone at which the shortest wave is stable.
  if (p.model == Model::sine_gordon) return h * std::sqrt(1 - a * a * h * h / 12);
  return std::fmin(0.05, 0.9 * h / std::sqrt(1 + a * a * h * h / 4));
}

double largest(const Problem& p, double a) {
  const double h = p.grid.spacing;
  return p.model == Model::sine_gordon ? chosen(p, a) : h / std::sqrt(1 + a * a * h * h / 4);
}

}  // namespace

double chosen_step(const Problem& p) { return p.step > 0 ? p.step : chosen(p, largest_contact(p)); }

double largest_step(const Problem& p) { return largest(p, largest_contact(p)); }

double memory_needed(const Problem& p) {
  // Two levels, and a displacement to start from; where not plain also contact, three levels of forcing, what they add
  // up to and two of work.
  return static_cast<double>(p.grid.sites) * 8 * (plain(p) ? 3 : 10);
}

double memory_of_machine() {
#if defined(_SC_PHYS_PAGES) && defined(__unix__) && !defined(__EMSCRIPTEN__)
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
#else
  return 0;
#endif
}

void check(const Problem& p, double share_of_machine) {
  const double h = p.grid.spacing;
  if (!(h > 0) || !std::isfinite(h)) refuse("spacing", h, "out of range", "> 0, finite");
  if (!std::isfinite(p.grid.left)) refuse("left", p.grid.left, "out of range", "finite");
  if (p.grid.sites < 8) refuse("sites", static_cast<double>(p.grid.sites), "too few", ">= 8");
  if (!(p.friction.coefficient >= 0) || !std::isfinite(p.friction.coefficient))
    refuse("friction.coefficient", p.friction.coefficient, "out of range", ">= 0, finite");
  if (p.friction.law == modulation::FrictionLaw::power && !(p.friction.exponent > 0))
    refuse("friction.exponent", p.friction.exponent, "out of range", "> 0");
  const double need = memory_needed(p) * share_of_machine, have = memory_of_machine();
  if (have > 0 && need > have)
    refuse("sites", static_cast<double>(p.grid.sites),
           "a run needs " + digits(need / 1e9) + " GB, this machine has " + digits(have / 1e9) + " GB",
           "at most " + digits(have / need * static_cast<double>(p.grid.sites)) + " sites");
  const double a = largest_contact(p), sites_per_width = 1 / (a * h);
  if (p.model == Model::sine_gordon && sites_per_width < least_sites_per_width)
    refuse("spacing", h,
           "too coarse: " + digits(sites_per_width) + " sites to the width of a dislocation, " +
               digits(least_sites_per_width) + " are needed",
           "at most " + digits(1 / (a * least_sites_per_width)));
  const double most = largest(p, a);
  if (!(p.step >= 0) || p.step > most)
    refuse("step", p.step, "unstable at this spacing", "0 (chosen) to " + digits(most));
}

}  // namespace slipfront::chain
