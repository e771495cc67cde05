#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "runs/record/arrays.hpp"
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

inline slipfront::record::RunMetadata sample_metadata() {
  return {.format = slipfront::record::pulse_format,
          .title = "a title",
          .scenario_text = "title = \"a title\"\n[initial]\n",
          .version = "1.2.3",
          .command_line = "slipfront pulse a.toml"};
}

inline std::vector<slipfront::record::Array> arrays_of(const slipfront::record::RunMetadata& metadata,
                                                       const std::vector<slipfront::output::Snapshot>& snapshots) {
  std::vector<double> edges = {-1};
  const std::size_t cells = snapshots.empty() ? 1 : snapshots.back().profile.W.size();
  for (std::size_t i = 1; i <= cells; ++i) edges.push_back(0.1 * static_cast<double>(i) - 1);
  return slipfront::record::arrays_of(edges, metadata.variables, snapshots);
}

inline void write_pulse(const std::string& path, const slipfront::record::RunMetadata& metadata,
                        const std::vector<slipfront::output::Snapshot>& snapshots, const std::string& state,
                        bool finished) {
  slipfront::record::write_run(path, metadata, arrays_of(metadata, snapshots), state, finished);
}

inline std::string sample_state() {
  std::string state;
  for (int i = 0; i < 1000; ++i) state += static_cast<char>(i * 7);
  return state;
}
