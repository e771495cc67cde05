#pragma once
/// \file
/// The keys that a scenario file may have. The reader checks every value against this list, and `slipfront keys` and
/// the documentation print it.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::scenario {

/// The range of a number, which is finite in any case.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool without_least = false;
  bool without_most = false;

  bool hold(double value) const;
  std::string text() const;  ///< "a finite number > 0 and <= 20"
};

enum class KeyType { number, whole_number, numbers, word, words, text, formula, truth, quantity, points };

/// The type in words, such as "whole number".
std::string_view name_of(KeyType type);

/// The unit of the model in which a key gives a number. A text with an SI unit is converted to it.
enum class ModelUnit { none, position, time, stress, slip_velocity, force, slip, stiffness, end_stiffness };

/// The unit in symbols, such as "b / (c A)".
std::string_view symbol_of(ModelUnit unit);

/// One key of a scenario.
struct Key {
  std::string_view table, name;
  KeyType type = KeyType::number;
  std::string meaning;                       ///< in a few words
  std::string_view unit = {};                ///< unit; empty unless the key is a number
  ModelUnit scale = ModelUnit::none;         ///< unit of a number, or of a formula; none if it has no SI unit
  std::string otherwise = {};                ///< the value if the key is absent, or what happens then
  Limits limits = {};                        ///< range of a number
  std::vector<std::string_view> words = {};  ///< allowed words
  std::vector<std::string_view> laws = {};   ///< friction laws that have this key; empty: all, or not about friction

  std::string allowed() const;  ///< the allowed values in words; empty if the type is enough
};

/// All keys, in the order of tables and keys in which the documentation lists them.
const std::vector<Key>& keys();

/// The keys of one table.
std::vector<const Key*> keys_of(std::string_view table);

}  // namespace slipfront::scenario
