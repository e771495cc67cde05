#include "events/catalogue/toml/toml.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/format.hpp"
#include "events/catalogue/keys.hpp"
#include "math/digits.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "text/characters.hpp"
#include "text/toml.hpp"

namespace slipfront::catalogue {
namespace {

using Shape = MeasuredValue::Shape;

/// A kind of distribution and the two keys that define it.
struct Form {
  const char *first, *second;
  Shape shape;
};
constexpr Form forms[] = {
    {"mean", "sd", Shape::normal}, {"median", "factor", Shape::lognormal}, {"low", "high", Shape::range}};
constexpr const char* allowed = "{ mean, sd }, { median, factor } or { low, high }";

void require_known(const toml::table& table, const std::string& full_key) {
  std::vector<std::string_view> known;
  for (const Form& form : forms) known.insert(known.end(), {form.first, form.second});
  for (const auto& [key_node, node] : table) {
    const std::string key(key_node.str());
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw InputError({.line = line_of(node),
                        .key = full_key + "." + key,
                        .problem = "unknown key",
                        .allowed = nearest_or_all(key, known)});
  }
}

const Form& form_of(const toml::table& table, const std::string& full_key) {
  for (const Form& form : forms)
    if (table.size() == 2 && table.contains(form.first) && table.contains(form.second)) return form;
  throw InputError({.line = line_of(table),
                    .key = full_key,
                    .problem = "these keys do not make a distribution",
                    .allowed = allowed});
}

/// One number of the distribution, which must not be uncertain itself.
double number_of(const toml::table& table, const char* name, const std::string& full_key, medium::Dimension dimension) {
  const toml::node& node = *table.get(name);
  const std::string text = quantity_text(node);
  try {
    if (text.empty())
      throw InputError({.problem = "neither a number nor a text", .allowed = std::string(medium::example(dimension))});
    const MeasuredValue m = parse_measured(text, dimension, {});
    if (!m.is_exact())
      throw InputError(
          {.value = text, .problem = "not one number", .allowed = std::string(medium::example(dimension))});
    return m.low;
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.key = full_key + "." + name;
    c.line = line_of(node);
    throw InputError(c);
  }
}

}  // namespace

std::string quantity_text(const toml::node& node) {
  if (const auto text = node.value<std::string>()) return *text;
  if (!node.is_number()) return {};
  return shortest(node.value_or(0.0));
}

MeasuredValue read_distribution(const toml::table& table, const std::string& full_key, const Key& key) {
  require_known(table, full_key);
  const Form& form = form_of(table, full_key);
  const double first = number_of(table, form.first, full_key, key.dimension);
  const double second = number_of(table, form.second, full_key,
                                  form.shape == Shape::lognormal ? medium::Dimension::ratio : key.dimension);
  const auto refuse = [&](const char* problem, const char* wanted) {
    throw InputError({.line = line_of(*table.get(form.second)),
                      .key = full_key + "." + form.second,
                      .value = quantity_text(*table.get(form.second)),
                      .problem = problem,
                      .allowed = wanted});
  };
  switch (form.shape) {
    case Shape::normal:
      if (!(second > 0)) refuse("the uncertainty is not positive", "> 0");
      return {first, first, Shape::normal, second};
    case Shape::lognormal:
      if (!(second > 1)) refuse("not a valid factor of a lognormal distribution", "> 1");
      return {first, first, Shape::lognormal, second};
    case Shape::range:
    case Shape::split:  // no keys define it
      break;
  }
  if (second < first) refuse("the range runs downwards", "low <= high");
  return {first, second};
}

namespace {

std::string text_value(const toml::node& node, const std::string& key) {
  if (const auto text = node.value<std::string>()) return *text;
  if (node.is_integer() || node.is_date() || node.is_date_time()) return toml_text(node);
  throw InputError({.line = line_of(node), .key = key, .problem = "not a text", .allowed = "a text in quotes"});
}

void read_quantity(Observation& o, const Key& key, const std::string& full_key, const toml::node& node) {
  try {
    if (const toml::table* table = node.as_table()) {
      store(o, key, read_distribution(*table, full_key, key), toml_text(*table));
      return;
    }
    if (!node.is_string() && !node.is_number())
      throw InputError(
          {.problem = "neither a number nor a text", .allowed = std::string(medium::example(key.dimension))});
    store(o, key, quantity_text(node), {});
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    if (c.key.empty()) c.key = full_key;
    if (c.line == 0) c.line = line_of(node);
    throw InputError(c);
  }
}

void read_text(Observation& o, std::string_view key, const std::string& full_key, const toml::node& node) {
  try {
    store_text(o, key,
               node.is_floating_point() && key == "front_threshold" ? quantity_text(node) : text_value(node, full_key));
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.key = full_key;
    c.line = line_of(node);
    throw InputError(c);
  }
}

/// Reads the table [event], with the observed quantities and texts, or the table [medium], with the elastic constants.
void read_table(Observation& o, const toml::table& table, const std::string& name, bool observed) {
  std::vector<std::string_view> known;
  if (observed) known = text_keys();
  for (const Key& key : quantity_keys())
    if ((key.measured != nullptr) == observed) known.push_back(key.name);
  for (const auto& [key_node, node] : table) {
    const std::string key(key_node.str());
    const std::string full_key = name + "." + key;
    const Key* quantity = find_key(key);
    if (quantity && (quantity->measured != nullptr) == observed) {
      read_quantity(o, *quantity, full_key, node);
    } else if (observed && std::find(text_keys().begin(), text_keys().end(), key) != text_keys().end()) {
      read_text(o, key, full_key, node);
    } else {
      const std::string other = observed ? "[medium]" : "[event]";
      throw InputError({.line = line_of(node),
                        .key = full_key,
                        .problem = quantity ? "wrong table" : "unknown key",
                        .allowed = quantity ? key + " in " + other : nearest_or_all(key, known)});
    }
  }
}

/// One file can be both an event and the scenario of a `pulse` run, so we accept the tables of a scenario.
bool belongs_to_scenario(std::string_view table) {
  for (const std::string_view name :
       {"initial", "friction", "forcing", "interface", "domain", "time", "pulse", "chain", "output"})
    if (table == name) return true;
  return false;
}

Observation read_document(const toml::table& document) {
  Observation o;
  const toml::table* event = nullptr;
  for (const auto& [key_node, node] : document) {
    const std::string key(key_node.str());
    if (key == "title") {
      if (o.name.empty()) o.name = text_value(node, key);
    } else if ((key == "event" || key == "medium") && node.is_table()) {
      if (key == "event") event = node.as_table();
      read_table(o, *node.as_table(), key, key == "event");
    } else if (!(node.is_table() && belongs_to_scenario(key))) {
      const bool table_wanted = key == "event" || key == "medium";
      throw InputError({.line = line_of(node),
                        .key = key,
                        .problem = table_wanted ? "not a table" : "unknown key",
                        .allowed = table_wanted ? "[" + key + "]" : nearest_or_all(key, {"title", "event", "medium"})});
    }
  }
  if (!event)
    throw InputError(
        {.problem = "there is no [event] table", .allowed = "[event] with rupture_velocity, slip_velocity, ..."});
  o.line = line_of(*event);
  return o;
}

}  // namespace

Observation read_toml(std::string_view text, const std::string& file) {
  try {
    Observation o = read_document(parse_toml(text, file));
    if (o.name.empty()) o.name = file;
    o.file = file;
    return o;
  } catch (const InputError& error) {
    Complaint c = error.complaint();
    c.file = file;
    throw InputError(c);
  }
}

extern const Format toml_format;
const Format toml_format{.ending = ".toml",
                         .looks_like =
                             [](std::string_view text) {
                               return first_character(text) == '[' || text.find("\n[") != std::string_view::npos;
                             },
                         .read =
                             [](std::string_view text, const std::string& file, const Sink& sink, const TableOptions&) {
                               sink({read_toml(text, file), {}});
                               return TableNotes{};
                             }};

}  // namespace slipfront::catalogue
