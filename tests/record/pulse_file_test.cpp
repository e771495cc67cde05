#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "pulse_sample.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "temporary_folder.hpp"

namespace {

using slipfront::FileError;
using slipfront::InputError;
using slipfront::output::Snapshot;
using slipfront::record::Checkpoint;
using slipfront::record::read_checkpoint;
using slipfront::record::RunMetadata;

using Bits = std::vector<std::uint64_t>;

Bits bits(const std::vector<double>& values) {
  Bits result;
  for (const double value : values) result.push_back(std::bit_cast<std::uint64_t>(value));
  return result;
}

Bits scalar_bits(const Snapshot& s) {
  std::vector<double> values = {s.time};
  for (const auto& scalar : slipfront::output::scalars()) values.push_back(scalar.get(s));
  return bits(values);
}

void expect_equal(const std::vector<Snapshot>& a, const std::vector<Snapshot>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(scalar_bits(a[i]), scalar_bits(b[i]));
    EXPECT_EQ(bits(a[i].profile.k), bits(b[i].profile.k));
    EXPECT_EQ(bits(a[i].profile.U), bits(b[i].profile.U));
    EXPECT_EQ(bits(a[i].profile.W), bits(b[i].profile.W));
    EXPECT_EQ(bits(a[i].profile.slip), bits(b[i].profile.slip));
  }
}

TEST(PulseFile, RestoresEveryBit) {
  const TemporaryFolder folder;
  const auto snapshots = sample_snapshots(5, 7);
  write_pulse(folder / "a.nc", sample_metadata(), snapshots, sample_state(), false);
  const Checkpoint run = read_checkpoint(folder / "a.nc");
  EXPECT_EQ(run.scenario_text, sample_metadata().scenario_text);
  EXPECT_EQ(run.version, "1.2.3");
  EXPECT_EQ(run.solver_state, sample_state());
  EXPECT_FALSE(run.finished);
  expect_equal(run.snapshots, snapshots);
}

/// The dislocations of the second snapshot are one that is new and one of the first snapshot, with another level.
TEST(PulseFile, RestoresSitesAndDislocations) {
  const TemporaryFolder folder;
  auto snapshots = sample_snapshots(3, 7);
  for (Snapshot& s : snapshots) s.displacement = {s.time / 3, -0.0, 1e-310};
  snapshots[1].dislocations = {{-0.5, 1, -7}, {0.1, -1, -7}};
  snapshots[2].dislocations = {{-0.51, 1, -7}, {0.11, -1, -7}, {1.0 / 3, 1, -7}};
  std::vector<slipfront::record::Array> arrays = arrays_of(sample_metadata(), snapshots);
  add_displacement(arrays, {-1, -0.9, 1.0 / 3}, snapshots);
  add_dislocations(arrays, {}, snapshots);
  slipfront::record::write_run(folder / "a.nc", sample_metadata(), arrays, sample_state(), true);
  const Checkpoint run = read_checkpoint(folder / "a.nc");
  expect_equal(run.snapshots, snapshots);
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    EXPECT_EQ(bits(run.snapshots[i].displacement), bits(snapshots[i].displacement));
    ASSERT_EQ(run.snapshots[i].dislocations.size(), snapshots[i].dislocations.size());
    for (std::size_t j = 0; j < snapshots[i].dislocations.size(); ++j) {
      const auto &read = run.snapshots[i].dislocations[j], &written = snapshots[i].dislocations[j];
      EXPECT_EQ(bits({read.x}), bits({written.x}));
      EXPECT_EQ(read.sign, written.sign);
      EXPECT_EQ(read.level, written.level);
    }
  }
}

TEST(PulseFile, AcceptsARunWithoutSnapshots) {
  const TemporaryFolder folder;
  write_pulse(folder / "a.nc", sample_metadata(), {}, "", true);
  const Checkpoint run = read_checkpoint(folder / "a.nc");
  EXPECT_TRUE(run.snapshots.empty());
  EXPECT_TRUE(run.solver_state.empty());
  EXPECT_TRUE(run.finished);
}

