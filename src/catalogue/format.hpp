#pragma once
/// \file
/// What a format of catalogues is: each reader defines one, and read.cpp lists them.

#include <string>
#include <string_view>
#include <vector>

#include "slipfront/catalogue/read.hpp"

namespace slipfront::catalogue {

struct Format {
  std::string_view ending;                    ///< of a file's name, such as ".toml"
  bool (*looks_like)(std::string_view text);  ///< whether a text under another name is of this format
  /// Hands on the entries; returns the columns that carry no observation.
  std::vector<std::string> (*read)(std::string_view text, const std::string& file, const Sink& sink);
};

/// The first character that is no blank; 0 if there is none.
inline char first_character(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? '\0' : text[first];
}

}  // namespace slipfront::catalogue
