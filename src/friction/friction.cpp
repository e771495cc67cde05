// The force at many positions, by the force at one.

#include "slipfront/friction/friction.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "friction/laws/force_of_speed.hpp"
#include "friction/scaling.hpp"
#include "friction/state/contacts.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::friction {

namespace {

constexpr std::pair<std::string_view, double Contacts::*> numbers_of_contacts[] = {
    {"contact_ageing", &Contacts::ageing},
    {"contact_time", &Contacts::age},
    {"dilatancy", &Contacts::dilatancy},
    {"drainage_time", &Contacts::drainage},
    {"pore_pressure", &Contacts::ambient}};

constexpr std::string_view name_of_pressure = "normal_stress", name_of_factor = "coefficient";

/// Whether the force is proportional to the coefficient, as it has no other parameter that is a force.
bool is_proportional(const Definition& definition) {
  std::size_t forces = 0;
  for (const Parameter& p : definition.parameters) forces += p.dimension == Dimension::force ? 1u : 0u;
  return forces == 1 && definition.find(name_of_factor) != nullptr;
}

/// The index of a parameter; one past the last if the law has no such parameter.
std::size_t index_of(const Definition& definition, std::string_view parameter) {
  std::size_t index = 0;
  while (index < definition.parameters.size() && definition.parameters[index].name != parameter) ++index;
  return index;
}

AlongInterface divided(const AlongInterface& value, double by) {
  return {[by, at = value.at](double x, double y) { return at(x, y) / by; }, value.least / by, value.most / by};
}

AlongInterface product(const AlongInterface& a, const AlongInterface& b) {
  return {[one = a.at, other = b.at](double x, double y) { return one(x, y) * other(x, y); }, a.least * b.least,
          a.most * b.most};
}

}  // namespace

Friction::Friction(const Definition& definition, std::vector<double> values, Closure closure, Curve curve)
    : Friction(definition, std::move(values), closure, std::move(curve), {}) {}

Friction::Friction(const Definition& definition, std::vector<double> values, Closure closure, Curve curve,
                   Variations varying)
    : definition_(&definition),
      values_(std::move(values)),
      varying_(std::move(varying)),
      curve_(std::move(curve)),
      closure_(closure) {
  std::optional<AlongInterface> share;
  Varying apart{.own = definition.state.size(), .least = values_};
  for (const auto& [name, value] : varying_) {
    if (name == name_of_pressure || (name == name_of_factor && is_proportional(definition))) {
      const AlongInterface part = value.most > 0 ? divided(value, value.most) : AlongInterface{value.at, 0, 0};
      share = share ? product(*share, part) : part;
      continue;
    }
    const std::size_t index = index_of(definition, name);
    apart.parameters.push_back(index);
    apart.least[index] = value.least;
    columns_.push_back(value);
    column_names_.push_back(name);
  }
  law_ = definition.make(values_, curve_, apart);
  linear_ = law_->facts().linear_coefficient;
  for (std::size_t i = 0; i < values_.size(); ++i)
    acts_ = acts_ || (definition.parameters[i].dimension == Dimension::force && values_[i] > 0);
  if (!acts_) check_no_force(definition, values_);
  if (share) {
    law_ = scaled_law(law_);
    columns_.push_back(*share);
    column_names_.emplace_back("share_of_force");
  }
  Contacts contacts;
  for (const auto& [name, member] : numbers_of_contacts) {
    contacts.*member = parameter(name);
    for (std::size_t c = 0; c < column_names_.size(); ++c)
      if (column_names_[c] == name) contact_columns_.emplace_back(member, definition.state.size() + c);
  }
  contacts_ = std::make_shared<const Contacts>(contacts);
  at_rest_ = law_->strength(0, state_at_start());
}

Friction Friction::with(Closure closure) const { return {*definition_, values_, closure, curve_, varying_}; }

Friction Friction::with(std::string_view parameter, double value) const {
  std::vector<double> values = values_;
  values.at(index_of(*definition_, parameter)) = value;
  Variations varying = varying_;
  if (const auto found = varying.find(parameter); found != varying.end()) varying.erase(found);
  return {*definition_, std::move(values), closure_, curve_, std::move(varying)};
}

