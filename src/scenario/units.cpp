#include <limits>
#include <string>

#include "scenario/document.hpp"
#include "scenario/readers.hpp"
#include "scenario/section.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/scenario/quantities.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::scenario {

namespace {

bool needs_spacing(ModelUnit unit) {
  using enum ModelUnit;
  return unit == position || unit == time || unit == slip || unit == stiffness || unit == end_stiffness;
}

}  // namespace

medium::Dimension dimension_of(ModelUnit unit) {
  using enum ModelUnit;
  switch (unit) {
    case position:
    case slip:
      return medium::Dimension::length;
    case time:
      return medium::Dimension::time;
    case stress:
    case force:
      return medium::Dimension::pressure;
    case slip_velocity:
      return medium::Dimension::velocity;
    case stiffness:
    case end_stiffness:
      return medium::Dimension::stiffness;
    case none:
      break;
  }
  return medium::Dimension::ratio;
}

double ModelUnits::si(ModelUnit unit) const {
  using enum ModelUnit;
  if (unit == none) return 1;
  if (!known_) return std::numeric_limits<double>::quiet_NaN();
  std::string missing;
  if (!medium_.contact_ratio) missing = "medium.contact_ratio";
  if (needs_spacing(unit) && !medium_.asperity_spacing)
    missing += std::string(missing.empty() ? "" : " and ") + "medium.asperity_spacing";
  if (!missing.empty())
    throw InputError(
        {.problem = "in SI units it needs " + missing, .allowed = missing + ", or a number in the model's unit"});
  const double A = *medium_.contact_ratio, b = medium_.asperity_spacing.value_or(1);
  std::string assumed;
  const medium::Elastic rock = medium::elastic(medium_, {}, &assumed);
  if (!assumed.empty() && unit != position && unit != slip) assumed_ = assumed;
  used_ = true;
  const medium::Units units = medium::units(rock.shear_modulus, rock.speed, A, b);
  const double between_faces = medium::face_factor * units.slip;
  const auto traction = [&] { return medium::traction_unit(rock.shear_modulus, rock.poisson_ratio, A); };
  switch (unit) {
    case position:
      return units.length;
    case time:
      return units.time;
    case stress:
      return units.stress;
    case slip_velocity:
      return units.slip_velocity;
    case force:
      return traction();
    case slip:
      return between_faces;
    case stiffness:
      return traction() / between_faces;
    case end_stiffness:
      return units.stress / between_faces;
    case none:
      break;
  }
  return 1;
}

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

Interface interface_in(const Document& document) {
  const Section line(document, "domain");
  const Domain domain{line.number("left"), line.number("right")};
  return interface_of(document, domain, trial_range(domain, 0, {}));
}

/// The numbers of one table, except parameters of friction. Of springs that vary, the least and the largest number.
void add_table(const Document& document, std::string_view table, const TableReader& tables,
               std::vector<Quantity>& all) {
  const Section section(document, table);
  for (const Key* key : keys_of(table)) {
    const Value* const value = section.find(key->name);
    if (!value || (key->type != KeyType::number && key->type != KeyType::numbers)) continue;
    const ModelUnit unit = key->name == "stiffness" ? unit_of_stiffness(section) : key->scale;
    if (unit == ModelUnit::none) continue;
    const auto add = [&](const Value& item, double model, const char* which = "") {
      all.push_back({std::string(table) + "." + std::string(key->name) + which, item.text, model, symbol_of(unit),
                     product(model, known_si(document.units, unit)), medium::si_unit(dimension_of(unit))});
    };
    if (key->type == KeyType::numbers) {
      for (const Value& item : value->items) add(item, section.item_in(key->name, item, unit, key->limits));
    } else {
      const bool springs = key->name == "stiffness" || (table == "loading" && key->name == "velocity");
      if (!springs) {
        add(*value, *section.number(key->name));
        continue;
      }
      const friction::AlongInterface along =
          read_springs(section, AlongReader(section, tables, interface_in(document)), key->name);
      if (along.at) add(*value, along.least, ", least");
      add(*value, along.most, along.at ? ", largest" : "");
    }
  }
}

void add_friction(const Document& document, const TableReader& tables, const friction::Definition& law,
                  std::vector<Quantity>& all) {
  const Section section(document, "friction");
  const FrictionUnits units(section, tables, interface_in(document));
  for (const friction::Parameter& p : law.parameters) {
    const Value* const value = section.find(p.name);
    if (!value || !p.words.empty()) continue;
    const friction::AlongInterface along = units.in_model(p);
    const bool varies = along.at != nullptr;
    if (p.dimension == friction::Dimension::number && !varies) continue;
    const ModelUnit unit = FrictionUnits::unit_of(p);
    const bool has_si = unit != ModelUnit::none && (unit != ModelUnit::force || p.unit == friction::force_unit);
    const auto add = [&](const char* which, double model) {
      all.push_back({"friction." + std::string(p.name) + which, value->text, model, p.unit,
                     has_si ? product(model, known_si(document.units, unit)) : std::nullopt,
                     has_si ? medium::si_unit(dimension_of(unit)) : ""});
    };
    if (varies) add(", least", along.least);
    add(varies ? ", largest" : "", along.most);
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
                                    const std::vector<std::string>& overrides, const TableReader& tables) {
  Document document = read_document(text, file, overrides);
  document.errors.throw_if_any();
  document.in_si = first_in_si(document);
  medium::Constants medium;
  read_medium(document, medium);
  document.units = ModelUnits(medium, true);
  std::vector<Quantity> all;
  for (const std::string_view table : known_tables()) {
    if (table != "friction") {
      add_table(document, table, tables, all);
    } else if (const auto law = Section(document, table).text("law")) {
      for (const friction::Definition* known : friction::laws())
        if (known->name == *law) add_friction(document, tables, *known, all);
    }
  }
  return all;
}

}  // namespace slipfront::scenario
