#include <algorithm>
#include <cmath>

#include "friction/laws/force_of_speed.hpp"
#include "friction/state/contacts.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {
namespace {

SLIPFRONT_CLONES void slow(std::size_t size, const double* free, double weight, double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double slowed = free[i] - weight * speed[i];
    speed[i] = slowed < 0 ? 0 : slowed;
  }
}

SLIPFRONT_CLONES void add_slip(std::size_t size, const double* velocity, double time, double* slip) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) slip[i] += std::fabs(velocity[i]) * time;
}

/// The strength f_d + (f_s - f_d) max(0, 1 - slip / D_c), which does not depend on the speed.
struct Strength {
  using Values = std::array<double, 3>;
  double residual, gain, per_slip;
  explicit Strength(const Values& v) : residual(v[1]), gain(v[0] - v[1]), per_slip(1 / v[2]) {}
  double operator()(double slip) const { return residual + gain * at_least(1 - slip * per_slip, 0); }
  void of_all(std::size_t size, LocalStates slips, double* force) const {
    double copies[part_size];
    in_parts(size, [&](std::size_t begin, std::size_t some) {
      forces_at(*this, some, slips.from(begin).column(0, some, copies), force + begin);
    });
  }
};

class StrengthLoops final : public ForceLoops {
 public:
  StrengthLoops(const Law& law, const Strength& strength) : ForceLoops(law), strength_(strength) {}
  void strengths(std::size_t size, const double*, LocalStates slip, double* force) const override {
    strength_.of_all(size, slip, force);
  }
  void speeds_after(std::size_t size, const double* free, double weight, LocalStates slip,
                    double* speed) const override {
    strength_.of_all(size, slip, speed);
    slow(size, free, weight, speed);
  }

 private:
  Strength strength_;
};

class StrengthAverage final : public QuadratureAverage {
 public:
  StrengthAverage(const Law& law, const Strength& strength) : QuadratureAverage(law), strength_(strength) {}
  double mean_strength(const State&, double, Closure, LocalState slip) const override { return strength_(slip[0]); }
  void mean_strengths(const Trains& trains, Closure, double* mean, double* slope) const override {
    strength_.of_all(trains.size, trains.states, mean);
    if (slope != nullptr) std::fill_n(slope, trains.size, 0.0);
  }

 private:
  Strength strength_;
};

/// The state of a position is how far it has slipped, to and fro.
class PathLength final : public StateEvolution {
 public:
  void start(std::span<double> path) const override { path[0] = 0; }
  void advance(const Slip& slip, double time, std::span<double> path) const override {
    path[0] += std::fabs(slip.mean) * time;
  }
  void advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const override {
    change_in_parts(size, states, [&](std::size_t begin, std::size_t some, double* path) {
      add_slip(some, slips.mean + begin, time, path);
    });
  }
};

class VaryingSlipWeakening;

class SlipWeakening final : public Law {
 public:
  using WhereItVaries = VaryingSlipWeakening;
  explicit SlipWeakening(const std::vector<double>& values) : strength_(force_with<Strength>(values)) {}
  double strength(double, LocalState slip) const override { return strength_(slip[0]); }
  double speed_after(double free, double weight, LocalState slip) const override {
    return std::fmax(free - weight * strength_(slip[0]), 0);
  }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  Strength strength_;
  StrengthLoops loops_{*this, strength_};
  StrengthAverage average_{*this, strength_};
  PathLength evolution_;
};

class VaryingSlipWeakening final : public VaryingLaw<SlipWeakening> {
 public:
  using VaryingLaw::VaryingLaw;
  const ForceLoops& loops() const override { return loops_; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  class Loops final : public ForceLoops {
   public:
    explicit Loops(const VaryingSlipWeakening& law) : ForceLoops(law), all_(law) {}
    void strengths(std::size_t size, const double*, LocalStates states, double* force) const override {
      double copies[part_size];
      in_parts(size, [&](std::size_t begin, std::size_t some) {
        const LocalStates part = states.from(begin);
        forces_where_they_vary<Strength>(all_.values(), all_.varying(), some, part.column(0, some, copies), part,
                                         force + begin);
      });
    }
    void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                      double* speed) const override {
      strengths(size, nullptr, states, speed);
      slow(size, free, weight, speed);
    }

   private:
    const VaryingSlipWeakening& all_;
  };
  Loops loops_{*this};
  PathLength evolution_;
};

}  // namespace

const Definition& slip_weakening_law() {
  static const Definition definition{
      .name = "slip-weakening",
      .adjective = "slip-weakening",
      .equation = "f = f_d + (f_s - f_d) max(0, 1 - slip / D_c), with the sign of w; positions stick below it",
      .source = "Andrews (1976), J. Geophys. Res. 81:5679",
      .parameters = {strength_in(force_unit, "f_s", "friction before any slip"),
                     force_named("residual", "f_d", "friction after the slip D_c"), characteristic_slip()},
      .state = {{.name = "slipped", .symbol = "s", .unit = "b / (2 pi)"}},
      .make = make_law<SlipWeakening>};
  return definition;
}

}  // namespace slipfront::friction
