#include "finite_fault/pulse_along_fault.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "finite_fault/fault_columns.hpp"
#include "finite_fault/held_side.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/medium.hpp"
#include "slipfront/rupture/relations.hpp"

namespace slipfront::finite_fault {
namespace {

constexpr double most_stress = 5;

/// The stress on one side of the hypocentre (`sign` is -1 or 1), with distances in units of `length`. The stress at the
/// hypocentre is interpolated between its neighbours. After the last column it is constant.
SideStress side_of(const FaultPulse& p, double sign, double length) {
  const std::size_t n = p.x.size();
  SideStress all;
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = sign > 0 ? j : n - 1 - j;
    all.distance.push_back(sign * p.x[i] / length);
    all.stress.push_back(p.stress[i]);
  }
  SideStress side{{0}, {0}};
  for (std::size_t i = 0; i < n; ++i) {
    if (all.distance[i] <= 0) {
      side.stress[0] = all.stress[i];
      continue;
    }
    if (side.distance.size() == 1 && i > 0 && all.distance[i - 1] < 0)
      side.stress[0] =
          std::lerp(all.stress[i - 1], all.stress[i], all.distance[i - 1] / (all.distance[i - 1] - all.distance[i]));
    if (i == 0) side.stress[0] = all.stress[i];
    side.distance.push_back(all.distance[i]);
    side.stress.push_back(all.stress[i]);
  }
  return side;
}

/// Computes one side, and fills the front time and the slip (in b / 2 pi) of its columns. The column at the hypocentre
/// gets the mean slip of both sides. The pulse has distances in units of `length` and times in length / c.
void run_side(FaultPulse& p, double sign, double length, double speed) {
  const SideStress stress = side_of(p, sign, length);
  if (stress.distance.size() < 2) return;
  const double end = p.end * speed / length;
  const HeldSide side(stress, end);
  const bool starts = stress.stress[0] >= least_stress;  // otherwise there is no stress drop that could start a pulse
  std::optional<pulse::Solver> solver;
  if (starts) {
    solver.emplace(side.problem());
    solver->advance_to(end);
  }
  const auto view = solver ? std::optional(solver->view()) : std::nullopt;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double distance = sign * p.x[i] / length;
    if (distance < 0) continue;
    const double time = side.front_time(distance) * length / speed;
    if (starts && std::isfinite(time)) p.front_time[i] = time;
    const double slip = view ? solver->slip_at(*view, -distance) : 0;
    const bool both = distance == 0 && p.x.front() < 0 && p.x.back() > 0;
    p.pulse_slip[i] += slip * (both ? 0.5 : 1);
  }
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n, mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0, ab = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    aa += (a[i] - ma) * (a[i] - ma), ab += (a[i] - ma) * (b[i] - mb), bb += (b[i] - mb) * (b[i] - mb);
  if (!(aa > 0 && bb > 0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

/// Scales the slip of the pulse to that of the model by least squares. With lengths in units of `length`, u = 1 is a
/// slip of A length / pi between both faces, so we obtain A from the factor.
void fit_slip(FaultPulse& p, double length) {
  p.correlation_of_slip = correlation(p.model_slip, p.pulse_slip);
  double both = 0, square = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i)
    both += p.model_slip[i] * p.pulse_slip[i], square += p.pulse_slip[i] * p.pulse_slip[i];
  if (!(both > 0)) return;
  const double factor = both / square;
  for (double& slip : p.pulse_slip) slip *= factor;
  p.contact_ratio = 2 * std::numbers::pi * factor / (medium::face_factor * length);
}

/// The exact slip ahead of the front is 0, so any slip there is the error of the solver.
void measure_error(FaultPulse& p) {
  double ahead = 0, largest = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double slip = std::fabs(p.pulse_slip[i]);
    largest = std::fmax(largest, slip);
    if (!p.front_time[i] || *p.front_time[i] > p.end) ahead = std::fmax(ahead, slip);
  }
  if (largest > 0) p.slip_error = ahead / largest;
}

/// Computes the ratio of mean front velocities from the mean rupture times, weighted with slip, over the columns that
/// have both times.
void compare_fronts(FaultPulse& p) {
  double model = 0, pulse = 0;
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    if (p.front_time[i] && *p.front_time[i] <= p.end) ++p.reached;
    if (!p.front_time[i] || !p.model_time[i] || p.x[i] == 0) continue;
    model += p.model_slip[i] * *p.model_time[i];
    pulse += p.model_slip[i] * *p.front_time[i];
  }
  if (model > 0 && pulse > 0) p.front_velocity_ratio = model / pulse;
}

}  // namespace

double stress_by_slip(double event_stress, double share) {
  if (!(share > 0)) return 0;
  const double W = share * rupture::from_stress(event_stress).slip_velocity;
  if (W < rupture::from_stress(least_stress).slip_velocity) return 0;
  if (W > rupture::from_stress(most_stress).slip_velocity) return most_stress;
  return rupture::from_slip_velocity(W).stress;
}

FaultPulse pulse_along_fault(const std::vector<LocalState>& states, double stress, double speed) {
  const FaultColumns found = columns_of(states);
  FaultPulse p;
  p.reason = found.reason;
  if (!p.reason.empty()) return p;
  p.end = found.end;
  double slip = 0, square = 0;
  for (const FaultColumn& c : found.columns) slip += c.slip, square += c.slip * c.slip;
  for (const FaultColumn& c : found.columns) {
    p.x.push_back(c.x);
    p.model_slip.push_back(c.slip);
    p.model_time.push_back(std::isnan(c.rupture_time) ? std::nullopt : std::optional(c.rupture_time));
    p.stress.push_back(stress_by_slip(stress, c.slip * slip / square));
  }
  p.front_time.resize(p.x.size());
  p.pulse_slip.resize(p.x.size());
  const double length = p.x.back() - p.x.front();
  try {
    for (const double sign : {-1.0, 1.0}) run_side(p, sign, length, speed);
  } catch (const NumericsError& error) {
    FaultPulse none;
    none.reason = std::string("the pulse solver failed: ") + error.what();
    return none;
  }
  measure_error(p);
  fit_slip(p, length);
  compare_fronts(p);
  return p;
}

std::span<const PulseQuantity> pulse_quantities() {
  static constexpr PulseQuantity quantities[] = {
      {{"pulse_front_velocity_ratio", "velocity of the front, pulse over model", "", "Eqs. 6-7"},
       [](const FaultPulse& p) { return p.front_velocity_ratio; }},
      {{"pulse_correlation_of_slip", "correlation of slip along strike, pulse and model", "", "Eqs. 6-7"},
       [](const FaultPulse& p) { return p.correlation_of_slip; }},
      {{"pulse_columns", "columns of the model along strike", "", ""},
       [](const FaultPulse& p) { return std::optional(static_cast<double>(p.x.size())); },
       true},
      {{"pulse_columns_reached", "columns that the front of the pulse has reached", "", ""},
       [](const FaultPulse& p) { return std::optional(static_cast<double>(p.reached)); },
       true},
      {{"pulse_slip_error", "largest slip ahead of the front (exactly 0) over the largest slip", "", ""},
       [](const FaultPulse& p) { return p.slip_error; }},
      {{"pulse_contact_ratio", "A from the size of the slip in the model", "", "Eq. 1"},
       [](const FaultPulse& p) { return p.contact_ratio; }},
  };
  return quantities;
}

}  // namespace slipfront::finite_fault
