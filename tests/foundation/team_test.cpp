#include "system/team.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "system/parallel.hpp"

namespace {

using namespace slipfront;

void throw_at_odd(std::size_t i) {
  if (i % 2 == 1) throw std::runtime_error(std::to_string(i));
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(Team, CallsEachIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> calls(103);
    for_each_on_team(calls.size(), threads, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) EXPECT_EQ(count, 1);
  }
  for_each_on_team(0, 2, [](std::size_t) { FAIL(); });
}

/// A call within a call, and calls by several threads at once, are done by their callers if the team is busy.
TEST(Team, ServesCallsThatCrossEachOther) {
  std::atomic<int> calls = 0;
  for_each_on_team(3, 3, [&](std::size_t) { for_each_on_team(7, 2, [&](std::size_t) { ++calls; }); });
  EXPECT_EQ(calls, 21);
  for_each_parallel(
      40, 4, [&](std::size_t) { for_each_on_team(5, 3, [&](std::size_t) { ++calls; }); }, 1);
  EXPECT_EQ(calls, 221);
}

/// A forked process has no other threads, and starts its own.
TEST(Team, ServesAForkedProcess) {
  const auto sum_of = [](int threads) {
    std::atomic<int> sum = 0;
    for_each_on_team(100, threads, [&](std::size_t i) { sum += static_cast<int>(i); });
    return sum.load();
  };
  EXPECT_EQ(sum_of(3), 4950);
  const pid_t child = fork();
  if (child == 0) _exit(sum_of(3) == 4950 && sum_of(2) == 4950 ? 0 : 1);
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST(Team, ThrowsTheExceptionOfTheLowestIndex) {
  for (const int threads : {1, 2, 5}) {
    EXPECT_EQ(message_of([&] { for_each_on_team(100, threads, throw_at_odd); }), "1");
    EXPECT_EQ(message_of([&] { for_each_parallel(100, threads, throw_at_odd, 1); }), "1");
  }
}

}  // namespace
