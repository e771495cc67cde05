#pragma once

#include <ios>
#include <locale>
#include <sstream>

namespace slipfront {

/// A stream for text that is read back: numbers as everywhere, whatever the user's language, and a want of memory is an
/// exception. Streams else keep it to themselves and leave the text cut short.
inline std::ostringstream plain_stream() {
  std::ostringstream out;
  out.exceptions(std::ios_base::badbit | std::ios_base::failbit);
  out.imbue(std::locale::classic());
  return out;
}

}  // namespace slipfront
