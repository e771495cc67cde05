#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scenario/document.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/keys.hpp"

namespace slipfront::scenario {

/// Whether the text is a number and a unit, which no formula is.
bool is_quantity(std::string_view text);

/// Whether a key varies along the interface: by a table, or by a text that is a formula rather than a number with a
/// unit.
bool varies(const Value& value);

/// The first value with a unit outside of [medium], as "key = 'text'"; empty if there is none. Pure numbers and the
/// normal stress, which exist in SI units only, do not count.
std::string first_in_si(const Document& document);

/// One table of a scenario. It checks values against the list of keys (scenario/keys.hpp). If a value is wrong, it
/// throws an InputError that names file, line, key and value.
class Section {
 public:
  Section(const Document& document, std::string_view name);

  bool has(std::string_view key) const { return find(key) != nullptr; }
  const std::string& file() const { return document_.file; }
  const Value* find(std::string_view key) const;

  const Key& key(std::string_view name) const;  ///< its entry in the list of keys

  /// Checks each single value of the table, and that every key is known. Parameters of friction and constants of
  /// the medium are checked where they are read. \throws InputError with all errors.
  void check_values() const;

  /// A number in the unit of the model. A text with an SI unit is converted.
  std::optional<double> number(std::string_view key) const { return number_in(key, this->key(key).scale); }
  std::optional<double> number_in(std::string_view key, ModelUnit unit) const;
  double item_in(std::string_view key, const Value& item, ModelUnit unit, const Limits& limits) const;
  /// A number in SI units: a text with a unit, or a number without one if it is a ratio.
  double quantity(std::string_view key, const Value& item, medium::Dimension dimension) const;
  /// SI value of one unit of the model. \throws InputError that names the key.
  double si(std::string_view key, ModelUnit unit) const;
  /// Whether the key "units" is "SI". Variables and values of formulas and files are then in m, s and Pa.
  bool in_si() const { return has("units") && word("units") == 1; }
  /// The unit of the model in the units of formulas and files: 1, or its SI value.
  double in_file(ModelUnit unit) const { return in_si() ? si("units", unit) : 1; }
  std::optional<int> whole_number(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<bool> truth(std::string_view key) const;
  /// A formula. A number, or a text such as "2 MPa", is a constant formula.
  std::optional<std::string> formula(std::string_view key) const;
  const Value* array(std::string_view key, const char* allowed) const;

  /// Position of the value of a key among its words.
  std::size_t word(std::string_view key) const;
  /// Reads a key, if the table has it. An enumeration has the order of the words; a bool is a truth value, or the
  /// second of two words.
  template <typename Type>
  void read(std::string_view name, Type& value) const {
    if (!has(name)) return;
    if constexpr (std::is_enum_v<Type>)
      value = static_cast<Type>(word(name));
    else if constexpr (std::is_same_v<Type, bool>)
      value = key(name).type == KeyType::word ? word(name) == 1 : *truth(name);
    else if constexpr (std::is_same_v<Type, int>)
      value = *whole_number(name);
    else if constexpr (std::is_same_v<Type, std::string>)
      value = *text(name);
    else
      value = *number(name);
  }

  /// The file, line and key of an error, to which the caller adds the problem. For a missing key, the line is the first
  /// line of the table.
  Complaint where(std::string_view key) const;
  InputError refuse(std::string_view key, std::string problem, std::string allowed) const;
  InputError refuse(std::string_view key, const Value& item, std::string problem, std::string allowed) const;
  void check(std::string_view key, const Value& value, const Limits& limits) const;
  /// A bound that is known in the unit of the model, in the unit in which the user wrote a value.
  std::string bound_as_written(std::string_view key, const Value& item, ModelUnit unit, double bound) const;
  /// Refuses a number without a unit in a scenario that has values with units. 0 needs no unit.
  void check_unit(std::string_view key, const Value& item, ModelUnit unit) const;
  /// Refuses a formula or a file without the key "units" in a scenario that has values with units.
  void require_units(std::string_view key) const;

 private:
  std::string limits_as_written(std::string_view key, const Value& item, ModelUnit unit, const Limits& limits) const;
  void check_units_key(const Key& key, const Value& value) const;
  void check_value(const Key& key) const;
  double converted(std::string_view key, const Value& item, ModelUnit unit) const;
  std::optional<double> times_normal_stress(std::string_view key, const Value& item) const;

  const Document& document_;
  const Table* table_;
  std::string name_;
};

}  // namespace slipfront::scenario
