#include "events/finite_fault/on_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/digits.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"
#include "theory/rupture/inverse.hpp"

namespace slipfront::finite_fault {
namespace {

constexpr std::size_t nodes = 8000;  // some hundreds to a column

}  // namespace

double SideStress::at(double d) const {
  if (d >= distance.back()) return stress.back();
  const auto above = std::upper_bound(distance.begin(), distance.end(), std::fmax(d, 0)) - distance.begin();
  const auto i = static_cast<std::size_t>(above);
  const double share = (std::fmax(d, 0) - distance[i - 1]) / (distance[i] - distance[i - 1]);
  const double value = std::lerp(stress[i - 1], stress[i], share);
  return value < least_stress ? 0 : value;
}

HeldSide::HeldSide(SideStress stress, double end) : stress_(std::move(stress)) {
  const auto speed_at = [](const State& s) { return s.empty() ? 0 : modulation::sound(s.psi).c0; };
  // Nothing that the pulse meets may come back from the end of the grid.
  const double beyond = 1.2 * end * speed_at(train::at_rest(stress_.stress.back()));
  length_ = stress_.distance.back() + beyond;
  node_ = length_ / static_cast<double>(nodes);
  double time = 0, slowness = 0;
  for (std::size_t i = 0; i <= nodes; ++i) {
    const State s = train::at_rest(stress_.at(node_ * static_cast<double>(i)));
    const double next = s.empty() ? std::numeric_limits<double>::infinity() : 1 / speed_at(s);
    if (i > 0) time += node_ * (slowness + next) / 2;
    slowness = next;
    pressure_.push_back(modulation::pressure(s.psi));
    time_.push_back(time);
  }
}

double HeldSide::front_time(double distance) const {
  const auto i = std::min(static_cast<std::size_t>(distance / node_), nodes - 1);
  const double share = distance / node_ - static_cast<double>(i);
  if (!(share > 0)) return time_[i];
  return std::isinf(time_[i + 1]) ? time_[i + 1] : std::lerp(time_[i], time_[i + 1], share);
}

pulse::Problem HeldSide::problem() const {
  const auto stress = [side = *this](double x) { return x > 0 ? 0 : side.stress_.at(-x); };
  const auto load = [side = *this](double x, double) {
    if (x > 0 || -x >= side.length_) return 0.0;
    const double k = side.stress_.at(-x);
    if (!(k > 0)) return 0.0;
    const auto i = std::min(static_cast<std::size_t>(-x / side.node_), nodes - 1);
    return (side.pressure_[i] - side.pressure_[i + 1]) / (side.node_ * k);
  };
  return {.stress = stress,
          .forcing = load,
          .friction = {},
          .left = -length_,
          .right = 0.1 * length_,
          .corner = 0,
          .cells = 1600};
}

namespace {

const SourceSegment& segment_of_hypocentre(const FiniteSource& source) {
  for (const SourceSegment& segment : source.segments)
    if (segment.has_hypocentre) return segment;
  return source.segments.front();
}

double moment_of(const SourceSegment& segment) {
  double moment = 0;
  for (const SourcePoint& point : segment.points) moment += point.shear_modulus() * point.slip * segment.cell_area();
  return moment;
}

/// Finds the gradient of the slip, from differences between neighbours. Outside of the model the slip is 0.
void find_gradients(OnPlane& fault) {
  const auto nx = static_cast<std::ptrdiff_t>(fault.x.size()), ny = static_cast<std::ptrdiff_t>(fault.y.size());
  const auto slip = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const bool inside = i >= 0 && i < nx && j >= 0 && j < ny;
    return inside ? fault.slip[fault.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j))] : 0;
  };
  double sum = 0, weight = 0;
  for (std::ptrdiff_t j = -1; j < ny; ++j)
    for (std::ptrdiff_t i = -1; i < nx; ++i) {
      const double along = (slip(i + 1, j) - slip(i, j)) / fault.cell_length,
                   up = (slip(i, j + 1) - slip(i, j)) / fault.cell_width, size = std::hypot(along, up);
      fault.largest_gradient = std::fmax(fault.largest_gradient, size);
      sum += slip(i, j) * size;
      weight += slip(i, j);
    }
  fault.mean_gradient = sum / weight;
}

}  // namespace

OnPlane on_plane(const FiniteSource& source) {
  const SourceSegment& segment = segment_of_hypocentre(source);
  OnPlane fault;
  fault.cell_length = segment.cell_length;
  fault.cell_width = segment.cell_width;
  const double left = -segment.cell_length * static_cast<double>(segment.along_strike) / 2;
  for (std::size_t i = 0; i < segment.along_strike; ++i)
    fault.x.push_back(left + (static_cast<double>(i) + 0.5) * segment.cell_length - segment.hypocentre_along_strike);
  for (std::size_t j = segment.down_dip; j-- > 0;) {
    fault.y.push_back(segment.hypocentre_down_dip - (static_cast<double>(j) + 0.5) * segment.cell_width);
    for (std::size_t i = 0; i < segment.along_strike; ++i) {
      const SourcePoint& point = segment.points[j * segment.along_strike + i];
      fault.slip.push_back(std::fmax(point.slip, 0));
      fault.rupture_time.push_back(point.rupture_time);
      if (point.slip > 0) fault.end = std::fmax(fault.end, point.rupture_time + point.rise_time);
    }
  }
  fault.moment = moment_of(segment);
  fault.largest_slip = *std::max_element(fault.slip.begin(), fault.slip.end());
  find_gradients(fault);
  if (source.segments.size() > 1) {
    double all = 0;
    for (const SourceSegment& any : source.segments) all += moment_of(any);
    fault.note = "only the segment of the hypocentre is computed, which has " + digits(100 * fault.moment / all, 3) +
                 " % of the moment";
  }
  return fault;
}

std::vector<std::vector<double>> slip_to_come(const OnPlane& fault, double margin) {
  const auto with_margin = [margin](const std::vector<double>& centres, double cell) {
    std::vector<double> all = {centres.front() - cell / 2 - margin, centres.front() - cell};
    all.insert(all.end(), centres.begin(), centres.end());
    all.push_back(centres.back() + cell);
    all.push_back(centres.back() + cell / 2 + margin);
    return all;
  };
  const std::vector<double> x = with_margin(fault.x, fault.cell_length), y = with_margin(fault.y, fault.cell_width);
  std::vector<std::vector<double>> rows;
  rows.reserve(x.size() * y.size());
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      const bool inside = i >= 2 && i < x.size() - 2 && j >= 2 && j < y.size() - 2;
      rows.push_back({x[i], y[j], fault.largest_slip - (inside ? fault.slip[fault.at(i - 2, j - 2)] : 0)});
    }
  return rows;
}

std::vector<double> moment_rate(const FiniteSource& source, double interval, std::size_t count) {
  std::vector<double> rate(count, 0.0);
  for (const SourcePoint& point : segment_of_hypocentre(source).points) {
    const double per = point.shear_modulus() * segment_of_hypocentre(source).cell_area();
    double time = point.rupture_time + source.time_step / 2;
    for (const double slip_rate : slip_rates(source, point)) {
      const double row = time / interval;
      if (row >= 0 && row < static_cast<double>(count))
        rate[static_cast<std::size_t>(row)] += per * slip_rate * source.time_step / interval;
      time += source.time_step;
    }
  }
  return rate;
}

}  // namespace slipfront::finite_fault
