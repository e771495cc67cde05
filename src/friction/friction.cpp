#include "slipfront/friction/friction.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "foundation/text/digits.hpp"
#include "friction/scaling.hpp"
#include "slipfront/error.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::friction {

const Definition& no_law();

namespace {

bool in_range(const Parameter& p, double value) {
  return std::isfinite(value) && (p.without_least ? value > p.least : value >= p.least) && value <= p.most;
}

std::string range_of(const Parameter& p) {
  const std::string most = std::isfinite(p.most) ? " and <= " + digits(p.most) : ", finite";
  return (p.without_least ? "> " : ">= ") + digits(p.least) + most;
}

}  // namespace

Friction::Friction() : Friction(no_law(), {}) {}

Friction::Friction(const Definition& definition, std::vector<double> values, Closure closure, Curve curve)
    : definition_(&definition),
      values_(std::move(values)),
      curve_(std::move(curve)),
      closure_(closure),
      law_(definition.make(values_, curve_)) {
  for (std::size_t i = 0; i < values_.size(); ++i)
    acts_ = acts_ || (definition.parameters[i].dimension == Dimension::force && values_[i] > 0);
  if (!acts_) check_no_force(definition, values_);
  contacts_ = {.ageing = parameter("contact_ageing"),
               .age = parameter("contact_time"),
               .dilatancy = parameter("dilatancy"),
               .drainage = parameter("drainage_time"),
               .ambient = parameter("pore_pressure")};
  linear_ = law_->linear_coefficient();
  std::vector<double> memory(variables());
  law_->start(memory);
  at_rest_ = law_->strength(0, memory);
}

Friction Friction::with(Closure closure) const { return {*definition_, values_, closure, curve_}; }

double Friction::parameter(std::string_view name) const {
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (definition_->parameters[i].name == name) return values_[i];
  return 0;
}

Friction Friction::scaled_by(double scale) const {
  std::vector<double> values = values_;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Dimension dimension = definition_->parameters[i].dimension;
    if (dimension == Dimension::force) values[i] /= scale;
    if (dimension == Dimension::slip || dimension == Dimension::time) values[i] *= scale;
  }
  Friction scaled(*definition_, std::move(values), closure_, curve_);
  check_scaling(*this, scaled, scale);
  return scaled;
}

void Friction::check() const {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Parameter& p = definition_->parameters[i];
    if (!in_range(p, values_[i]))
      throw InputError({.key = "friction." + std::string(p.name),
                        .value = digits(values_[i]),
                        .problem = "out of range",
                        .allowed = range_of(p)});
  }
}

double Friction::contact_at_start() const {
  if (!contacts_.act()) return 1;
  std::vector<double> theta(variables());
  law_->start(theta);
  return std::sqrt(contacts_.strength(theta[0], 0));
}

/// The oldest contacts are those that rest; a slip that renews them sucks at the pores, most where they do not drain.
double Friction::contact_growth(double time) const {
  if (!contacts_.act()) return 1;
  constexpr double fastest = 10;
  constexpr int samples = 200;
  std::vector<double> theta(variables());
  law_->start(theta);
  const double oldest = theta[0] + std::fmax(time, 0);
  const double youngest = std::fmin(theta[0], parameter("characteristic_slip") / fastest);
  double most = 1;
  for (int i = 0; i <= samples; ++i) {
    const double at = youngest * std::pow(oldest / youngest, static_cast<double>(i) / samples);
    const double excess = -contacts_.dilatancy * std::log(oldest / at);
    most = std::fmax(most, std::sqrt(contacts_.strength(at, excess)) / contact_at_start());
  }
  return most;
}

double Friction::force(double velocity, Memory memory) const {
  return velocity == 0 ? 0 : std::copysign(law_->strength(std::fabs(velocity), memory), velocity);
}

double Friction::velocity_after(double free, double weight, Memory memory) const {
  return std::copysign(law_->speed_after(std::fabs(free), weight, memory), free);
}

double Friction::momentum_loss(const State& state, double contact, Memory memory) const {
  if (!acts_ || state.empty() || state.phi == 0) return 0;
  const double k = train::averages(state).k * contact;
  return std::copysign(k * mean_strength(state, contact, memory), state.phi);
}

}  // namespace slipfront::friction
