#pragma once

#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// What the places of the interface remember. They stay where they are, dislocations pass over them: so their values
/// lie on a grid of x that does not move with the cells, and an empty stretch has them too.
class Places {
 public:
  /// As many as `count` between `left` and `right`, as they are at t = 0.
  Places(const friction::Friction& friction, double left, double right, std::size_t count);

  std::size_t variables() const { return variables_; }
  /// The law's variables, place by place. All places together: what is saved.
  std::vector<double>& values() { return values_; }
  const std::vector<double>& values() const { return values_; }

  /// The slip velocity at the places where it is `velocity[i]` at x[i], which rise; 0 outside.
  std::vector<double> velocity_from(const std::vector<double>& x, const std::vector<double>& velocity) const;
  /// Changes the memory over a time in which each place slips at a constant velocity.
  void advance(const friction::Law& law, const std::vector<double>& velocity, double time);
  /// The memory at x, between two places; that of the last one outside.
  void look_up(double x, double* memory) const;

 private:
  double left_, spacing_;
  std::size_t variables_;
  std::vector<double> values_;
};

}  // namespace slipfront::pulse
