#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "slipfront/error.hpp"
#include "system/parallel.hpp"
#include "text/characters.hpp"

/// `make(i)` for i < count on several threads, in order: the result does not depend on how many. The exception of the
/// lowest i is thrown. `few`: see for_each_parallel.
template <class Result, class Make>
std::vector<Result> in_parallel(std::size_t count, int threads, Make&& make, std::size_t few = 256) {
  std::vector<Result> results(count);
  slipfront::for_each_parallel(
      count, threads, [&](std::size_t i) { results[i] = make(i); }, few);
  return results;
}

/// Writes to stdout what may be shown (titles and names come from files); a full disk or a closed pipe is an error, not
/// a silence. JSON passes unchanged: it has escapes for all the rest.
inline void put(const std::string& raw) {
  const std::string text = slipfront::printable_lines(raw);
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    throw slipfront::FileError("stdout: cannot be written");
}

inline void finish_stdout() {
  if (std::fflush(stdout) != 0) throw slipfront::FileError("stdout: cannot be written");
}
