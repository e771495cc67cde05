#include "scenario/section.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "math/digits.hpp"
#include "scenario/document.hpp"
#include "slipfront/text/quantity.hpp"
#include "text/characters.hpp"
#include "text/units.hpp"

namespace slipfront::scenario {

namespace {

/// Whether the key of a scenario gives this value with a unit.
bool has_unit(const Key& key, const Value& value) {
  for (const Value& item : value.items)
    if (has_unit(key, item)) return true;
  const bool numeric = key.type == KeyType::number || key.type == KeyType::numbers || key.type == KeyType::points;
  const bool may = numeric || (key.type == KeyType::formula && key.scale != ModelUnit::none);
  return may && value.kind == Value::Kind::text && is_quantity(value.text);
}

}  // namespace

bool is_quantity(std::string_view text) {
  return trimmed(text).ends_with("sigma_N") || medium::unit_of(text).has_value();
}

bool varies(const Value& value) {
  if (value.kind == Value::Kind::table) return true;
  if (value.kind != Value::Kind::text || is_quantity(value.text)) return false;
  if (value.text.find_first_of("*(") != std::string::npos) return true;
  std::string word;
  for (const char c : value.text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
    } else if (word == "x" || word == "y") {
      return true;
    } else {
      word.clear();
    }
  }
  return false;
}

std::string first_in_si(const Document& document) {
  for (const Key& key : keys()) {
    const Value* const value = key.table == "medium" ? nullptr : Section(document, key.table).find(key.name);
    if (value && has_unit(key, *value))
      return std::string(key.table) + "." + std::string(key.name) +
             (value->text.empty() ? "" : " = '" + value->text + "'");
  }
  return {};
}

Section::Section(const Document& document, std::string_view name) : document_(document), table_(nullptr), name_(name) {
  const auto found = document.tables.find(name);
  if (found == document.tables.end()) return;
  table_ = &found->second;
}

void Section::check_values() const {
  if (!table_) return;
  Errors errors;
  std::vector<std::string_view> known;
  for (const Key* key : keys_of(name_)) known.push_back(key->name);
  for (const auto& [name, value] : table_->values) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      errors.add(refuse(name, "unknown key", nearest_or_all(name, known)));
    else
      errors.attempt([&, &key = name, &item = value] {
        check_value(this->key(key));
        check_units_key(this->key(key), item);
      });
  }
  errors.throw_if_any();
}

void Section::check_value(const Key& key) const {
  switch (key.type) {
    case KeyType::number:
      if (name_ != "friction" && key.name != "stiffness" && !(name_ == "loading" && varies(*find(key.name))))
        static_cast<void>(number(key.name));
      return;
    case KeyType::whole_number:
      static_cast<void>(whole_number(key.name));
      return;
    case KeyType::word:
      static_cast<void>(word(key.name));
      return;
    case KeyType::text:
      static_cast<void>(text(key.name));
      return;
    case KeyType::truth:
      static_cast<void>(truth(key.name));
      return;
    case KeyType::formula:
      static_cast<void>(formula(key.name));
      return;
    case KeyType::numbers:
    case KeyType::words:
    case KeyType::quantity:
    case KeyType::points:
      return;
  }
}

std::size_t Section::word(std::string_view key) const {
  const Value& value = *find(key);
  const std::vector<std::string_view>& words = this->key(key).words;
  const bool is_text = value.kind == Value::Kind::text;
  const auto found = std::find(words.begin(), words.end(), value.text);
  if (!is_text || found == words.end())
    throw refuse(key, is_text ? "unknown word" : "not a text", nearest_or_all(value.text, words));
  return static_cast<std::size_t>(found - words.begin());
}

const Value* Section::find(std::string_view key) const {
  if (!table_) return nullptr;
  const auto found = table_->values.find(key);
  return found == table_->values.end() ? nullptr : &found->second;
}

const Key& Section::key(std::string_view name) const {
  for (const Key* known : keys_of(name_))
    if (known->name == name) return *known;
  throw std::logic_error("scenario/keys.cpp does not list " + name_ + "." + std::string(name));
}

