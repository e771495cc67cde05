#include "text/toml.hpp"

#include <algorithm>
#include <utility>

#include "slipfront/error.hpp"

namespace slipfront {
namespace {

constexpr int most_dots = 8;
constexpr int most_brackets = 32;

/// Returns the end of the string or comment that begins at `at`, or `at` if none begins there.
std::size_t past_text(std::string_view text, std::size_t at) {
  const char quote = text[at];
  if (quote == '#') return std::min(text.find('\n', at), text.size());
  if (quote != '"' && quote != '\'') return at;
  const std::string three(3, quote);
  const bool spans_lines = text.substr(at, 3) == three;
  const std::string_view close = spans_lines ? std::string_view(three) : text.substr(at, 1);
  for (std::size_t i = at + close.size(); i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text.substr(i, close.size()) == close) {
      return i + close.size();
    } else if (!spans_lines && text[i] == '\n') {
      return i;  // the quote is never closed; the parser reports it
    }
  }
  return text.size();
}

/// toml++ stores "a.a.a.a..." as nested tables and recurses through them, so that 400 kB of it overflow the stack. The
/// files that we read need only a few levels.
void refuse_deep_nesting(std::string_view text, const std::string& file) {
  std::size_t line = 1;
  int dots = 0;
  int brackets = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (const std::size_t past = past_text(text, i); past > i) {
      const std::string_view passed = text.substr(i, past - i);
      line += static_cast<std::size_t>(std::count(passed.begin(), passed.end(), '\n'));
      i = past;
      continue;
    }
    const char c = text[i++];
    if (c == '.') ++dots;
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') brackets = std::max(0, brackets - 1);
    if (c == '\n' || c == ',' || c == '=' || c == '[' || c == '{') dots = 0;
    if (c == '\n') ++line;
    if (dots > most_dots || brackets > most_brackets)
      throw InputError({.file = file, .line = line, .problem = "nested too deeply", .allowed = "table.key = value"});
  }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark
  if (text.find('\0') != std::string_view::npos)
    throw InputError({.file = file, .problem = "not a text: it holds a zero byte", .allowed = "TOML 1.0"});
  refuse_deep_nesting(text, file);
  // We do not pass the file name: toml++ would store it in a function that must not throw.
  toml::parse_result result = toml::parse(text);
  if (result) return std::move(result).table();
  throw InputError({.file = file,
                    .line = result.error().source().begin.line,
                    .problem = std::string(result.error().description()),
                    .allowed = "TOML 1.0"});
}

}  // namespace slipfront
