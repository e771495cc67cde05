#include "catalogue/toml/toml_distribution.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "foundation/text/digits.hpp"
#include "foundation/text/nearest.hpp"

namespace slipfront::catalogue {
namespace {

using Shape = Measured::Shape;

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
    const Measured m = parse_measured(text, dimension, {});
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

Measured read_distribution(const toml::table& table, const std::string& full_key, const Key& key) {
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

}  // namespace slipfront::catalogue
