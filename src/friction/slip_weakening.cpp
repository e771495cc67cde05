#include <cmath>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

/// A place remembers how far it has slipped, to and fro.
class SlipWeakening final : public Law {
 public:
  SlipWeakening(double at_rest, double residual, double distance) : fs_(at_rest), fd_(residual), D_(distance) {}
  double strength(double, Memory slip) const override { return fd_ + (fs_ - fd_) * std::fmax(0, 1 - slip[0] / D_); }
  double speed_after(double free, double weight, Memory slip) const override {
    return std::fmax(free - weight * strength(0, slip), 0);
  }
  double mean_strength(const State&, double, Closure, Memory slip) const override { return strength(0, slip); }
  void start(std::span<double> slip) const override { slip[0] = 0; }
  void advance(double velocity, double time, std::span<double> slip) const override {
    slip[0] += std::fabs(velocity) * time;
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
      .parameters =
          {coefficient_in("mu A^2 / (pi (1 - nu))"),
           {.name = "residual", .symbol = "f_d", .unit = "mu A^2 / (pi (1 - nu))", .dimension = Dimension::force},
           {.name = "slip_distance",
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
