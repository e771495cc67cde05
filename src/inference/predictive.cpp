#include "slipfront/inference/predictive.hpp"

#include <limits>
#include <stdexcept>

namespace slipfront::inference {

using catalogue::Measured;
using catalogue::Observation;

namespace {

constexpr std::array<ObservedQuantity, std::tuple_size_v<ObservedValues>> observed_declarations = {{
    {"rupture_velocity", "rupture velocity", "m s-1"},
    {"slip_velocity", "slip velocity", "m s-1"},
    {"slip", "slip", "m"},
    {"contact_ratio", "contact ratio A", "1"},
    {"stress_drop", "stress drop", "Pa"},
    {"normal_stress", "normal stress", "Pa"},
    {"friction_coefficient", "coefficient C of the viscous friction", "1"},
}};

}  // namespace

std::span<const ObservedQuantity> observed_quantities() { return observed_declarations; }

std::size_t position_of(std::string_view name) {
  for (std::size_t i = 0; i < observed_declarations.size(); ++i)
    if (observed_declarations[i].name == name) return i;
  throw std::out_of_range("no observed quantity of this name");
}

ObservedValues observed_values(const Observation& o) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto middle = [](const std::optional<Measured>& m) { return m ? m->middle() : none; };
  return {middle(o.rupture_velocity_m_s), middle(o.slip_velocity_m_s), middle(o.slip),
          o.contact_ratio.value_or(none), middle(o.stress_drop),       middle(o.normal_stress),
          middle(o.friction_coefficient)};
}

double repeated(const Measured& m, double x, double probability) {
  if (m.is_exact()) return x;
  Measured around = m;
  around.low = around.high = x;
  if (m.shape == Measured::Shape::range) {
    around.low = x - (m.high - m.low) / 2;
    around.high = x + (m.high - m.low) / 2;
  } else if (m.shape == Measured::Shape::split) {
    // The error below an observed value is its distance from a smaller true value, so the observed value is above.
    around.shape = Measured::Shape::normal;
    around.spread = probability > 0.5 ? m.spread_below : m.spread;
  }
  return around.quantile(probability);
}

}  // namespace slipfront::inference
