#include <cmath>
#include <string>
#include <vector>

#include "run/compare.hpp"

namespace slipfront::run {

const std::vector<output::Scalar>& compared_numbers() {
  static const std::vector<output::Scalar> compared = [] {
    std::vector<output::Scalar> all(output::scalars().begin(), output::scalars().end());
    std::erase_if(all, [](const output::Scalar& number) { return number.heading.empty(); });
    return all;
  }();
  return compared;
}

const Level* reference_level(const std::vector<Level>& levels) {
  for (const Level& level : levels)
    if (level.name == "pulse-consistent" && !level.snapshots.empty()) return &level;
  return nullptr;
}

Trend trend_of(const std::vector<Level>& levels, const output::Scalar& number) {
  Trend trend;
  const Level* reference = reference_level(levels);
  if (!reference) return trend;
  const double theory = number.get(reference->snapshots.back());
  std::vector<double> scale, value;  // ascending
  for (const Level& level : levels)
    if (level.scale && !level.snapshots.empty()) {
      scale.push_back(*level.scale);
      value.push_back(number.get(level.snapshots.back()));
    }
  const std::size_t n = scale.size();
  if (n < 2) return trend;
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = std::log(scale[i]), b = std::log(std::fabs(value[i] - theory));
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
  }
  const auto count = static_cast<double>(n);
  trend.exponent = -(count * xy - x * y) / (count * xx - x * x);
  if (trend.exponent < 0) return trend;  // the difference grows, so the values have no limit that we know
  trend.extrapolated = (scale[n - 1] * value[n - 1] - scale[n - 2] * value[n - 2]) / (scale[n - 1] - scale[n - 2]);
  trend.difference = trend.extrapolated - theory;
  return trend;
}

namespace {

/// The reason why quantities have no value at infinite scale. Empty if all have one.
std::string note_on_limits(const std::vector<Level>& levels) {
  std::string names;
  for (const output::Scalar& q : compared_numbers())
    if (trend_of(levels, q).exponent < 0) names += (names.empty() ? "" : ", ") + std::string(q.about.name);
  if (names.empty()) return {};
  return "no value at infinite scale for " + names +
         ": the difference between chain and pulse does not fall with the scale, over the scales run";
}

}  // namespace

std::vector<std::string> notes_on(const scenario::Scenario& s, const std::vector<Level>& levels) {
  std::vector<std::string> notes;
  const bool two_sides = s.initial.even_ends;
  if (!s.friction.acts() && !s.pulse.many_trains && two_sides && s.initial.stress_left > 0 &&
      s.initial.stress_right > 0 && s.initial.stress_left != s.initial.stress_right)
    notes.emplace_back(
        "without friction dislocations overtake each other, and one train with a shock loses their energy: no scale "
        "brings chain and pulse together, but pulse.trains = \"many\" does (docs/theory/9_trains.md)");
  notes.emplace_back(
      "* as an observer with a threshold sees it; on a chain with little friction phonons run ahead, and raising "
      "pulse.threshold hides them");
  if (const std::string note = note_on_limits(levels); !note.empty()) notes.push_back(note);
  notes.insert(notes.end(), s.warnings.begin(), s.warnings.end());
  for (const Level& level : levels)
    for (const std::string& warning : level.warnings) notes.push_back(level.name + ": " + warning);
  return notes;
}

}  // namespace slipfront::run
