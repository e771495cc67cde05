#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace slipfront::inference {

/// Points of the Sobol sequence in the open unit cube, moved by a digital shift that a seed makes.
class ShiftedSobol {
 public:
  static constexpr std::size_t dimensions = 16;
  ShiftedSobol(std::size_t points, std::uint64_t seed);
  /// Makes room for more points; those there stay the same.
  void grow(std::size_t points);
  /// Coordinate `dimension` of a point.
  double operator()(std::size_t point, std::size_t dimension) const;

 private:
  const std::vector<std::uint64_t>* points_;
  std::uint64_t shift_[dimensions];
};

/// A seed for one event, from that of the run and the words that name it.
std::uint64_t seed_of(std::uint64_t seed, std::string_view words, std::size_t line);

}  // namespace slipfront::inference
