#include "averages/pulse/grid/cells.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace slipfront::pulse {
namespace {

std::ptrdiff_t at(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

}  // namespace

double Cells::left_face(std::size_t cell) const {
  double x = left_edge();
  for (std::size_t i = 0; i < cell; ++i) x += width(i);
  return x;
}

void Cells::find_centres(std::vector<double>& x) const {
  double face = left_edge();
  for (std::size_t i = 0; i < size(); ++i) {
    x[i] = face + width(i) / 2;
    face += width(i);
  }
}

void Cells::insert(std::size_t before, const Cell& cell) {
  unknowns.insert(unknowns.begin() + at(size() + before), cell.momentum);
  unknowns.insert(unknowns.begin() + at(before), cell.width);
  charge.insert(charge.begin() + at(before), cell.charge);
  s.insert(s.begin() + at(before), cell.s);
}

void Cells::erase(std::size_t i) {
  unknowns.erase(unknowns.begin() + at(size() + i));
  unknowns.erase(unknowns.begin() + at(i));
  s.erase(s.begin() + at(i));
  charge.erase(charge.begin() + at(i));
}

void Cells::join(std::size_t i, std::size_t into) {
  if (charge[i] > charge[into]) s[into] = s[i];
  charge[into] += charge[i];
  width(into) += width(i);
  momentum(into) += momentum(i);
  erase(i);
}

StateGrid::StateGrid(const friction::Friction& friction, double left, double right, std::size_t count)
    : friction_(friction),
      left_(left),
      spacing_((right - left) / static_cast<double>(count)),
      count_(count),
      each_(friction.state_size()) {}

/// Means over the intervals of the grid, because friction may vary within an interval.
std::vector<double> StateGrid::initial() const {
  const int samples = friction_.varies() ? 8 : 1;
  std::vector<double> values(each_ * count_), sample(each_);
  for (std::size_t j = 0; each_ > 0 && j < count_; ++j)
    for (int k = 0; k < samples; ++k) {
      friction_.start(left_ + (static_cast<double>(j) + (k + 0.5) / samples) * spacing_, 0, sample);
      for (std::size_t v = 0; v < each_; ++v) values[each_ * j + v] += (sample[v] - values[each_ * j + v]) / (k + 1);
    }
  return values;
}

void StateGrid::find_passing(const std::vector<double>& x, const Passing& there, Passing& here) const {
  here.mean.assign(count_, 0.0);
  here.typical.assign(count_, 0.0);
  std::size_t i = 0;
  for (std::size_t j = 0; j < count_; ++j) {
    const double point = left_ + (static_cast<double>(j) + 0.5) * spacing_;
    while (i < x.size() && x[i] <= point) ++i;
    if (i == 0 || i == x.size()) continue;
    const double share = (point - x[i - 1]) / (x[i] - x[i - 1]);
    here.mean[j] = there.mean[i - 1] + share * (there.mean[i] - there.mean[i - 1]);
    here.typical[j] = there.typical[i - 1] + share * (there.typical[i] - there.typical[i - 1]);
  }
}

void StateGrid::advance(const Passing& passing, double time, std::vector<double>& values) const {
  friction_.evolution().advance_all(count_, {passing.mean.data(), passing.typical.data()}, time,
                                    {values.data(), each_});
}

void StateGrid::look_up(const std::vector<double>& values, std::size_t size, const double* x, double* state) const {
  if (each_ == 0) return;
  const double last = static_cast<double>(count_ - 1), per_spacing = 1 / spacing_;
  for (std::size_t i = 0; i < size; ++i) {
    const double at = (x[i] - left_) * per_spacing - 0.5, position = at > 0 ? std::fmin(at, last) : 0.0;
    const int j = std::min(static_cast<int>(position), static_cast<int>(count_) - 2);
    const double share = position - j;
    const double* from = values.data() + static_cast<std::size_t>(j) * each_;
    for (std::size_t v = 0; v < each_; ++v) state[i * each_ + v] = from[v] + share * (from[each_ + v] - from[v]);
  }
}

}  // namespace slipfront::pulse
