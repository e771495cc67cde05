#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::scenario {

/// One value of a scenario file, freed from its syntax.
struct Value {
  enum class Kind { number, text, truth, array, other };
  Kind kind = Kind::other;
  double number = 0;      ///< of a truth: 1 or 0
  std::string text = {};  ///< the text, or a number as it is shown to people
  std::vector<Value> items = {};
  std::size_t line = 0;
  bool overridden = false;  ///< came from the command line, not from the file
};

struct Table {
  std::size_t line = 0;
  std::map<std::string, Value, std::less<>> values = {};
};

/// A scenario file with its overrides applied; which keys are known and what they may hold is checked later.
struct Document {
  std::string file;
  std::string text;  ///< TOML that reads back as this document
  std::optional<Value> title;
  std::map<std::string, Table, std::less<>> tables;
};

/// Tables that a scenario may have; [event] is another command's.
const std::vector<std::string_view>& known_tables();

/// \throws InputError for what is not TOML, an unknown table, or an override that is none.
Document read_document(std::string_view text, const std::string& file, const std::vector<std::string>& overrides);

}  // namespace slipfront::scenario
