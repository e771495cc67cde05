#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "runs/record/run_file.hpp"

/// Numbers that a lossy file would not bring back: NaN, infinity, -0, subnormal, all bits of the mantissa.
inline std::vector<slipfront::output::Snapshot> sample_snapshots(std::size_t times, std::size_t cells) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<slipfront::output::Snapshot> snapshots;
  for (std::size_t i = 0; i < times; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    slipfront::output::Profile profile;
    for (std::size_t j = 0; j < cells; ++j) {
      const double x = std::sin(static_cast<double>(1 + i * cells + j));
      profile.k.push_back(x * x);
      profile.U.push_back(j == 0 ? -0.0 : x / 3);
      profile.W.push_back(j == 1 ? std::numeric_limits<double>::denorm_min() : x * 1e-300);
      profile.H.push_back(2 - x);
      profile.slip.push_back(j == 2 ? nan : std::exp(x));
    }
    snapshots.push_back(
        {t,
         profile,
         {i == 0 ? nan : -t / 3, i == 0 ? nan : t / 7, -t / 5, nan, t / 11},
         {1.0 / 3, t / 13, t / 17, -0.0, t / 41, i == 2 ? nan : -t, t / 43, i == 1 ? nan : t / 37, t / 47, t / 53},
         t / 19,
         0.855 - t / 23,
         t / 29,
         t / 31,
         i == 0 ? nan : -t / 37,
         t / 59,
         t / 61,
         i == 1 ? nan : t / 67,
         t / 71});
  }
  return snapshots;
}

inline slipfront::record::RunMetadata sample_metadata(std::size_t cells) {
  slipfront::record::RunMetadata metadata{
      "a title", "title = \"a title\"\n[initial]\n", "1.2.3", "slipfront pulse a.toml", {}, {}};
  for (std::size_t i = 0; i <= cells; ++i) metadata.x_edges.push_back(0.1 * static_cast<double>(i) - 1);
  return metadata;
}

inline std::string sample_state() {
  std::string state;
  for (int i = 0; i < 1000; ++i) state += static_cast<char>(i * 7);
  return state;
}
