#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "lattice/chain/events/event_log.hpp"
#include "system/archive.hpp"

namespace slipfront::chain {
namespace {

output::Snapshot at(double time) {
  output::Snapshot snapshot{};
  snapshot.time = time;
  return snapshot;
}

/// Takes the steps first + 1 to last of event 1, one unit of time each.
void keep_differences(EventOutputs& outputs, int first, int last) {
  for (int step = first + 1; step <= last; ++step)
    if (outputs.wants(1)) outputs.add(at(step));
}

std::vector<double> times(const EventOutputs& outputs) {
  std::vector<double> all;
  for (const output::Snapshot& snapshot : outputs.all()) all.push_back(snapshot.time);
  return all;
}

TEST(EventOutputs, KeepsEachStepOfAShortEvent) {
  EventOutputs outputs(4);
  keep_differences(outputs, 0, 7);
  EXPECT_EQ(times(outputs), (std::vector<double>{1, 2, 3, 4, 5, 6, 7}));
}

TEST(EventOutputs, SpreadsThemOverALongEvent) {
  EventOutputs outputs(4);
  keep_differences(outputs, 0, 100);
  EXPECT_EQ(times(outputs), (std::vector<double>{16, 32, 48, 64, 80, 96}));
}

TEST(EventOutputs, AddsTheEndOfAnEvent) {
  EventOutputs outputs(4);
  EXPECT_FALSE(outputs.wants(0));
  keep_differences(outputs, 0, 20);
  EXPECT_TRUE(outputs.wants(0));
  outputs.add(at(21));
  EXPECT_FALSE(outputs.wants(0));
  EXPECT_EQ(times(outputs), (std::vector<double>{4, 8, 12, 16, 20, 21}));
}

TEST(EventOutputs, KeepsOutputTimes) {
  EventOutputs outputs(2);
  outputs.add_scheduled(at(0));
  keep_differences(outputs, 0, 3);
  outputs.add_scheduled(at(3.5));
  keep_differences(outputs, 3, 20);
  EXPECT_EQ(times(outputs), (std::vector<double>{0, 3.5, 8, 16}));
  EXPECT_EQ(outputs.scheduled(), 2U);
}

TEST(EventOutputs, ContinuesAsIfItHadNotStopped) {
  EventOutputs whole(3), first(3), second(3);
  keep_differences(whole, 0, 50);
  keep_differences(first, 0, 23);
  first.add_scheduled(at(23.5));  // the end of a run, which a longer run does not have
  const std::string state = saved(first);
  std::vector<output::Snapshot> snapshots = first.all();
  snapshots.pop_back();
  second.set_all(snapshots);
  restore(second, state);
  keep_differences(second, 23, 50);
  EXPECT_EQ(times(second), times(whole));
}

TEST(EventOutputs, OutputsNothingUnlessAsked) {
  EventOutputs outputs(0);
  keep_differences(outputs, 0, 10);
  EXPECT_TRUE(outputs.all().empty());
}

}  // namespace
}  // namespace slipfront::chain