Friction Friction::with(std::string_view parameter, const AlongInterface& value) const {
  std::vector<double> values = values_;
  values.at(index_of(*definition_, parameter)) = value.most;
  Variations varying = varying_;
  varying.insert_or_assign(std::string(parameter), value);
  return {*definition_, std::move(values), closure_, curve_, std::move(varying)};
}

Friction Friction::under(const AlongInterface& share) const {
  Variations varying = varying_;
  varying.insert_or_assign(std::string(name_of_pressure), share);
  return {*definition_, values_, closure_, curve_, std::move(varying)};
}

Friction Friction::at(double x, double y) const {
  std::vector<double> values = values_;
  for (const auto& [name, value] : varying_)
    if (name != name_of_pressure) values[index_of(*definition_, name)] = value.at(x, y);
  if (const auto share = varying_.find(name_of_pressure); share != varying_.end())
    for (std::size_t i = 0; i < values.size(); ++i)
      if (definition_->parameters[i].dimension == Dimension::force) values[i] *= share->second.at(x, y);
  return {*definition_, std::move(values), closure_, curve_};
}

std::optional<double> Friction::linear_coefficient(double x, double y) const {
  return linear_ && varies() ? std::optional(*linear_ * columns_.back().at(x, y)) : linear_;
}

std::vector<std::string> Friction::state_names() const {
  std::vector<std::string> names;
  for (const StateVariable& variable : definition_->state) names.emplace_back(variable.name);
  names.insert(names.end(), column_names_.begin(), column_names_.end());
  return names;
}

void Friction::start(double x, double y, std::span<double> state) const {
  const std::size_t own = definition_->state.size();
  for (std::size_t i = 0; i < columns_.size(); ++i) state[own + i] = columns_[i].at(x, y);
  evolution().start(state);
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
  Variations varying;
  for (const auto& [name, value] : varying_) {
    const Parameter* const parameter = definition_->find(name);  // null for the share of the normal stress
    const Dimension dimension = parameter ? parameter->dimension : Dimension::number;
    varying.emplace(name, AlongInterface{[=, at = value.at](double x, double y) {
                                           return in_scale(at(x / scale, y / scale), dimension);
                                         },
                                         in_scale(value.least, dimension), in_scale(value.most, dimension)});
  }
  Friction scaled(*definition_, std::move(values), closure_, curve_, std::move(varying));
  check_scaling(*this, scaled, scale);
  return scaled;
}

std::vector<double> Friction::state_at_start() const {
  std::vector<double> state(state_size());
  for (std::size_t i = 0; i < columns_.size(); ++i) state[definition_->state.size() + i] = columns_[i].most;
  evolution().start(state);
  return state;
}

bool Friction::changes_contacts() const { return contacts_->act(); }

Contacts Friction::contacts_at(LocalState state) const {
  Contacts contacts = *contacts_;
  for (const auto& [member, column] : contact_columns_) contacts.*member = state[column];
  return contacts;
}

double Friction::contact_at_start(double x) const {
  if (!changes_contacts()) return 1;
  std::vector<double> state(state_size());
  start(x, 0, state);
  return std::sqrt(contacts_at(state).strength(state[0], 0));
}

namespace {

/// The growth of contacts that are `start` old at t = 0, renew after a slip `renewal` and rest for `time`.
double growth_of(const Contacts& contacts, double start, double renewal, double time) {
  constexpr double fastest = 10;
  constexpr int samples = 200;
  const double oldest = start + std::fmax(time, 0), youngest = std::fmin(start, renewal / fastest);
  const double at_start = std::sqrt(contacts.strength(start, 0));
  double most = 1;
  for (int i = 0; i <= samples; ++i) {
    const double at = youngest * std::pow(oldest / youngest, static_cast<double>(i) / samples);
    const double excess = -contacts.dilatancy * std::log(oldest / at);
    most = std::fmax(most, std::sqrt(contacts.strength(at, excess)) / at_start);
  }
  return most;
}

}  // namespace