std::optional<double> Section::number_in(std::string_view key, ModelUnit unit) const {
  const Value* const value = find(key);
  if (!value) return std::nullopt;
  return item_in(key, *value, unit, this->key(key).limits);
}

double Section::item_in(std::string_view key, const Value& item, ModelUnit unit, const Limits& limits) const {
  if (item.kind != Value::Kind::text || unit == ModelUnit::none) {
    check(key, item, limits);
    check_unit(key, item, unit);
    return item.number;
  }
  const double number = converted(key, item, unit);
  if (!limits.hold(number) && !std::isnan(number))  // NaN: the constants of the medium have an error
    throw refuse(key, item, "out of range", limits_as_written(key, item, unit, limits));
  return number;
}

void Section::check_unit(std::string_view key, const Value& item, ModelUnit unit) const {
  if (document_.in_si.empty() || unit == ModelUnit::none || item.number == 0) return;
  throw refuse(
      key, item, "a number without a unit, in a scenario in SI units (" + document_.in_si + ")",
      "a text with a unit, such as \"" + item.text + " " + std::string(medium::si_unit(dimension_of(unit))) + '"');
}

void Section::check_units_key(const Key& key, const Value& value) const {
  if (document_.in_si.empty() || has("units") || (key.name != "file" && key.type != KeyType::formula)) return;
  const std::optional<double> number = value.kind == Value::Kind::number ? value.number : medium::number(value.text);
  if (key.type == KeyType::formula && number) {
    Value constant = value;
    constant.number = *number;
    return check_unit(key.name, constant, key.scale);
  }
  if (key.type == KeyType::formula && key.scale != ModelUnit::none && is_quantity(value.text)) return;
  require_units(key.name);
}

void Section::require_units(std::string_view key) const {
  if (document_.in_si.empty() || has("units")) return;
  throw refuse(key, "no units are given, in a scenario in SI units (" + document_.in_si + ")",
               name_ + ".units = \"SI\" if it is in m, s and Pa; \"model\" if in the units of the model");
}

std::string Section::bound_as_written(std::string_view key, const Value& item, ModelUnit unit, double bound) const {
  const auto written = medium::unit_of(item.text);
  if (item.kind != Value::Kind::text || !written) return shortest(bound);
  return digits(bound * si(key, unit) / medium::unit_factor(*written, dimension_of(unit)), 6) + " " + *written;
}

std::string Section::limits_as_written(std::string_view key, const Value& item, ModelUnit unit,
                                       const Limits& limits) const {
  std::string text;
  const auto add = [&](bool strict, const char* sign, double bound) {
    if (std::isfinite(bound))
      text += (text.empty() ? "" : " and ") + std::string(sign) + (strict ? " " : "= ") +
              bound_as_written(key, item, unit, bound);
  };
  add(limits.without_least, ">", limits.least);
  add(limits.without_most, "<", limits.most);
  return text.empty() ? limits.text() : text;
}

double Section::si(std::string_view key, ModelUnit unit) const {
  try {
    return document_.units.si(unit);
  } catch (const InputError& error) {
    throw refuse(key, error.complaint().problem, error.complaint().allowed);
  }
}

double Section::quantity(std::string_view key, const Value& item, medium::Dimension dimension) const {
  const std::string example(medium::example(dimension));
  if (item.kind != Value::Kind::text && item.kind != Value::Kind::number)
    throw refuse(key, item, "neither a number nor a text", example);
  const std::string text = item.kind == Value::Kind::number ? shortest(item.number) : item.text;
  try {
    const medium::Span span = medium::parse_quantity(text, dimension);
    if (span.low < span.high) throw InputError({.problem = "a range, where one number is needed", .allowed = example});
    return span.low;
  } catch (const InputError& error) {
    throw refuse(key, item, error.complaint().problem, error.complaint().allowed);
  }
}

