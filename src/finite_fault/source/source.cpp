#include "finite_fault/source/source.hpp"

#include <algorithm>
#include <cmath>

#include "finite_fault/along_fault.hpp"
#include "finite_fault/source/build.hpp"
#include "foundation/text/digits.hpp"
#include "slipfront/friction_ratio/table.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::finite_fault {

using catalogue::FaultModel;

namespace {

/// Sigma- of a pulse with this rupture velocity, within the range of the table of friction ratios.
double pulse_stress(double velocity, double speed) {
  const auto [least, most] = friction_ratio::stress_range();
  const double fastest = rupture::from_stress(most).rupture_velocity;
  const double ratio = std::fmin(velocity / speed, fastest);
  return std::clamp(rupture::from_rupture_velocity(ratio).stress, least, most);
}

/// A step of 1, 2 or 5 times a power of ten, at most a tenth of the shortest rise time. If rise times differ by more
/// than a factor of 200, it is at most 1/2000 of the longest one instead. It is never below a microsecond.
double step_for(const FiniteSource& source) {
  double shortest_time = HUGE_VAL, longest = 0;
  for (const SourceSegment& segment : source.segments)
    for (const SourcePoint& p : segment.points)
      if (p.slip != 0) {
        shortest_time = std::fmin(shortest_time, p.rise_time);
        longest = std::fmax(longest, p.rise_time);
      }
  const double wanted = std::fmax(std::fmax(shortest_time / 10, longest / 2000), 1e-6);
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  const double mantissa = wanted / decade * (1 + 1e-12);
  return decade * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

/// Fraction of the slip at time `share` times the rise time: t R(Gamma t / T), where R is the mean of W over time.
double released(const FiniteSource& source, double share) {
  if (share >= 1) return 1;
  const auto slip_to = [&](double s) {
    return s * friction_ratio::evaluate(friction_ratio::Measure::time_mean, source.closure, source.stress,
                                        source.damping_number * s)
                   .value;
  };
  return slip_to(share) / slip_to(1);
}

/// The velocity that stands for the whole rupture, and how it was chosen.
struct ChosenVelocity {
  double m_s;
  std::string how;
};
ChosenVelocity chosen_velocity(const FaultModel& model, double s_wave_speed) {
  const auto& stated = model.observation.rupture_velocity_m_s;
  if (stated) return {stated->middle(), "avVr of the file"};
  return {0.8 * s_wave_speed, "0.8 of the S speed at the hypocentre, because the file has no avVr"};
}

}  // namespace

FiniteSource finite_source(const FaultModel& model, const medium::Defaults& defaults, const SourceOptions& options) {
  source::Builder builder(model, defaults);
  FiniteSource out = builder.planes();
  out.damping_number = options.damping_number;
  out.closure = options.closure;
  const medium::Elastic elastic = medium::elastic(model.observation, defaults);
  out.poisson_ratio = elastic.poisson_ratio;
  const ChosenVelocity velocity = chosen_velocity(model, builder.s_wave_speed_at_hypocentre());
  out.stress = pulse_stress(velocity.m_s, elastic.speed);
  builder.add_rupture_times(out, velocity.m_s, velocity.how);
  builder.add_rise_times(out);
  builder.add_local_velocities(out, elastic.speed);
  out.time_step = step_for(out);
  out.notes.push_back("slip rates: W(0, t) of the pulse with Sigma- = " + digits(out.stress, 4) +
                      " mu A / pi and damping number " + digits(out.damping_number, 4) +
                      " at the end of the rise time (closure " + friction::name_of(out.closure) +
                      "), means over steps of " + shortest(out.time_step) + " s");
  return out;
}

std::vector<double> slip_rates(const FiniteSource& source, const SourcePoint& point) {
  std::vector<double> rates;
  if (point.slip == 0) return rates;
  const auto steps = static_cast<std::size_t>(std::ceil(point.rise_time / source.time_step * (1 - 1e-12)));
  double before = 0;
  for (std::size_t step = 1; step <= steps; ++step) {
    const double end = static_cast<double>(step) * source.time_step;
    const double after = step < steps ? released(source, end / point.rise_time) : 1;
    rates.push_back(point.slip * (after - before) / source.time_step);
    before = after;
  }
  return rates;
}

}  // namespace slipfront::finite_fault
