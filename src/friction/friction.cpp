#include "slipfront/friction/friction.hpp"

#include <cmath>
#include <utility>

#include "friction/scaling.hpp"
#include "friction/state/contacts.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::friction {

Friction::Friction(const Definition& definition, std::vector<double> values, Closure closure, Curve curve)
    : definition_(&definition),
      values_(std::move(values)),
      curve_(std::move(curve)),
      closure_(closure),
      law_(definition.make(values_, curve_)) {
  for (std::size_t i = 0; i < values_.size(); ++i)
    acts_ = acts_ || (definition.parameters[i].dimension == Dimension::force && values_[i] > 0);
  if (!acts_) check_no_force(definition, values_);
  contacts_ = std::make_shared<const Contacts>(Contacts{.ageing = parameter("contact_ageing"),
                                                        .age = parameter("contact_time"),
                                                        .dilatancy = parameter("dilatancy"),
                                                        .drainage = parameter("drainage_time"),
                                                        .ambient = parameter("pore_pressure")});
  at_rest_ = law_->strength(0, state_at_start());
}

Friction Friction::with(Closure closure) const {
  Friction other(*definition_, values_, closure, curve_);
  other.varying_ = varying_;
  return other;
}

Friction Friction::with(std::string_view parameter, double value) const {
  std::vector<double> values = values_;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (definition_->parameters[i].name == parameter) values[i] = value;
  Friction other(*definition_, std::move(values), closure_, curve_);
  other.varying_ = varying_;
  return other;
}

Friction Friction::with(std::string_view parameter, AlongInterface value) const {
  Friction other = *this;
  other.varying_.insert_or_assign(std::string(parameter), std::move(value));
  return other;
}

double Friction::factor(double x, double y) const {
  const auto varying = varying_.find("coefficient");
  return varying == varying_.end() ? 1 : varying->second(x, y) / parameter("coefficient");
}

double Friction::parameter(std::string_view name) const {
  for (std::size_t i = 0; i < values_.size(); ++i)
    if (definition_->parameters[i].name == name) return values_[i];
  return 0;
}

Friction Friction::scaled_by(double scale) const {
  const auto in_scale = [scale](double value, Dimension dimension) {
    if (dimension == Dimension::force) return value / scale;
    return dimension == Dimension::slip || dimension == Dimension::time ? value * scale : value;
  };
  std::vector<double> values = values_;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = in_scale(values[i], definition_->parameters[i].dimension);
  Friction scaled(*definition_, std::move(values), closure_, curve_);
  for (const auto& [name, value] : varying_)
    scaled.varying_.emplace(name, [=, dimension = definition_->find(name)->dimension, at = value](double x, double y) {
      return in_scale(at(x / scale, y / scale), dimension);
    });
  check_scaling(*this, scaled, scale);
  return scaled;
}

std::vector<double> Friction::state_at_start() const {
  std::vector<double> state(state_size());
  evolution().start(state);
  return state;
}

bool Friction::changes_contacts() const { return contacts_->act(); }

double Friction::contact_at_start() const {
  return changes_contacts() ? std::sqrt(contacts_->strength(state_at_start()[0], 0)) : 1;
}

/// The oldest contacts are those that rest; a slip that renews them sucks at the pores, most where they do not drain.
double Friction::contact_growth(double time) const {
  if (!changes_contacts()) return 1;
  constexpr double fastest = 10;
  constexpr int samples = 200;
  const double start = state_at_start()[0], oldest = start + std::fmax(time, 0);
  const double youngest = std::fmin(start, parameter("characteristic_slip") / fastest);
  double most = 1;
  for (int i = 0; i <= samples; ++i) {
    const double at = youngest * std::pow(oldest / youngest, static_cast<double>(i) / samples);
    const double excess = -contacts_->dilatancy * std::log(oldest / at);
    most = std::fmax(most, std::sqrt(contacts_->strength(at, excess)) / contact_at_start());
  }
  return most;
}

double Friction::force(double velocity, LocalState state) const {
  return velocity == 0 ? 0 : std::copysign(law_->strength(std::fabs(velocity), state), velocity);
}

double Friction::velocity_after(double free, double weight, LocalState state) const {
  return std::copysign(law_->speed_after(std::fabs(free), weight, state), free);
}

double Friction::momentum_loss(const State& train, double contact, LocalState state) const {
  if (!acts_ || train.empty() || train.phi == 0) return 0;
  const double k = train::averages(train).k * contact;
  return std::copysign(k * mean_strength(train, contact, state), train.phi);
}

}  // namespace slipfront::friction
