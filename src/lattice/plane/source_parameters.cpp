#include "slipfront/lattice/plane/source_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/constants.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

/// The difference of f per cell, between the neighbours of `here` that are known; NaN without any, or without `here`.
double difference(double before, double here, double after) {
  if (std::isnan(here)) return none;
  if (!std::isnan(before) && !std::isnan(after)) return (after - before) / 2;
  return std::isnan(before) ? after - here : here - before;
}

/// Size of the gradient of f at each cell; NaN where f is.
std::vector<double> gradient(const MapGrid& grid, const std::vector<double>& f) {
  std::vector<double> size;
  size.reserve(f.size());
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const auto value = [&](int column, int row) {
        const bool inside = column >= 0 && column < grid.nx && row >= 0 && row < grid.ny;
        return inside ? f[grid.at(column, row)] : none;
      };
      const double here = value(i, j);
      size.push_back(std::hypot(difference(value(i - 1, j), here, value(i + 1, j)) / grid.dx,
                                difference(value(i, j - 1), here, value(i, j + 1)) / grid.dy));
    }
  return size;
}

double largest_rate(const std::vector<SeriesRow>& series) {
  double largest = 0;
  for (const SeriesRow& row : series) largest = std::fmax(largest, std::fabs(row.potency_rate));
  return largest;
}

/// The time at which the potency first passes `limit`, of either sign, by a straight line between two rows.
double time_of_potency(const std::vector<SeriesRow>& series, double limit) {
  for (std::size_t i = 1; i < series.size(); ++i) {
    const SeriesRow &before = series[i - 1], &after = series[i];
    if (before.potency / limit < 1 && after.potency / limit >= 1)
      return before.time + (after.time - before.time) * (limit - before.potency) / (after.potency - before.potency);
  }
  return none;
}

/// Calls each(dt, rate before, rate after) for the times between two rows.
template <class Each>
void for_each_interval(const std::vector<SeriesRow>& series, const Each& each) {
  for (std::size_t i = 1; i < series.size(); ++i)
    if (const double dt = series[i].time - series[i - 1].time; dt > 0)
      each(dt, series[i - 1].potency_rate, series[i].potency_rate);
}

}  // namespace

int Problem::rows_of_cells(int along_x) const {
  constexpr double fewest = 4, most = 10'000;
  return static_cast<int>(std::clamp(std::round((top - bottom) / (right - left) * along_x), fewest, most));
}

MapGrid grid_of(const Problem& problem, const Schedule& schedule) {
  return {.nx = schedule.nx,
          .ny = schedule.ny,
          .dx = (problem.right - problem.left) / schedule.nx,
          .dy = (problem.top - problem.bottom) / schedule.ny * schedule.wave_speed_ratio};
}

std::vector<double> rupture_velocity(const MapGrid& grid, const std::vector<double>& rupture_time) {
  std::vector<double> velocity = gradient(grid, rupture_time);
  for (double& value : velocity) value = value > 0 ? 1 / value : none;
  return velocity;
}

std::vector<double> rise_time(const std::vector<double>& slip, const std::vector<double>& velocity_squared) {
  std::vector<double> time;
  time.reserve(slip.size());
  for (std::size_t i = 0; i < slip.size(); ++i)
    time.push_back(velocity_squared[i] > 0 ? slip[i] * slip[i] / velocity_squared[i] : none);
  return time;
}

std::vector<double> stress(const MapGrid& grid, const std::vector<double>& mean_slip) {
  return gradient(grid, mean_slip);
}

double stress_drop(const std::vector<double>& before, const std::vector<double>& after,
                   const std::vector<double>& slip) {
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < slip.size(); ++i) {
    sum += (before[i] - after[i]) * std::fabs(slip[i]);
    weight += std::fabs(slip[i]);
  }
  return weight > 0 ? sum / weight : none;
}

double duration(const std::vector<SeriesRow>& series) {
  double largest = 0;
  for (const SeriesRow& row : series)
    if (std::fabs(row.potency) > std::fabs(largest)) largest = row.potency;
  if (largest == 0) return none;
  return time_of_potency(series, 0.95 * largest) - time_of_potency(series, 0.05 * largest);
}

bool has_ended(const std::vector<SeriesRow>& series) {
  return !series.empty() && std::fabs(series.back().potency_rate) < 0.05 * largest_rate(series);
}

double corner_frequency(const std::vector<SeriesRow>& series) {
  if (!has_ended(series)) return none;
  double of_rate = 0, of_change = 0;
  for_each_interval(series, [&](double dt, double before, double after) {
    of_rate += dt * (before * before + before * after + after * after) / 3;
    of_change += (after - before) * (after - before) / dt;
  });
  return of_rate > 0 ? std::sqrt(of_change / of_rate) / (2 * pi) : none;
}

std::vector<double> spectrum_frequencies(const std::vector<SeriesRow>& series) {
  constexpr int count = 100;
  if (series.size() < 3) return {};
  const double time = series.back().time - series.front().time;
  const double first = 0.1 / time, last = static_cast<double>(series.size() - 1) / (2 * time);
  std::vector<double> frequencies;
  frequencies.reserve(count);
  for (int i = 0; i < count; ++i) frequencies.push_back(first * std::pow(last / first, i / (count - 1.0)));
  return frequencies;
}

/// The rate is a straight line between two rows: int (R e^(-i w t)) by parts gives sums of R' (e^(-i w t)) / w^2.
std::vector<double> spectrum(const std::vector<SeriesRow>& series, const std::vector<double>& frequencies) {
  std::vector<double> amplitudes;
  amplitudes.reserve(frequencies.size());
  for (const double frequency : frequencies) {
    const double w = 2 * pi * frequency;
    double real = 0, imaginary = 0;
    for (std::size_t i = 1; i < series.size(); ++i) {
      const double dt = series[i].time - series[i - 1].time;
      const double middle = series[i - 1].time + dt / 2, half = w * dt / 2;
      const double mean = (series[i].potency_rate + series[i - 1].potency_rate) / 2,
                   rise = (series[i].potency_rate - series[i - 1].potency_rate) / 2;
      // The integral over the interval, with t = middle + s dt / 2 and s from -1 to 1: (mean + rise s) e^(-i w t).
      const double even = half > 1e-4 ? std::sin(half) / half : 1;
      const double odd = half > 1e-2 ? (std::sin(half) / half - std::cos(half)) / half : half / 3;
      const double c = std::cos(w * middle), s = std::sin(w * middle);
      real += dt * (mean * even * c - rise * odd * s);
      imaginary -= dt * (mean * even * s + rise * odd * c);
    }
    amplitudes.push_back(std::hypot(real, imaginary));
  }
  return amplitudes;
}

double arrest_radius(const std::vector<SeriesRow>& series) {
  if (series.empty()) return none;
  double largest = 0;
  for (const SeriesRow& row : series) largest = std::fmax(largest, row.front);
  const double end = series.back().time;
  for (const SeriesRow& row : series)
    if (row.front >= 0.999 * largest) return row.time < 0.9 * end && end > 0 ? largest : none;
  return none;
}

}  // namespace slipfront::plane
