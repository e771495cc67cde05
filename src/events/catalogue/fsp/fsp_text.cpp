#include <charconv>
#include <cmath>
#include <limits>

#include "events/catalogue/fsp/fsp.hpp"
#include "text/characters.hpp"

namespace slipfront::catalogue::fsp {
namespace {

bool is_blank(char c) { return static_cast<unsigned char>(c) <= 0x20 || c == 0x7f; }

/// A number at the start of a text, and its length in characters.
struct Leading {
  std::optional<double> value;
  std::size_t length = 0;
};

Leading leading_number(std::string_view text) {
  // from_chars does not accept '+', so we skip it. A second sign after it is an error.
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const char* const begin = text.data() + (plus ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error == std::errc::invalid_argument) return {};
  if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::infinity();
  return {value, static_cast<std::size_t>(end - text.data())};
}

/// The word that ends just before `end`. The search stops at an earlier '=', so that a line of many '=' takes linear
/// time.
std::string_view word_before(std::string_view text, std::size_t end) {
  while (end > 0 && is_blank(text[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && !is_blank(text[begin - 1]) && text[begin - 1] != '=') --begin;
  return text.substr(begin, end - begin);
}

/// Removes the first word from `text` and returns it. A word ends at a blank, '=' or ','.
std::string_view next_word(std::string_view& text) {
  text = trimmed(text);
  std::size_t size = 0;
  while (size < text.size() && !is_blank(text[size]) && text[size] != '=' && text[size] != ',') ++size;
  const std::string_view word = text.substr(0, size);
  text = trimmed(text.substr(size));
  return word;
}

Value value_at(std::string_view rest, std::string_view key, const Place& place) {
  Value out;
  const std::string_view word = next_word(rest);
  if (begins(rest, "=")) return out;
  out.text = word;
  const auto [value, length] = leading_number(word);
  // `4.2s` is a number with its unit, but `2004/09` is not a number.
  if (!value || std::isnan(*value) || (length < word.size() && !is_letter(word[length]))) return out;
  if (!std::isfinite(*value)) {
    throw InputError({.file = place.file,
                      .line = place.line,
                      .key = std::string(key),
                      .value = std::string(word),
                      .problem = "out of range",
                      .allowed = "a finite number"});
  }
  out.number = value;
  out.unit = word.substr(length);
  if (out.unit.empty()) {
    const std::string_view after = next_word(rest);
    if (!begins(rest, "=") && !after.empty() && is_letter(after.front())) out.unit = after;
  }
  return out;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view uncommented(std::string_view line) {
  while (!line.empty() && (line.front() == '%' || is_blank(line.front()))) line.remove_prefix(1);
  return trimmed(line);
}

Words words(std::string_view text) {
  Words out;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && !is_blank(text[end])) ++end;
    if (end > at) out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

bool same(std::string_view a, std::string_view b) { return a.size() == b.size() && begins(a, b); }

bool begins(std::string_view text, std::string_view with) {
  if (text.size() < with.size()) return false;
  for (std::size_t k = 0; k < with.size(); ++k) {
    if (small_letter(text[k]) != small_letter(with[k])) return false;
  }
  return true;
}

std::optional<std::size_t> index_of(const Words& words, std::string_view word) {
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (same(words[k], word)) return k;
  }
  return std::nullopt;
}

std::optional<double> number(std::string_view word) {
  // Fortran writes 1.0D+00, with a D for double precision.
  if (const std::size_t at = word.find_first_of("Dd"); at != std::string_view::npos && at > 0 && at + 1 < word.size()) {
    std::string plain(word);
    plain[at] = 'e';
    const auto [value, length] = leading_number(plain);
    return length == plain.size() ? value : std::nullopt;
  }
  const auto [value, length] = leading_number(word);
  return length == word.size() ? value : std::nullopt;
}

bool is_placeholder(std::string_view word) {
  for (const std::string_view absent : {"n/a", "na", "null", "none", "-", "--", "---", "?", "***"})
    if (same(word, absent)) return true;
  return false;
}

bool is_placeholder(double value) {
  for (const double absent : {-99.0, 999.0, -999.0, 9999.0, -9999.0})
    if (value == absent) return true;
  return !(value == value);
}

std::string tidy(std::string_view text) {
  std::string out;
  for (const std::string_view word : words(text)) {
    if (!out.empty()) out += ' ';
    out += word;
  }
  return is_utf8(out) ? out : from_latin1(out);
}

std::optional<Value> value_of(std::string_view text, std::string_view key, const Place& place) {
  for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
    if (same(word_before(text, at), key)) return value_at(text.substr(at + 1), key, place);
  }
  return std::nullopt;
}

std::optional<double> size_of(std::string_view text, std::string_view key, const Place& place) {
  const auto value = value_of(text, key, place);
  if (!value || !value->number || *value->number <= 0 || is_placeholder(*value->number)) return std::nullopt;
  return value->number;
}

std::optional<std::size_t> count_of(std::string_view text, std::string_view key, const Place& place) {
  constexpr double most = 1e9;
  const auto value = value_of(text, key, place);
  if (!value || !value->number) return std::nullopt;
  const double n = *value->number;
  if (n < 1 || n > most || n != std::floor(n)) return std::nullopt;
  return static_cast<std::size_t>(n);
}

}  // namespace slipfront::catalogue::fsp