TEST(PulseFile, WritesEqualFilesForEqualRuns) {
  const TemporaryFolder folder;
  write_pulse(folder / "a.nc", sample_metadata(), sample_snapshots(5, 7), sample_state(), true);
  write_pulse(folder / "b.nc", sample_metadata(), sample_snapshots(5, 7), sample_state(), true);
  EXPECT_EQ(read_bytes(folder / "a.nc"), read_bytes(folder / "b.nc"));
}

TEST(PulseFile, WritesTheSameFileForAResumedRun) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& variables :
       {std::vector<std::string>{}, {"stress_drop", "W"}, {"slip"}, {"Sigma", "stress_drop"}, {"k"}}) {
    RunMetadata metadata = sample_metadata();
    metadata.variables = variables;
    const auto all = sample_snapshots(6, 7);
    write_pulse(folder / "whole.nc", metadata, all, "end", true);
    write_pulse(folder / "part.nc", metadata, {all.begin(), all.begin() + 3}, "half", false);
    Checkpoint run = read_checkpoint(folder / "part.nc");
    run.snapshots.insert(run.snapshots.end(), all.begin() + 3, all.end());
    write_pulse(folder / "part.nc", metadata, run.snapshots, "end", true);
    EXPECT_EQ(read_bytes(folder / "whole.nc"), read_bytes(folder / "part.nc"));
  }
}

TEST(PulseFile, HoldsOnlyRequestedVariables) {
  const TemporaryFolder folder;
  RunMetadata metadata = sample_metadata();
  metadata.variables = {"W"};
  const auto snapshots = sample_snapshots(3, 7);
  write_pulse(folder / "a.nc", metadata, snapshots, "", false);
  const Checkpoint run = read_checkpoint(folder / "a.nc");
  EXPECT_EQ(bits(run.snapshots[2].profile.W), bits(snapshots[2].profile.W));
  EXPECT_TRUE(run.snapshots[2].profile.k.empty());
  EXPECT_EQ(scalar_bits(run.snapshots[2]), scalar_bits(snapshots[2]));
}

TEST(PulseFile, ListsKnownVariablesIfOneIsUnknown) {
  const TemporaryFolder folder;
  RunMetadata metadata = sample_metadata();
  metadata.variables = {"W", "w"};
  const std::string message = message_of<InputError>([&] { write_pulse(folder / "a.nc", metadata, {}, "", false); });
  EXPECT_EQ(message, "output.variables = 'w': unknown variable; allowed: k, Sigma, U, W, H, slip, stress_drop, trains");
  EXPECT_EQ(folder.files(), 0u);
}

TEST(PulseFile, RestoresAScenarioOfAnyBytes) {
  const TemporaryFolder folder;
  for (const std::string& scenario :
       {std::string(), std::string("\0", 1), std::string("a\0b\xff\xfe\n", 6),
        std::string("# Gr\xc3\xb6\xc3\x9f"
                    "e\r\n"),
        std::string("\xed\xa0\x80"), std::string(60000, 'x'), std::string(60001, 'x'), std::string(1000000, '#')}) {
    RunMetadata metadata = sample_metadata();
    metadata.scenario_text = scenario;
    metadata.title = metadata.command_line = scenario;  // must not break the file either
    write_pulse(folder / "a.nc", metadata, {}, "", false);
    EXPECT_TRUE(read_checkpoint(folder / "a.nc").scenario_text == scenario) << scenario.size();
  }
}

TEST(PulseFile, RejectsValuesThatDoNotFillTheirDimensions) {
  const TemporaryFolder folder;
  auto snapshots = sample_snapshots(2, 7);
  snapshots[0].profile.W.pop_back();
  const std::string message =
      message_of<std::invalid_argument>([&] { write_pulse(folder / "a.nc", sample_metadata(), snapshots, "", false); });
  EXPECT_EQ(message, "write_dataset: W has not as many values as its dimensions");
  EXPECT_EQ(folder.files(), 0u);
}

}  // namespace
