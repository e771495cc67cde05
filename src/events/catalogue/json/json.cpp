#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "events/catalogue/format.hpp"
#include "events/catalogue/keys.hpp"
#include "math/digits.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace slipfront::catalogue {
namespace {

using Json = nlohmann::json;

const Json* find(const Json& object, const char* key) {
  const auto at = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && at != object.end() && !at->is_null() ? &*at : nullptr;
}

std::string text_of(const Json& object, const char* key) {
  const Json* value = find(object, key);
  return value && value->is_string() ? value->get<std::string>() : std::string();
}

/// A number, or a text that holds one, as in the properties of products.
std::optional<double> number_of(const Json& object, const char* key) {
  const Json* value = find(object, key);
  if (!value) return std::nullopt;
  if (value->is_number()) return value->get<double>();
  return value->is_string() ? medium::number(value->get<std::string>()) : std::nullopt;
}

/// The date of a time in milliseconds since 1970, by the civil calendar.
std::string date_of(double milliseconds) {
  if (!(std::fabs(milliseconds) < 1e14)) return {};  // from -1199 to 5138
  const auto days = std::chrono::floor<std::chrono::days>(std::chrono::milliseconds(std::llround(milliseconds)));
  const std::chrono::year_month_day date{std::chrono::sys_days(days)};
  const auto two = [](unsigned n) { return (n < 10 ? "-0" : "-") + std::to_string(n); };
  return std::to_string(static_cast<int>(date.year())) + two(unsigned(date.month())) + two(unsigned(date.day()));
}

/// A property of a finite-fault product, in the unit in which USGS gives it.
struct Property {
  const char *name, *quantity, *unit;
};
constexpr Property properties_of_products[] = {{"average-rupture-velocity", "rupture_velocity", "km/s"},
                                               {"average-rise-time", "rise_time", "s"},
                                               {"scalar-moment", "moment", "N m"},
                                               {"model-length", "rupture_length", "km"},
                                               {"model-width", "rupture_width", "km"}};

/// The properties of the finite-fault product inside the properties of an event, or else those themselves.
const Json& product_of(const Json& p) {
  const Json* products = find(p, "products");
  const Json* models = products ? find(*products, "finite-fault") : nullptr;
  const Json* model = models && models->is_array() && !models->empty() ? find(models->front(), "properties") : nullptr;
  return model ? *model : p;
}

/// Reads the properties of an event, and the quantities of a finite-fault product, which may be the same object.
void read_properties(Observation& o, const Json& p, const Json& product) {
  for (const char* key : {"title", "place", "location", "eventsource"})
    if (o.name.empty()) o.name = text_of(p, key);
  if (const auto time = number_of(p, "time")) o.date = date_of(*time);
  if (o.date.empty()) o.date = text_of(p, "eventtime").substr(0, 10);
  o.kind = text_of(p, "type");
  o.citation = text_of(p, "url");
  for (const auto& [name, quantity, unit] : properties_of_products) {
    const auto value = number_of(product, name);
    if (!value || !(*value > 0) || *value == 999) continue;
    store(o, *find_key(quantity), shortest(*value), unit);
    o.warnings.push_back(std::string(name) + " has no unit in the file: taken in " + unit);
  }
  const std::string type = text_of(p, "magType");
  const auto magnitude = type.empty() ? number_of(product, "derived-magnitude") : number_of(p, "mag");
  const bool is_mw = type.empty() || type.starts_with("mw") || type.starts_with("Mw");
  if (magnitude && is_mw) store(o, *find_key("moment_magnitude"), shortest(*magnitude), {});
}

bool is_observed(const Observation& o) { return o.rupture_velocity_m_s || o.rise_time || o.duration || o.slip; }

std::string event_text(const Observation& o, const Json& p) {
  std::string text = o.name.empty() ? "an event" : "'" + o.name + "'";
  if (!o.date.empty()) text += " of " + o.date;
  if (const auto magnitude = number_of(p, "mag")) text += ", magnitude " + digits(*magnitude, 3);
  return text;
}

/// Whether a feature is a subfault, a polygon with slip.
bool is_subfault(const Json& feature) {
  const Json* p = find(feature, "properties");
  return p && (find(*p, "slip") || find(*p, "sf_moment")) && !find(*p, "mag");
}

Observation event_of(const Json& p, const std::string& file, const std::string& id) {
  Observation o;
  o.file = file;
  o.line = 1;
  read_properties(o, p, product_of(p));
  if (!is_observed(o))
    throw InputError({.line = 1,
                      .problem = event_text(o, p) + " has no quantity that slipfront uses",
                      .allowed = "a finite-fault model of it, or a table with its velocities"});
  if (o.name.empty()) o.name = id.empty() ? file : id;
  return o;
}

/// Passes an event to `sink`, or the reason why it is none.
void pass_event(const Json& feature, const std::string& file, const Sink& sink) {
  const Json* p = find(feature, "properties");
  const std::string id = text_of(feature, "id");
  Entry entry;
  try {
    entry.observation = event_of(p ? *p : feature, file, id);
  } catch (const InputError& error) {
    entry.observation.name = id.empty() ? file : id;
    entry.observation.file = file;
    entry.error = error.complaint();
    entry.error->file = file;
  }
  sink(std::move(entry));
}

TableNotes read_json(std::string_view text, const std::string& file, const Sink& sink, const TableOptions&) {
  const Json document = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!document.is_object())
    throw InputError(
        {.file = file, .line = 1, .problem = "not a JSON object", .allowed = "an event of USGS (GeoJSON)"});
  const Json* features = find(document, "features");
  if (!features || !features->is_array()) {
    pass_event(document, file, sink);
    return {};
  }
  if (features->empty())
    throw InputError({.file = file, .line = 1, .problem = "no features", .allowed = "an event of USGS (GeoJSON)"});
  if (is_subfault(features->front()))
    throw InputError({.file = file,
                      .line = 1,
                      .problem = "the subfaults of a finite-fault model",
                      .allowed = "an event; or subfaults as polygons with slip"});
  for (const Json& feature : *features) pass_event(feature, file, sink);
  return {};
}

}  // namespace

extern const Format json_format;
const Format json_format{.ending = "json",
                         .looks_like = [](std::string_view text) { return first_character(text) == '{'; },
                         .read = read_json};

}  // namespace slipfront::catalogue
