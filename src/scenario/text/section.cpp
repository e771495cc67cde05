#include "scenario/text/section.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foundation/text/digits.hpp"

namespace slipfront::scenario {

Section::Section(const Document& document, std::string_view name) : document_(document), table_(nullptr), name_(name) {
  const auto found = document.tables.find(name);
  if (found == document.tables.end()) return;
  table_ = &found->second;
  std::vector<std::string_view> known;
  for (const Key* key : keys_of(name)) known.push_back(key->name);
  for (const auto& [key, value] : table_->values)
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw refuse(key, "unknown key", nearest_or_all(key, known));
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

std::optional<double> Section::number(std::string_view key) const {
  const Value* const value = find(key);
  if (!value) return std::nullopt;
  check(key, *value, this->key(key).limits);
  return value->number;
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
  return value->text;
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
