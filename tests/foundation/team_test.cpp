#include "system/team.hpp"

#include <gtest/gtest.h>

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

TEST(Team, ThrowsTheExceptionOfTheLowestIndex) {
  for (const int threads : {1, 2, 5}) {
    EXPECT_EQ(message_of([&] { for_each_on_team(100, threads, throw_at_odd); }), "1");
    EXPECT_EQ(message_of([&] { for_each_parallel(100, threads, throw_at_odd, 1); }), "1");
  }
}

}  // namespace
