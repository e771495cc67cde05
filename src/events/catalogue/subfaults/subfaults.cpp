#include "events/catalogue/subfaults/subfaults.hpp"

#include <algorithm>
#include <cmath>

#include "events/catalogue/fsp/fsp.hpp"
#include "text/characters.hpp"

namespace slipfront::catalogue::subfaults {
namespace {

struct Title {
  std::string_view name;
  double Row::*member;
  medium::Dimension dimension = medium::Dimension::ratio;  ///< an angle or a number has a ratio
  std::string_view unit_in_param = {};
};
using enum medium::Dimension;
constexpr Title titles[] = {{"lon", &Row::longitude},
                            {"longitude", &Row::longitude},
                            {"lat", &Row::latitude},
                            {"latitude", &Row::latitude},
                            {"depth", &Row::depth, length, "km"},
                            {"dep", &Row::depth, length, "km"},
                            {"z", &Row::depth, length, "km"},
                            {"length", &Row::length, length, "km"},
                            {"ss_len", &Row::length, length},
                            {"width", &Row::width, length, "km"},
                            {"ds_len", &Row::width, length},
                            {"area", &Row::area, area},
                            {"strike", &Row::strike},
                            {"dip", &Row::dip},
                            {"rake", &Row::rake},
                            {"slip", &Row::slip, length, "cm"},
                            {"ss-slip", &Row::strike_slip, length},
                            {"ds-slip", &Row::dip_slip, length},
                            {"rupture_time", &Row::rupture_time, time},
                            {"rupt_time", &Row::rupture_time, time},
                            {"t_rup", &Row::rupture_time, time},
                            {"trup", &Row::rupture_time, time},
                            {"rise_time", &Row::rise_time, time},
                            {"rise_time_starting", &Row::rise_time, time},
                            {"dura", &Row::rise_time, time},
                            {"t_ris", &Row::rise_time, time},
                            {"t_rise", &Row::rise_time, time},
                            {"trise", &Row::rise_time, time},
                            {"rise_time_ending", &Row::fall_time, time},
                            {"t_fal", &Row::fall_time, time},
                            {"t_fall", &Row::fall_time, time},
                            {"mo", &Row::moment, moment, "dyn cm"},
                            {"moment", &Row::moment, moment, "dyn cm"},
                            {"sf_moment", &Row::moment, moment},
                            {"mu", &Row::shear_modulus, pressure},
                            {"rigidity", &Row::shear_modulus, pressure},
                            {"shear_modulus", &Row::shear_modulus, pressure},
                            {"density", &Row::density, density},
                            {"segment", &Row::segment}};

const Title* find_title(std::string_view name) {
  const auto at = std::find_if(std::begin(titles), std::end(titles), [&](const Title& t) { return t.name == name; });
  return at == std::end(titles) ? nullptr : at;
}

}  // namespace

Column column_of(std::string_view title, Units units) {
  std::string name = small_letters(trimmed(title));
  std::string unit;
  if (const std::size_t bracket = name.find_first_of("(["); bracket != std::string::npos && bracket > 0) {
    unit = trimmed(std::string_view(title).substr(title.find_first_of("([") + 1));
    if (!unit.empty()) unit.pop_back();
    name = trimmed(std::string_view(name).substr(0, bracket));
  }
  if (name.ends_with('.')) name.pop_back();
  std::replace(name.begin(), name.end(), ' ', '_');
  const Title* found = find_title(name);
  if (const std::size_t last = name.rfind('_'); !found && last != std::string::npos) {  // depth_km
    unit = name.substr(last + 1);
    found = find_title(name.substr(0, last));
    if (!medium::is_unit(unit)) found = nullptr;
  }
  if (!found) return {};
  if (found->dimension == ratio) return {found->member};
  if (unit.empty() && units == Units::param) unit = found->unit_in_param;
  if (unit == "dyn cm") return {found->member, 1e-7};
  return {found->member, unit.empty() ? 1 : medium::unit_factor(unit, found->dimension)};
}

double number_in(std::string_view word, const std::string& file, std::size_t line) {
  const auto value = fsp::is_placeholder(word) || word.empty() ? std::optional(none) : fsp::number(word);
  if (value && !std::isinf(*value)) return *value;
  throw InputError({.file = file,
                    .line = line,
                    .key = "subfault",
                    .value = std::string(word),
                    .problem = value ? "out of range" : "not a number",
                    .allowed = "a finite number"});
}

Row row_of(const std::vector<std::string_view>& cells, const std::vector<Column>& columns, const std::string& file,
           std::size_t line) {
  if (cells.size() != columns.size())
    throw InputError({.file = file,
                      .line = line,
                      .key = "subfault",
                      .problem = std::to_string(cells.size()) + " numbers in this row",
                      .allowed = std::to_string(columns.size()) + ", one for each column"});
  Row row{.line = line};
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (columns[i].member) row.*columns[i].member = columns[i].factor * number_in(cells[i], file, line);
  return row;
}

}  // namespace slipfront::catalogue::subfaults
