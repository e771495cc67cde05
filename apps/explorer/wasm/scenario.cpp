#include "scenario.hpp"

#include <cmath>

#include "math/digits.hpp"
#include "scenario/document.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::explorer {
namespace {

std::vector<std::vector<double>>& table() {
  static std::vector<std::vector<double>> rows;
  return rows;
}

std::string in_words(const scenario::Value& value) {
  using Kind = scenario::Value::Kind;
  if (value.kind == Kind::number) return shortest(value.number);
  if (value.kind == Kind::truth) return value.number != 0 ? "true" : "false";
  if (value.kind != Kind::array) return value.text;
  std::string all;
  for (const scenario::Value& item : value.items) all += (all.empty() ? "" : ",") + in_words(item);
  return "[" + all + "]";
}

Object described(const friction::Parameter& p) {
  std::vector<std::string> words(p.words.begin(), p.words.end());
  return Object()
      .put("name", p.name)
      .put("symbol", p.symbol)
      .put("unit", p.unit)
      .put("value", p.value)
      .put("least", p.least)
      .put("most", p.most)
      .put("without_least", p.without_least)
      .put("words", words);
}

const char* word_for(friction::CurveSource source) {
  if (source == friction::CurveSource::formula) return "formula";
  return source == friction::CurveSource::table ? "table" : "none";
}

}  // namespace

scenario::Scenario scenario_of(const char* toml, const std::vector<std::string>& changes) {
  return scenario::read_scenario(toml, "", changes, [](const std::string&, const std::vector<std::string>&) {
    if (table().empty())
      throw InputError({.key = "initial.file",
                        .problem = "the page has no such table",
                        .allowed = "a CSV file with columns x and stress, dropped onto the page with the scenario"});
    return table();
  });
}

/// Sets the rows of the table that a scenario may name.
SLIPFRONT_EXPORT const char* set_table(const double* x, const double* y, int rows) {
  return answer([=] {
    table().clear();
    for (int i = 0; i < rows; ++i) table().push_back({x[i], y[i]});
    return Object();
  });
}

/// Checks a scenario. Returns its keys and values as in the address of the page, such as "friction.coefficient", its
/// warnings, and its initial stress.
SLIPFRONT_EXPORT const char* scenario(const char* toml) {
  return answer([=] {
    const scenario::Document document = scenario::read_document(toml, "", {});
    const scenario::Scenario s = scenario_of(toml);
    std::vector<Object> keys;
    if (document.title) keys.push_back(Object().put("key", "title").put("value", in_words(*document.title)));
    for (const auto& [name, content] : document.tables)
      for (const auto& [key, value] : content.values)
        keys.push_back(Object().put("key", name + "." + key).put("value", in_words(value)));
    const pulse::Problem problem = scenario::stated_problem(s);
    std::vector<double> x, stress;
    constexpr int points = 400;
    for (int i = 0; i <= points; ++i) {
      x.push_back(problem.left + (problem.right - problem.left) * i / points);
      stress.push_back(s.stress(x.back()));
    }
    return Object()
        .put("keys", keys)
        .put("warnings", s.warnings)
        .put("end", s.end)
        .put("left", problem.left)
        .put("right", problem.right)
        .numbers("x", x)
        .numbers("stress", stress);
  });
}

/// All friction laws that the page can run, with their parameters.
SLIPFRONT_EXPORT const char* laws() {
  return answer([] {
    std::vector<Object> all;
    for (const friction::Definition* law : friction::laws()) {
      std::vector<Object> parameters;
      for (const friction::Parameter& p : law->parameters)
        if (!p.only_on_chain) parameters.push_back(described(p));
      all.push_back(Object()
                        .put("name", law->name)
                        .put("equation", law->equation)
                        .put("source", law->source)
                        .put("curve", word_for(law->curve))
                        .put("remembers", !law->state.empty())
                        .put("parameters", parameters));
    }
    return Object().put("laws", all);
  });
}

}  // namespace slipfront::explorer
