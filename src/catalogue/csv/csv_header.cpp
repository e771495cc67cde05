#include "catalogue/csv/csv_header.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "foundation/text/nearest.hpp"

namespace slipfront::catalogue {

namespace {

using Role = Column::Role;

/// Other names under which published tables carry a quantity.
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> aliases = {{
    {"rv", "rupture_velocity"},
    {"mean_slip", "slip"},
    {"vs_at_hypocentre", "s_wave_speed"},
    {"vp_at_hypocentre", "p_wave_speed"},
}};
constexpr std::array<std::pair<std::string_view, Role>, 13> texts = {{
    {"name", Role::name},
    {"event", Role::name},
    {"date", Role::date},
    {"year", Role::date},
    {"kind", Role::kind},
    {"citation", Role::citation},
    {"source", Role::citation},
    {"note", Role::note},
    {"notes", Role::note},
    {"slip_velocity_is", Role::slip_velocity_is},
    {"rupture_velocity_is", Role::rupture_velocity_is},
    {"stress_drop_is", Role::stress_drop_is},
    {"front_threshold", Role::front_threshold},
}};
/// Endings of columns that say how a quantity was found.
constexpr std::array<std::string_view, 6> about = {"how", "type", "source", "method", "note", "notes"};

bool begins_with_word(std::string_view text, std::string_view word) {
  if (text.substr(0, word.size()) != word) return false;
  return text.size() == word.size() || text[word.size()] == '_' || text[word.size()] == ' ' ||
         text[word.size()] == '[' || text[word.size()] == '(';
}

/// The quantity that a title begins with, and what follows it.
std::pair<const Key*, std::string_view> leading_key(std::string_view title) {
  const Key* best = nullptr;
  std::size_t length = 0;
  const auto consider = [&](std::string_view word, const Key* key) {
    if (word.size() > length && begins_with_word(title, word)) {
      best = key;
      length = word.size();
    }
  };
  for (const Key& key : quantity_keys()) consider(key.name, &key);
  for (const auto& [alias, name] : aliases) consider(alias, find_key(name));
  return {best, title.substr(length)};
}

/// "_km_s", " [km/s]" or "(km/s)" -> "km/s".
std::string unit_of(std::string_view rest) {
  const auto open = rest.find_first_of("[(");
  if (open != std::string_view::npos) {
    const auto close = rest.find_last_of("])");
    return close != std::string_view::npos && close > open ? std::string(rest.substr(open + 1, close - open - 1))
                                                           : std::string(rest);
  }
  while (!rest.empty() && (rest.front() == '_' || rest.front() == ' ')) rest.remove_prefix(1);
  std::string unit(rest);
  std::replace(unit.begin(), unit.end(), '_', '/');
  return unit;
}

void refuse_near_miss(const std::string& title) {
  for (std::size_t end = 0; end <= title.size(); ++end) {
    if (end < title.size() && title[end] != '_' && title[end] != ' ' && title[end] != '[') continue;
    const std::string_view head = std::string_view(title).substr(0, end);
    if (head.size() < 6 || head.size() > 40) continue;
    for (const Key& key : quantity_keys())
      if (key.name.size() > 6 && edit_distance(head, key.name) <= 2)
        throw InputError({.key = title,
                          .problem = "unknown column",
                          .allowed = "'" + std::string(key.name) + "' (the nearest known name) with its unit"});
  }
}

}  // namespace

Column parse_column(const std::string& title) {
  for (const auto& [word, role] : texts)
    if (title == word) return {role, title, nullptr, {}};
  auto [key, rest] = leading_key(title);
  if (!key) {
    refuse_near_miss(title);
    return {Role::ignored, title, nullptr, {}};
  }
  for (const std::string_view word : about)
    if (rest == "_" + std::string(word)) return {word == "how" ? Role::provenance : Role::ignored, title, key, {}};
  Role role = Role::quantity;
  if (key->measured && begins_with_word(rest, "_min")) role = Role::range_low;
  if (key->measured && begins_with_word(rest, "_max")) role = Role::range_high;
  if (role != Role::quantity) rest.remove_prefix(4);
  std::string unit = unit_of(rest);
  if (!unit.empty()) {
    try {
      medium::unit_factor(unit, key->dimension);
    } catch (const InputError& error) {
      throw InputError({.key = title,
                        .problem = error.complaint().problem,
                        .allowed = std::string(medium::example(key->dimension))});
    }
  }
  return {role, title, key, std::move(unit)};
}

}  // namespace slipfront::catalogue
