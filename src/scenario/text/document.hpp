#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/text/errors.hpp"
#include "scenario/units/model_units.hpp"

namespace slipfront::scenario {

/// One value of a scenario file, independent of the TOML syntax.
struct Value {
  enum class Kind { number, text, truth, array, other };
  Kind kind = Kind::other;
  double number = 0;      ///< the number; 1 or 0 for a truth value
  std::string text = {};  ///< the text, or the number as messages show it
  std::vector<Value> items = {};
  std::size_t line = 0;
  bool overridden = false;          ///< came from the command line, not from the file
  bool stands_for_formula = false;  ///< a formula of x and y, which is read elsewhere, was here
};

struct Table {
  std::size_t line = 0;
  std::map<std::string, Value, std::less<>> values = {};
};

/// A scenario file with its overrides applied. Keys and values are checked later.
struct Document {
  std::string file;
  std::string text;  ///< TOML that reads back as this document
  std::optional<Value> title;
  std::map<std::string, Table, std::less<>> tables;
  std::string in_si = {};  ///< the first value with a unit (first_in_si); empty in a scenario in units of the model
  ModelUnits units = {};   ///< units for texts such as "2 mm"; known after [medium] was read
  Errors errors = {};      ///< tables that are not known
};

/// Tables that a scenario may have. The table [event] belongs to another command.
const std::vector<std::string_view>& known_tables();

/// Reads a scenario and applies the overrides. \throws InputError for text that is not TOML, or an invalid
/// override.
Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