std::optional<double> Section::times_normal_stress(std::string_view key, const Value& item) const {
  constexpr std::string_view symbol = "sigma_N";
  if (!trimmed(item.text).ends_with(symbol)) return std::nullopt;
  const std::string text = medium::plain_number(item.text);
  const std::optional<double> factor = medium::number(text.substr(0, text.size() - symbol.size()));
  if (!factor) throw refuse(key, item, "no number before sigma_N", "a stress, such as 3 MPa or 0.6 sigma_N");
  const Section friction(document_, "friction");
  const Value* const pressed = friction.find("normal_stress");
  if (!pressed)
    throw refuse(key, item, "it needs friction.normal_stress", "friction.normal_stress, or a stress in MPa");
  if (varies(*pressed)) throw refuse(key, item, "friction.normal_stress varies", "a stress in MPa");
  return *factor * friction.quantity("normal_stress", *pressed, medium::Dimension::pressure);
}

double Section::converted(std::string_view key, const Value& item, ModelUnit unit) const {
  const medium::Dimension dimension = dimension_of(unit);
  std::optional<double> value;
  if (dimension == medium::Dimension::pressure) value = times_normal_stress(key, item);
  if (!value) value = quantity(key, item, dimension);
  return *value / si(key, unit);
}

void Section::check(std::string_view key, const Value& value, const Limits& limits) const {
  if (value.kind != Value::Kind::number) throw refuse(key, value, "not a number", limits.text());
  if (!std::isfinite(value.number)) throw refuse(key, value, "not finite", limits.text());
  if (!limits.hold(value.number)) throw refuse(key, value, "out of range", limits.text());
}

std::optional<int> Section::whole_number(std::string_view key) const {
  const std::optional<double> value = number(key);
  if (!value) return std::nullopt;
  const Limits& limits = this->key(key).limits;
  if (*value != std::floor(*value))
    throw refuse(key, "not a whole number",
                 std::to_string(std::lround(limits.least)) + " to " + std::to_string(std::lround(limits.most)));
  return static_cast<int>(*value);
}

std::optional<std::string> Section::text(std::string_view key) const {
  const Value* const value = find(key);
  if (!value) return std::nullopt;
  if (value->kind != Value::Kind::text) throw refuse(key, "not a text", "a text in quotes");
  return value->text;
}

std::optional<bool> Section::truth(std::string_view key) const {
  const Value* const value = find(key);
  if (!value) return std::nullopt;
  if (value->kind != Value::Kind::truth) throw refuse(key, "neither true nor false", "true or false");
  return value->number != 0;
}

std::optional<std::string> Section::formula(std::string_view key) const {
  const Value* const value = find(key);
  if (!value) return std::nullopt;
  if (value->kind == Value::Kind::number) {
    check(key, *value, {});
    return shortest(value->number);
  }
  if (value->kind != Value::Kind::text) throw refuse(key, "neither a text nor a number", "a formula in quotes");
  const ModelUnit unit = this->key(key).scale;
  if (unit == ModelUnit::none || !is_quantity(value->text)) return value->text;
  return shortest(converted(key, *value, unit) * in_file(unit));
}

const Value* Section::array(std::string_view key, const char* allowed) const {
  const Value* const value = find(key);
  if (value && value->kind != Value::Kind::array) throw refuse(key, "not an array", allowed);
  return value;
}

Complaint Section::where(std::string_view key) const {
  const Value* const value = find(key);
  const bool overridden = value && value->overridden;
  return {.file = overridden ? "--set" : document_.file,
          .line = value    ? value->line
                  : table_ ? table_->line
                           : 0,
          .key = name_ + "." + std::string(key),
          .value = value ? value->text : ""};
}

InputError Section::refuse(std::string_view key, std::string problem, std::string allowed) const {
  Complaint complaint = where(key);
  complaint.problem = std::move(problem);
  complaint.allowed = std::move(allowed);
  return InputError(std::move(complaint));
}

InputError Section::refuse(std::string_view key, const Value& item, std::string problem, std::string allowed) const {
  Complaint complaint = where(key);
  complaint.line = item.line;
  complaint.value = item.text;
  complaint.problem = std::move(problem);
  complaint.allowed = std::move(allowed);
  return InputError(std::move(complaint));
}

}  // namespace slipfront::scenario
