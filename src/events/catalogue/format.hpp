#pragma once
/// \file
/// The interface of a catalogue format. Each reader defines one format, and read.cpp lists them all.

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/events/catalogue/read.hpp"

namespace slipfront::catalogue {

struct Format {
  std::string_view ending;                    ///< file name extension, such as ".toml"
  bool (*looks_like)(std::string_view text);  ///< detects the format if the extension is unknown
  /// Passes each entry to `sink`.
  TableNotes (*read)(std::string_view text, const std::string& file, const Sink& sink, const TableOptions& options);
};

extern const Format fault_format;  ///< finite-fault models

/// Like describe_table, for a text that is known to be CSV.
TableDescription describe_csv(std::string_view text, const std::string& file, const TableOptions& options);

/// Returns the first character that is not white space, or 0 if there is none.
inline char first_character(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? '\0' : text[first];
}

/// Takes the first line from a text, and returns it without its end.
inline std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace slipfront::catalogue
