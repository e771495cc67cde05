#include "plane/direct/loads.hpp"

#include <cmath>

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
  if (is_known_ && released == released_ && !problem_.forcing) return;
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

}  // namespace slipfront::plane
