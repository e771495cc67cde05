#pragma once
// Cases and measurements that several tests of chains share.

#include <cmath>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "slipfront/lattice/chain/run.hpp"

namespace slipfront {

/// A step of stress 0.855 next to the empty side, at scale 60. The caller adds friction.
inline chain::ScaledProblem small_step() {
  chain::ScaledProblem s;
  s.scale = 60;
  s.left = -6;
  s.right = 2;
  s.stress = [](double x) { return x < 0 ? 0.855 : 0.0; };
  return s;
}

/// Output times 0, end / 2 and end, in cells over the domain of `small_step`.
inline output::Schedule until(double end) {
  output::Schedule schedule;
  schedule.times = {0, end / 2, end};
  for (int i = 0; i <= 16; ++i) schedule.x_edges.push_back(-6 + i * 0.5);
  return schedule;
}

/// The levels of a run by explicit steps.
inline chain::Levels levels_of(const chain::Run& run) {
  return dynamic_cast<const chain::ExplicitChain&>(run.chain()).levels();
}

/// The growth rate of a small disturbance of a block that slides at v, from the peaks of its velocity until `end`. The
/// first `skipped` peaks do not count.
inline double growth_of_peaks(chain::Chain& chain, double v, double end, std::size_t skipped) {
  std::vector<double> times, peaks;
  double v1 = 0, v2 = 0, t1 = 0;
  while (chain.time() < end) {
    chain.advance_to(1e9, 1);
    const double now = chain.window(3, 4).velocity[0];
    if (v1 > v2 && v1 > now && v1 > v) {
      times.push_back(t1);
      peaks.push_back(v1 / v - 1);
    }
    v2 = v1;
    v1 = now;
    t1 = chain.time();
  }
  return std::log(peaks.back() / peaks[skipped]) / (times.back() - times[skipped]);
}

}  // namespace slipfront
