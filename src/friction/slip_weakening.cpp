#include <algorithm>
#include <cmath>

#include "foundation/simd/vector_code.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

SLIPFRONT_CLONES void forces(double residual, double gain, double distance, std::size_t size, const double* slip,
                             double* force) {
  const double per_slip = 1 / distance;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double left = 1 - slip[i] * per_slip;
    force[i] = residual + gain * (left > 0 ? left : 0);
  }
}

SLIPFRONT_CLONES void slow(std::size_t size, const double* free, double weight, double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double left = free[i] - weight * speed[i];
    speed[i] = left < 0 ? 0 : left;
  }
}

SLIPFRONT_CLONES void add_slip(std::size_t size, const double* velocity, double time, double* slip) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) slip[i] += std::fabs(velocity[i]) * time;
}

/// A place remembers how far it has slipped, to and fro.
class SlipWeakening final : public Law {
 public:
  SlipWeakening(double at_rest, double residual, double distance) : fs_(at_rest), fd_(residual), D_(distance) {}
  double strength(double, Memory slip) const override { return fd_ + (fs_ - fd_) * std::fmax(0, 1 - slip[0] / D_); }
  double speed_after(double free, double weight, Memory slip) const override {
    return std::fmax(free - weight * strength(0, slip), 0);
  }
  double mean_strength(const State&, double, Closure, Memory slip) const override { return strength(0, slip); }
  void strengths(std::size_t size, const double*, Memories slip, double* force) const override {
    forces(fd_, fs_ - fd_, D_, size, slip.values, force);
  }
  void speeds_after(std::size_t size, const double* free, double weight, Memories slip, double* speed) const override {
    forces(fd_, fs_ - fd_, D_, size, slip.values, speed);
    slow(size, free, weight, speed);
  }
  void mean_strengths(const Trains& trains, Closure, double* mean, double* slope) const override {
    forces(fd_, fs_ - fd_, D_, trains.size, trains.memory.values, mean);
    if (slope != nullptr) std::fill_n(slope, trains.size, 0.0);
  }
  void start(std::span<double> slip) const override { slip[0] = 0; }
  void advance(double velocity, double time, std::span<double> slip) const override {
    slip[0] += std::fabs(velocity) * time;
  }
  void advance_all(std::size_t size, const double* velocity, double time, std::size_t, double* slip) const override {
    add_slip(size, velocity, time, slip);
  }
  void advance_in_trains(std::size_t size, const double* mean, const double*, double time, std::size_t,
                         double* slip) const override {
    add_slip(size, mean, time, slip);
  }

 private:
  double fs_, fd_, D_;
};

}  // namespace

const Definition& slip_weakening_law() {
  static const Definition definition{
      .name = "slip-weakening",
      .adjective = "slip-weakening",
      .equation = "f = f_d + (f_s - f_d) max(0, 1 - slip / D_c), with the sign of w; places stick below it",
      .source = "Andrews (1976), J. Geophys. Res. 81:5679",
      .parameters = {strength_in(force_unit, "f_s"),
                     {.name = "residual", .symbol = "f_d", .unit = force_unit, .dimension = Dimension::force},
                     {.name = "characteristic_slip",
                      .symbol = "D_c",
                      .unit = "b / (2 pi)",
                      .value = 1,
                      .without_least = true,
                      .dimension = Dimension::slip}},
      .variables = {{.name = "slipped", .symbol = "s", .unit = "b / (2 pi)"}},
      .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
        return std::make_shared<SlipWeakening>(values[0], values[1], values[2]);
      }};
  return definition;
}

}  // namespace slipfront::friction
