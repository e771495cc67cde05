#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"

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

/// A seed for one event, from that of the run and the observed numbers. Events with the same numbers have the same
/// seed, whatever their names and their positions in a file.
std::uint64_t seed_of(std::uint64_t seed, const catalogue::Observation& observation);

}  // namespace slipfront::inference
