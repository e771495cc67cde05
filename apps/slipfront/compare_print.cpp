#include "compare_print.hpp"

#include <cmath>

#include "batch.hpp"
#include "json.hpp"
#include "long_run.hpp"

using namespace slipfront;
using namespace slipfront::setup;

namespace {

double last(const Level& level, const Quantity& quantity) { return quantity.get(level.snapshots.back()); }

Json json_level(const Level& level, const Level* reference) {
  const output::Snapshot& s = level.snapshots.back();
  Json j = {{"level", level.name},
            {"closure", level.closure.empty() ? Json() : Json(level.closure)},
            {"scale", json_of(level.scale)}};
  for (const Quantity& q : compared_quantities()) j[q.key] = q.get(s);
  j["stress_at_origin"] = s.stress_at_origin;
  j["peak_position"] = s.peak_position;
  j["trailing_front"] = s.fronts.trailing;
  j["energy_dissipated"] = s.energy.dissipated;
  j["window"] = json_of(level.window);
  j["smooth_window"] = json_of(level.smooth_window);
  j["wall_seconds"] = level.wall_seconds;
  for (const Quantity& q : compared_quantities())
    j["difference"][q.key] = reference ? Json(q.get(s) - last(*reference, q)) : Json();
  return j;
}

void print_json(const scenario::Scenario& s, const std::vector<Level>& levels) {
  const std::optional<double> C = s.friction.linear_coefficient();
  Json j = {{"time", s.end},
            {"friction_coefficient", json_of(C)},
            {"damping_number", C ? Json(*C * s.end) : Json()},
            {"reference", "pulse-consistent"},
            {"levels", Json::array()}};
  for (const Level& level : levels) j["levels"].push_back(json_level(level, reference_level(levels)));
  for (const Quantity& q : compared_quantities()) {
    const Trend t = trend_of(levels, q);
    j["trend"][q.key] = {{"exponent", t.exponent}, {"extrapolated", t.extrapolated}, {"difference", t.difference}};
  }
  j["notes"] = notes_on(s, levels);
  put(text_of(j) + "\n");
}

/// Gamma belongs to viscous friction; other laws have their parameters.
std::string friction_in_words(const friction::Friction& f, double time) {
  if (const auto C = f.linear_coefficient()) return fmt::format("C = {:.6g}, Gamma = C t = {:.6g}", *C, *C * time);
  return parameters_in_words(f);
}

std::string cell(double value, const char* unit = "") {
  return std::isfinite(value) ? fmt::format("{:>13}", fmt::format("{:.5g}{}", value, unit))
                              : fmt::format("{:>13}", "-");
}

/// Slip and slip velocities differ by a share of the reference, fronts by a length.
bool is_front(const Quantity& q) { return std::string_view(q.key).find("front") != std::string_view::npos; }

std::string difference_cell(double difference, double theory, const Quantity& q) {
  if (is_front(q)) return std::isfinite(difference) ? fmt::format("{:>+13.5f}", difference) : cell(difference);
  const double percent = 100 * difference / theory;
  return std::isfinite(percent) ? fmt::format("{:>+11.3f} %", percent) : cell(percent);
}

void print_table(const scenario::Scenario& s, const std::vector<Level>& levels) {
  const Level* reference = reference_level(levels);
  put(fmt::format("{}{}t = {:.6g}, {}\n\n{:<18}", s.title, s.title.empty() ? "" : ": ", s.end,
                  friction_in_words(s.friction, s.end), "at the end"));
  for (const Quantity& q : compared_quantities()) put(fmt::format("{:>13}", q.heading));
  put(fmt::format("{:>10}\n{:<18}", "seconds", ""));
  for (const char* unit : {"b / (2 pi)", "c A / pi", "c A / pi", "b / A", "b / A", "b / A"})
    put(fmt::format("{:>13}", unit));
  put("\n");
  for (const Level& level : levels) {
    put(fmt::format("{:<18}", level.name));
    for (const Quantity& q : compared_quantities()) put(cell(last(level, q)));
    put(fmt::format("{:>10.2g}\n", level.wall_seconds));
  }
  if (!reference) return;
  put("\ndifference from pulse-consistent\n");
  for (const Level& level : levels) {
    if (&level == reference) continue;
    put(fmt::format("{:<18}", level.name));
    for (const Quantity& q : compared_quantities())
      put(difference_cell(last(level, q) - last(*reference, q), last(*reference, q), q));
    put("\n");
  }
  std::string exponents, extrapolated, left;
  for (const Quantity& q : compared_quantities()) {
    const Trend t = trend_of(levels, q);
    exponents += cell(t.exponent);
    extrapolated += cell(t.extrapolated);
    left += difference_cell(t.difference, last(*reference, q), q);
  }
  put(fmt::format("\ntrend of the chain with scale\n{:<18}{}\n{:<18}{}\n", "falls as s^-p, p =", exponents,
                  "at infinite scale", extrapolated));
  put(fmt::format("{:<18}{}\n\n", "less pulse", left));
  for (const std::string& note : notes_on(s, levels)) put(note + "\n");
}

}  // namespace

void print_comparison(const scenario::Scenario& s, const std::vector<Level>& levels, bool json) {
  json ? print_json(s, levels) : print_table(s, levels);
}