std::pair<double, double> Friction::range_of(std::string_view parameter) const {
  const auto found = varying_.find(parameter);
  if (found != varying_.end()) return {found->second.least, found->second.most};
  return {this->parameter(parameter), this->parameter(parameter)};
}

/// The least and the largest theta at t = 0. It is monotone in the parameters on which it depends.
std::pair<double, double> Friction::ages_at_start() const {
  std::pair<double, double> ages{HUGE_VAL, 0};
  std::vector<double> state(state_size());
  for (std::size_t corner = 0; corner < 8; ++corner) {
    for (std::size_t c = 0, bit = 0; c < columns_.size(); ++c) {
      const std::string& name = column_names_[c];
      const bool counts = name == "initial_state" || name == "characteristic_slip" || name == "reference_velocity";
      const bool least = counts && (corner >> bit++ & 1) != 0;
      state[definition_->state.size() + c] = least ? columns_[c].least : columns_[c].most;
    }
    evolution().start(state);
    ages = {std::fmin(ages.first, state[0]), std::fmax(ages.second, state[0])};
  }
  return ages;
}

namespace {

/// Numbers from the least to the largest, at equal ratios.
std::vector<double> numbers_between(const std::pair<double, double>& range) {
  constexpr int steps = 16;
  std::vector<double> numbers = {range.second};
  for (int i = 0; range.first < range.second && i < steps; ++i)
    numbers.push_back(range.first * std::pow(range.second / range.first, static_cast<double>(i) / steps));
  return numbers;
}

}  // namespace

/// The oldest contacts are those that rest; a slip that renews them sucks at the pores, most where they do not drain.
/// Where numbers vary this is a bound. The growth rises with E and p_0 and falls with D_c. With the other numbers it
/// may do both, so we try several.
double Friction::contact_growth(double time) const {
  if (!changes_contacts()) return 1;
  const double renewal = range_of("characteristic_slip").first;
  const auto [least_ageing, most_ageing] = range_of("contact_ageing");
  double most = 1;
  for (const double age : numbers_between(range_of("contact_time")))
    for (const double start : numbers_between(ages_at_start()))
      for (const double ageing : {least_ageing, most_ageing}) {
        Contacts contacts = *contacts_;
        contacts.age = age;
        contacts.ageing = ageing;
        most = std::fmax(most, growth_of(contacts, start, renewal, time));
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

namespace {

/// Many solves of v + weight f(v) = free at once, by secants. `before` and `excess` are the last v and the excess of
/// the left side there; `open` is 1 until v is found to rounding.
struct Secants {
  double v[part_size], before[part_size], excess[part_size], open[part_size], weight[part_size];
};

/// Starts at v = free, where the force is `force`; `at_rest` is what holds a position at rest.
SLIPFRONT_CLONES void start_secants(std::size_t size, const double* free, const double* at_rest, const double* force,
                                    Secants& s) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double weight = s.weight[i], slowed = free[i] - weight * force[i];
    const bool held = weight * at_rest[i] >= free[i], found = held || slowed == free[i];
    s.before[i] = free[i];
    s.excess[i] = weight * force[i];
    s.v[i] = held ? 0 : slowed > 0 ? slowed : free[i] / 2;
    s.open[i] = found ? 0.0 : 1.0;
  }
}

/// One step of each from the force at v. The error of a secant is the product of the errors of its two points.
SLIPFRONT_CLONES void take_secants(std::size_t size, const double* free, const double* force, Secants& s) {
  constexpr double rounding = 4e-16;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double v = s.v[i], excess = v + s.weight[i] * force[i] - free[i];
    const double way = v - s.before[i], next = v - excess * (way / (excess - s.excess[i])), step = next - v;
    const double error = excess > 0 ? excess : -excess, left = step / v * (way / v);
    const bool there = error <= rounding * free[i], inside = next > 0 && next < free[i];
    const bool open = s.open[i] != 0, moves = open && !there && inside;
    s.open[i] = open && !there && !(inside && left <= rounding && left >= -rounding) ? 1.0 : 0.0;
    s.before[i] = v;
    s.excess[i] = excess;
    s.v[i] = moves ? next : v;
  }
}

}  // namespace

