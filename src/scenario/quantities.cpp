#include "slipfront/scenario/quantities.hpp"

#include "scenario/friction/friction_units.hpp"
#include "scenario/plane/plane.hpp"
#include "scenario/settings.hpp"
#include "scenario/text/section.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::scenario {
namespace {

/// The value of a unit in SI units, if the constants determine it.
std::optional<double> known_si(const ModelUnits& units, ModelUnit unit) {
  try {
    return units.si(unit);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::optional<double> product(double number, const std::optional<double>& unit) {
  return unit ? std::optional(number * *unit) : std::nullopt;
}

/// The numbers of one table, except parameters of friction.
void add_table(const Document& document, std::string_view table, std::vector<Quantity>& all) {
  const Section section(document, table);
  for (const Key* key : keys_of(table)) {
    const Value* const value = section.find(key->name);
    if (!value || (key->type != KeyType::number && key->type != KeyType::numbers)) continue;
    const ModelUnit unit = key->name == "stiffness" ? unit_of_stiffness(section) : key->scale;
    if (unit == ModelUnit::none) continue;
    const auto add = [&](const Value& item, double model) {
      all.push_back({std::string(table) + "." + std::string(key->name), item.text, model, symbol_of(unit),
                     product(model, known_si(document.units, unit)), medium::si_unit(dimension_of(unit))});
    };
    if (key->type == KeyType::numbers) {
      for (const Value& item : value->items) add(item, section.item_in(key->name, item, unit, key->limits));
    } else {
      add(*value, key->name == "stiffness" ? *stiffness_of(section) : *section.number(key->name));
    }
  }
}

void add_friction(const Document& document, const friction::Definition& law, std::vector<Quantity>& all) {
  const Section section(document, "friction");
  FrictionUnits units(section);
  for (const friction::Parameter& p : law.parameters) {
    const Value* const value = section.find(p.name);
    if (!value || p.dimension == friction::Dimension::number || !p.words.empty()) continue;
    const double model = units.in_model(p);
    const ModelUnit unit = FrictionUnits::unit_of(p);
    const bool has_si = unit != ModelUnit::none && (unit != ModelUnit::force || p.unit == friction::force_unit);
    all.push_back({"friction." + std::string(p.name), value->text, model, p.unit,
                   has_si ? product(model, known_si(document.units, unit)) : std::nullopt,
                   has_si ? medium::si_unit(dimension_of(unit)) : ""});
  }
}

}  // namespace

std::vector<Scale> scales_of(const medium::Constants& medium) {
  const ModelUnits units(medium, true);
  std::vector<Scale> all;
  for (const auto& [name, unit] : {std::pair<std::string_view, ModelUnit>{"position", ModelUnit::position},
                                   {"time", ModelUnit::time},
                                   {"slip between the faces", ModelUnit::slip},
                                   {"slip velocity between the faces", ModelUnit::slip_velocity},
                                   {"stress", ModelUnit::stress},
                                   {"force F, friction f", ModelUnit::force},
                                   {"stiffness of springs everywhere", ModelUnit::stiffness}})
    all.push_back({name, symbol_of(unit), known_si(units, unit), medium::si_unit(dimension_of(unit))});
  return all;
}

std::vector<Quantity> quantities_of(std::string_view text, const std::string& file,
                                    const std::vector<std::string>& overrides) {
  Document document = read_document(text, file, overrides);
  document.errors.throw_if_any();
  if (is_plane(document)) take_coefficient(document);
  document.in_si = first_in_si(document);
  medium::Constants medium;
  read_medium(document, medium);
  document.units = ModelUnits(medium, true);
  std::vector<Quantity> all;
  for (const std::string_view table : known_tables()) {
    if (table != "friction") {
      add_table(document, table, all);
    } else if (const auto law = Section(document, table).text("law")) {
      for (const friction::Definition* known : friction::laws())
        if (known->name == *law) add_friction(document, *known, all);
    }
  }
  return all;
}

}  // namespace slipfront::scenario
