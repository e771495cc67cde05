#pragma once

#include <cstddef>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "slipfront/error.hpp"

/// `make(i)` for i < count on several threads, in order: the result does not depend on how many. The exception of the
/// lowest i is thrown.
template <class Result, class Make>
std::vector<Result> in_parallel(std::size_t count, int threads, Make&& make) {
  std::vector<Result> results(count);
  std::exception_ptr thrown;
  std::size_t thrown_at = count;
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1 && count > 256)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      results[i] = make(i);
    } catch (...) {
#pragma omp critical
      if (i < thrown_at) {
        thrown_at = i;
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
  return results;
}

/// Writes to stdout; a full disk or a closed pipe is an error, not a silence.
inline void put(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    throw slipfront::FileError("stdout: cannot be written");
}

inline void finish_stdout() {
  if (std::fflush(stdout) != 0) throw slipfront::FileError("stdout: cannot be written");
}