void ForceLoops::strengths(std::size_t size, const double* speed, LocalStates states, double* force) const {
  for (std::size_t i = 0; i < size; ++i) force[i] = law_.strength(speed[i], states.at(i));
}

void ForceLoops::speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                              double* speed) const {
  double share[part_size];
  std::fill_n(share, part_size, 1.0);
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    ForceLoops::speeds_after_under(some, share, free + begin, weight, states.from(begin), speed + begin);
  });
}

void ForceLoops::speeds_after_under(std::size_t size, const double* share, const double* free, double weight,
                                    LocalStates states, double* speed) const {
  constexpr int most_steps = 6;
  Secants s;
  double at_rest[part_size], force[part_size];
  in_parts(size, [&](std::size_t begin, std::size_t some) {
    const LocalStates theirs = states.from(begin);
    std::fill_n(s.v, some, 0.0);
    for (std::size_t i = 0; i < some; ++i) s.weight[i] = weight * share[begin + i];
    strengths(some, s.v, theirs, at_rest);
    strengths(some, free + begin, theirs, force);
    start_secants(some, free + begin, at_rest, force, s);
    for (int step = 0; step < most_steps && std::find(s.open, s.open + some, 1.0) != s.open + some; ++step) {
      strengths(some, s.v, theirs, force);
      take_secants(some, free + begin, force, s);
    }
    for (std::size_t i = 0; i < some; ++i)
      speed[begin + i] = s.open[i] == 0 ? s.v[i] : law_.speed_after(free[begin + i], s.weight[i], theirs.at(i));
  });
}

namespace {

SLIPFRONT_CLONES bool free_speeds(const Steps& steps, std::size_t size, double* free) {
  const Steps s = steps;
  std::uint64_t bits = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    free[i] = free_speed(s.per_step, s.from[i], s.next[i]);
    bits |= std::bit_cast<std::uint64_t>(free[i]);
  }
  return bits != 0;
}

SLIPFRONT_CLONES void find_applied(const Steps& steps, double per_weight, std::size_t size, const double* free,
                                   const double* speed, double* applied) {
  const Steps s = steps;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i)
    applied[i] = std::copysign((free[i] - speed[i]) * per_weight, s.next[i] - s.from[i]);
}

SLIPFRONT_CLONES void take_speeds(const Steps& steps, std::size_t size, const double* speed) {
  const Steps s = steps;
  const double step_per_speed = 1 / s.per_step;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i)
    s.next[i] = end_of_step(step_per_speed, s.from[i], s.next[i] - s.from[i], speed[i]);
}

SLIPFRONT_CLONES void speeds_of(std::size_t size, double per_step, const double* D, double* speed) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) speed[i] = std::fabs(D[i]) * per_step;
}

}  // namespace

/// Parts in which nothing moves are cheap.
void ForceLoops::slow_steps(std::size_t size, const Steps& all, const double* share, double weight, LocalStates states,
                            double* applied) const {
  constexpr std::size_t most = 4 * part_size;
  double free[most], speed[most];
  in_parts<most>(size, [&](std::size_t begin, std::size_t some) {
    const Steps steps{all.per_step, all.from + begin, all.next + begin};
    if (!free_speeds(steps, some, free)) {
      if (applied != nullptr) std::fill_n(applied + begin, some, 0.0);
      std::copy_n(steps.from, some, steps.next);
      return;
    }
    if (share == nullptr)
      speeds_after(some, free, weight, states.from(begin), speed);
    else
      speeds_after_under(some, share + begin, free, weight, states.from(begin), speed);
    if (applied != nullptr) find_applied(steps, 1 / weight, some, free, speed, applied + begin);
    take_speeds(steps, some, speed);
  });
}

void ForceLoops::powers(std::size_t size, double per_step, const double* D, LocalStates states, double* power) const {
  constexpr std::size_t most = 4 * part_size;
  double speed[most];
  in_parts<most>(size, [&](std::size_t begin, std::size_t some) {
    speeds_of(some, per_step, D + begin, speed);
    strengths(some, speed, states.from(begin), power + begin);
    multiply(some, speed, power + begin);
  });
}

}  // namespace slipfront::friction
