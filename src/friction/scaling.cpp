// The dimensions that a law states for its parameters decide how it is scaled. These checks compare them with its
// force.

#include "friction/scaling.hpp"

#include <cmath>
#include <string>

#include "foundation/text/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

/// Replaces the curve of a law that takes one. A table ends somewhere, a formula may fail; this curve does neither.
Curve probe_curve(const Definition& definition) {
  if (definition.curve == CurveSource::none) return {};
  return [](double speed) { return 0.5 + speed / (1 + speed); };
}

std::shared_ptr<const Law> probe_law(const Definition& definition, const std::vector<double>& values) {
  return definition.make(values, probe_curve(definition), {});
}

[[noreturn]] void refuse(const Definition& definition, const std::string& problem) {
  throw InputError({.key = "friction",
                    .value = std::string(definition.name),
                    .problem = problem,
                    .allowed = "a law whose definition states the Dimension of each parameter: of a force that of "
                               "strengths and of coefficients of the velocity"});
}

/// A law at one position, with its state.
struct Position {
  std::shared_ptr<const Law> law;
  std::vector<double> state;

  Position(const Friction& friction, std::shared_ptr<const Law> of)
      : law(std::move(of)), state(friction.definition().state.size()) {
    law->evolution().start(state);
  }
  void slip(double velocity, double time) { law->evolution().advance(Slip::at(velocity), time, state); }
  double force(double speed) const { return law->strength(speed, state); }
};

/// Compares forces at speeds from far below slow slip to far above earthquakes.
void compare_forces(const Definition& definition, const Position& original, const Position& scaled, double scale) {
  constexpr int slowest = -12, fastest = 1;  // powers of ten
  constexpr double tolerance = 1e-8, least = 1e-280;
  double worst = tolerance;
  std::string problem;
  for (int power = slowest - 1; power <= fastest; ++power) {
    const double speed = power < slowest ? 0 : std::pow(10.0, power);
    const double wanted = original.force(speed) / scale, force = scaled.force(speed);
    const double error = std::fabs(force - wanted) / (std::fabs(wanted) + least);
    if (!(error > worst)) continue;
    worst = error;
    problem = "on a chain of scale " + digits(scale) + " its force at w = " + digits(speed) + " is " + digits(force) +
              " in place of f / scale = " + digits(wanted);
  }
  if (!problem.empty()) refuse(definition, problem);
}

std::vector<double> values_of(const Friction& friction) {
  std::vector<double> values;
  for (const Parameter& p : friction.definition().parameters) values.push_back(friction.parameter(p.name));
  return values;
}

}  // namespace

void check_scaling(const Friction& original, const Friction& scaled, double scale) {
  const Definition& definition = original.definition();
  Position one(original, probe_law(definition, values_of(original)));
  Position stretched(scaled, probe_law(definition, values_of(scaled)));
  compare_forces(definition, one, stretched, scale);
  if (definition.state.empty()) return;
  struct History {
    double velocity, time;
  };
  for (const History& h : {History{0, 0.5}, {1e-3, 2}, {0.2, 1}, {3, 0.3}}) {
    one.slip(h.velocity, h.time);
    stretched.slip(h.velocity, scale * h.time);
    compare_forces(definition, one, stretched, scale);
  }
}

void check_no_force(const Definition& definition, const std::vector<double>& values) {
  const std::shared_ptr<const Law> law = probe_law(definition, values);
  std::vector<double> state(definition.state.size());
  law->evolution().start(state);
  for (const double speed : {0.0, 1e-3, 1.0})
    if (const double force = law->strength(speed, state); force > 0)
      refuse(definition, "its force at w = " + digits(speed) + " is " + digits(force, 6) +
                             ", but none of its parameters is a force > 0");
}

}  // namespace slipfront::friction
