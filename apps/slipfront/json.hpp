#pragma once
/// \file
/// How the program writes JSON.

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

/// Keys keep their order. A number that is NaN or infinite becomes null.
using Json = nlohmann::ordered_json;

/// An error with three digits, because it is not known more precisely.
inline double rounded(double error) { return std::strtod(fmt::format("{:.3g}", error).c_str(), nullptr); }

inline Json json_of(const std::optional<double>& x) { return x ? Json(*x) : Json(); }

/// Writes 0 for -0, because the sign has no meaning.
inline void unsign_zeros(Json& json) {
  if (json.is_structured())
    for (Json& item : json) unsign_zeros(item);
  else if (json.is_number_float() && json.get<double>() == 0)
    json = 0.0;
}

/// One line of ASCII, whatever bytes a name has.
inline std::string text_of(Json json) {
  unsign_zeros(json);
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}
