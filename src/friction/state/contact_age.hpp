#pragma once

#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// The state theta of rate-and-state friction, the age of a position's contacts. Exact at a constant velocity.
///     ageing: theta_t = 1 - |w| theta / D_c            slip: theta_t = -x ln x, x = |w| theta / D_c
/// The ageing law is linear in w. Of the slip law the mean over time is -(W theta / D_c) (<ln w>_u + ln(theta / D_c)),
/// as W dt is du.
class ContactAge final : public StateEvolution {
 public:
  enum class Kind { ageing, slip };
  ContactAge(Kind kind, double start, double distance) : kind_(kind), start_(start), D_(distance) {}
  void start(std::span<double> theta) const override { theta[0] = start_; }
  void advance(const Slip& slip, double time, std::span<double> theta) const override;
  void advance_all(std::size_t size, const Slips& slips, double time, std::size_t each, double* theta) const override;

 private:
  Kind kind_;
  double start_, D_;
};

}  // namespace slipfront::friction
