#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "foundation/text/nearest.hpp"
#include "scenario/text/document.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/keys.hpp"

namespace slipfront::scenario {

/// One table of a scenario. It checks values against the list of keys (scenario/keys.hpp). If a value is wrong, it
/// throws an InputError that names file, line, key and value.
class Section {
 public:
  /// \throws InputError for a key that is not known.
  Section(const Document& document, std::string_view name);

  bool has(std::string_view key) const { return find(key) != nullptr; }
  const std::string& file() const { return document_.file; }
  const Value* find(std::string_view key) const;

  const Key& key(std::string_view name) const;  ///< its entry in the list of keys

  std::optional<double> number(std::string_view key) const;
  std::optional<int> whole_number(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<bool> truth(std::string_view key) const;
  std::optional<std::string> formula(std::string_view key) const;  ///< a text, or a number as a constant formula
  const std::vector<std::string_view>& words(std::string_view name) const { return key(name).words; }  ///< allowed
  const Value* array(std::string_view key, const char* allowed) const;

  /// Reads a value that must be one of these words.
  template <typename Enum>
  std::optional<Enum> choice(std::string_view key, const std::vector<std::pair<std::string_view, Enum>>& words) const {
    const Value* const value = find(key);
    if (!value) return std::nullopt;
    std::vector<std::string_view> names;
    for (const auto& [word, meaning] : words) {
      if (value->kind == Value::Kind::text && value->text == word) return meaning;
      names.push_back(word);
    }
    throw refuse(key, value->kind == Value::Kind::text ? "unknown word" : "not a text",
                 nearest_or_all(value->text, names));
  }

  /// The file, line and key of an error, to which the caller adds the problem. For a missing key, the line is the first
  /// line of the table.
  Complaint where(std::string_view key) const;
  InputError refuse(std::string_view key, std::string problem, std::string allowed) const;
  InputError refuse(std::string_view key, const Value& item, std::string problem, std::string allowed) const;
  void check(std::string_view key, const Value& value, const Limits& limits) const;

 private:
  const Document& document_;
  const Table* table_;
  std::string name_;
};

}  // namespace slipfront::scenario
