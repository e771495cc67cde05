// Work in a copy of the process: what it gives, what it throws, and that it may crash.

#include "record/netcdf/isolated.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>

#include "slipfront/error.hpp"
#include "temporary_folder.hpp"

namespace {

using slipfront::record::isolated;

TEST(Isolated, ReturnsAnyBytes) {
  std::string bytes(3000000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  EXPECT_EQ(isolated("a", "fails", [&] { return bytes; }), bytes);
  EXPECT_EQ(isolated("a", "fails", [] { return std::string(); }), "");
}

TEST(Isolated, RethrowsTheExceptionOfTheWork) {
  const auto input = [] {
    isolated("a", "fails", []() -> std::string {
      throw slipfront::InputError({.file = "f", .line = 3, .key = "k", .value = "v", .problem = "p", .allowed = "q"});
    });
  };
  EXPECT_EQ(message_of<slipfront::InputError>(input), "f:3: k = 'v': p; allowed: q");
  const auto file = [] { isolated("a", "fails", []() -> std::string { throw slipfront::FileError("gone"); }); };
  EXPECT_EQ(message_of<slipfront::FileError>(file), "gone");
  EXPECT_THROW(isolated("a", "fails", []() -> std::string { throw std::bad_alloc(); }), std::bad_alloc);
}

TEST(Isolated, ReportsACrashAsAFileError) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
    const auto crash = [signal] {
      isolated("a.nc", "cannot be read", [signal]() -> std::string {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
        return {};
      });
    };
    EXPECT_EQ(message_of<slipfront::FileError>(crash).find("a.nc: cannot be read: "), 0u) << signal;
  }
  EXPECT_EQ(isolated("a", "fails", [] { return std::string("next"); }), "next");
}

TEST(Isolated, ReportsEndlessWorkAsAFileError) {
  const auto endless = [] {
    isolated(
        "a.nc", "cannot be read",
        []() -> std::string {
          for (volatile bool always = true; always;) {
          }
          return {};
        },
        1);
  };
  const std::string message = message_of<slipfront::FileError>(endless);
  EXPECT_EQ(message.find("a.nc: cannot be read: "), 0u) << message;
  EXPECT_NE(message.find("within 1 s"), std::string::npos) << message;
}

/// A wait is not work: a busy machine, or a slow disk, does not end it.
TEST(Isolated, AllowsWaitsLongerThanTheLimit) {
  const auto wait = []() -> std::string {
    usleep(1500000);
    return "done";
  };
  EXPECT_EQ(isolated("a", "fails", wait, 1), "done");
}

}  // namespace
