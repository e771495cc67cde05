// Work in a copy of the process: what it gives, what it throws, and that it may crash.

#include "../../src/record/isolated.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>

#include "slipfront/error.hpp"
#include "temporary_folder.hpp"

namespace {

using slipfront::record::isolated;

TEST(Isolated, GivesBackAnyBytes) {
  std::string bytes(3000000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 7);
  EXPECT_EQ(isolated("a", "fails", [&] { return bytes; }), bytes);
  EXPECT_EQ(isolated("a", "fails", [] { return std::string(); }), "");
}

TEST(Isolated, ThrowsWhatTheWorkThrows) {
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

TEST(Isolated, ACrashIsAFileError) {
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

}  // namespace
