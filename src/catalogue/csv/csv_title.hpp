#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace slipfront::catalogue {

/// A header cell, divided into its words and its texts in parentheses or brackets.
struct Title {
  std::vector<std::string> words;   ///< as written; they were separated by blanks or '_'
  std::vector<std::string> small;   ///< the words in small letters, without '-' and a final '.'
  std::vector<std::string> groups;  ///< texts in ( ) or [ ], and one behind a comma
};

Title divide_title(std::string_view title);

}  // namespace slipfront::catalogue
