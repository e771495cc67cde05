#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

// g++ gets a version for each level of x86-64, chosen at run time. clang 14 knows neither that nor these pragmas: its
// build runs the loops as they come.
#if defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_INDEPENDENT _Pragma("GCC ivdep")
#else
#define SLIPFRONT_INDEPENDENT
#endif
#if defined(SLIPFRONT_CLONES)  // given: a benchmark of one level
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SLIPFRONT_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SLIPFRONT_CLONES
#endif

/// Sums, products and quotients of arrays as vector code.
namespace slipfront {

/// How many numbers one pass of a loop takes, so that all that it has of them fits into the nearest cache.
constexpr std::size_t part_size = 64;

/// Calls `task` with the first number of each part and its size, at most `most`.
template <std::size_t most = part_size, class Task>
void in_parts(std::size_t size, const Task& task) {
  for (std::size_t begin = 0; begin < size; begin += most) task(begin, std::min(most, size - begin));
}

void multiply(std::size_t size, const double* by, double* values);
void divide(std::size_t size, const double* values, const double* by, double* quotients);

/// sum = c_0 x_0 + c_1 x_1 + ...
void combine3(std::size_t size, std::array<double, 3> c, std::array<const double*, 3> x, double* sum);
void combine5(std::size_t size, std::array<double, 5> c, std::array<const double*, 5> x, double* sum);

/// Sum or extremum of value(i) over an array, by `join`, from `start`: in eight lanes, in the same order on every
/// machine. The calls of `value` do not depend on each other.
template <class Value, class Join>
inline double reduce(std::size_t size, double start, Value value, Join join) {
  constexpr std::size_t lanes = 8;
  double part[lanes];
  for (double& p : part) p = start;
  std::size_t i = 0;
  for (; i + lanes <= size; i += lanes) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t j = 0; j < lanes; ++j) part[j] = join(part[j], value(i + j));
  }
  for (; i < size; ++i) part[0] = join(part[0], value(i));
  for (std::size_t j = 1; j < lanes; ++j) part[0] = join(part[0], part[j]);
  return part[0];
}

}  // namespace slipfront
