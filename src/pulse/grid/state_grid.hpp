#pragma once

#include <cstddef>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// What the places of the interface remember. They stay where they are, dislocations pass over them: so their values
/// lie on a grid of x that does not move with the cells, and an empty stretch has them too.
class Places {
 public:
  /// As many as `count` between `left` and `right`, as they are at t = 0.
  Places(const friction::Friction& friction, double left, double right, std::size_t count);

  /// The law's variables, place by place. All places together: what is saved.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  /// What passes over each place: the mean slip velocity, and the one whose logarithm is the mean over slip.
  struct Passing {
    std::vector<double> mean, typical;
  };
  /// From what passes at x[i], which rise; nothing outside.
  Passing passing(const std::vector<double>& x, const Passing& there) const;
  /// Changes the memory over a time in which the same passes all along.
  void advance(const friction::StateEvolution& evolution, const Passing& passing, double time);
  /// The memory at each of `size` x, between two places; that of the last one outside.
  void look_up(std::size_t size, const double* x, double* memory) const;

 private:
  double left_, spacing_;
  std::size_t variables_;
  std::vector<double> values_;
};

}  // namespace slipfront::pulse
