#include "text/file_kind.hpp"

#include <algorithm>
#include <cstdlib>

#include "slipfront/error.hpp"
#include "text/characters.hpp"

namespace slipfront {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Whether TOML text has a table of this name.
bool has_table(std::string_view text, const std::string& name) {
  return text.starts_with("[" + name + "]") || has(text, "\n[" + name + "]");
}

/// Calls `use` with each line that is neither blank nor a comment.
template <class Use>
void for_each_line(std::string_view text, Use&& use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#' && line.front() != '%') use(std::string(line));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// Whether four fifths of the lines are two numbers, and there are five such lines.
bool is_series(std::string_view text) {
  std::size_t lines = 0, pairs = 0;
  for_each_line(text, [&](std::string line) {
    ++lines;
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
    int count = 0;
    const char* at = line.c_str();
    for (char* end = nullptr; std::strtod(at, &end), end != at; at = end) ++count;
    if (count == 2 && *at == '\0') ++pairs;
  });
  return pairs >= 5 && 5 * pairs >= 4 * lines;
}

bool is_srf(std::string_view text) {
  std::string first;
  for_each_line(text.substr(0, 100), [&](const std::string& line) { first = first.empty() ? line : first; });
  return (first == "1.0" || first == "2.0") && has(text, "\nPOINTS");
}

/// Whether one character in twenty is a control character, as in data that are no text.
bool is_binary(std::string_view text) {
  const std::string_view start = text.substr(0, 2000);
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && (byte < '\t' || byte > '\r')) || byte == 0x7f;
  };
  const auto count = static_cast<std::size_t>(std::count_if(start.begin(), start.end(), is_control));
  return count >= 4 && 20 * count >= start.size();
}

struct Kind {
  const char *name, *advice;
  bool (*is)(std::string_view text);
  bool as_events, as_table, as_scenario;  ///< whether it is refused
};

using Text = std::string_view;

constexpr Kind kinds[] = {
    {"an Excel workbook or another ZIP archive", "a table saved as CSV",
     [](Text t) { return t.starts_with("PK\x03\x04"); }, true, true, true},
    {"an Excel workbook of before 2007", "a table saved as CSV",
     [](Text t) { return t.starts_with("\xD0\xCF\x11\xE0"); }, true, true, true},
    {"a PDF document", "its table saved as CSV", [](Text t) { return t.starts_with("%PDF-"); }, true, true, true},
    {"a compressed file", "the unpacked file", [](Text t) { return t.starts_with("\x1F\x8B"); }, true, true, true},
    {"a NetCDF file (HDF5)", "a table or TOML file; slipfront plot and slipfront.open read results",
     [](Text t) { return t.starts_with("\x89HDF") || t.starts_with("CDF\x01") || t.starts_with("CDF\x02"); }, true,
     true, true},
    {"a moment tensor (CMTSOLUTION)", "a TOML file with moment, duration and velocities in [event]",
     [](Text t) { return has(t, "event name:") && has(t, "Mrr:"); }, true, true, true},
    {"a kinematic source (SRF)", "slipfront event or plane FILE, or a scenario in TOML", is_srf, false, true, true},
    {"a finite-fault model", "slipfront event or plane FILE, or a scenario in TOML",
     [](Text t) {
       const Text start = t.substr(0, 1000);
       return has(start, "FINITE-SOURCE RUPTURE MODEL") || has(start, "#Fault_segment") || has(start, "ss-slip");
     },
     false, true, true},
    {"a scenario", "slipfront pulse, chain or plane; or a table [event] in the file",
     [](Text t) {
       return !has_table(t, "event") && (has_table(t, "initial") || has_table(t, "loading") || has_table(t, "plane"));
     },
     true, true, false},
    {"a source time function or another series of two columns",
     "one event a row; or a TOML file with moment and "
     "duration in [event]",
     is_series, false, true, true},
    {"no text, but binary data", "a text file: a table saved as CSV, or TOML", is_binary, true, true, true},
};

}  // namespace

void refuse_other_kinds(std::string_view text, const std::string& file, ReadAs as) {
  constexpr const char* names[] = {"as events", "as a table of events", "as a scenario"};
  for (const Kind& kind : kinds) {
    const bool refused = as == ReadAs::events ? kind.as_events : as == ReadAs::table ? kind.as_table : kind.as_scenario;
    if (refused && kind.is(text))
      throw InputError({.file = file,
                        .problem = std::string("this is ") + kind.name + ": slipfront reads no such file " +
                                   names[static_cast<int>(as)],
                        .allowed = kind.advice});
  }
}

}  // namespace slipfront
