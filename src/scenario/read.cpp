#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "scenario/document.hpp"
#include "scenario/readers.hpp"
#include "scenario/section.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "text/characters.hpp"

namespace slipfront::scenario {

namespace {

constexpr double most_outputs = 1e6;

std::vector<double> read_times(const Section& section, double end) {
  std::vector<double> times;
  const Value* const array = section.array("times", "an array of times, such as [1, 2.5]");
  if (!array) return times;
  const Limits limits{.least = 0, .most = end};  // [time] end
  for (const Value& item : array->items) {
    const double time = section.item_in("times", item, ModelUnit::time, limits);
    if (!times.empty() && !(time > times.back()))
      throw section.refuse("times", item, "not after the time before it", "times strictly increasing");
    times.push_back(time);
  }
  return times;
}

std::vector<std::string> read_variables(const Section& section) {
  const std::vector<std::string_view>& known = section.key("variables").words;
  std::vector<std::string> variables;
  const Value* const array = section.array("variables", "an array of names, such as [\"Sigma\", \"slip\"]");
  if (!array) return variables;
  for (const Value& item : array->items) {
    const auto found = std::find(known.begin(), known.end(), item.text);
    if (item.kind != Value::Kind::text || found == known.end())
      throw section.refuse("variables", item, "unknown variable", nearest_or_all(item.text, known));
    if (std::find(variables.begin(), variables.end(), item.text) != variables.end())
      throw section.refuse("variables", item, "given twice", "each name once");
    variables.push_back(item.text);
  }
  if (variables.empty()) throw section.refuse("variables", "an empty list", "leave it out to write all");
  return variables;
}

void read_domain(const Document& document, Domain& domain) {
  const Section section(document, "domain");
  domain.left = section.number("left");
  domain.right = section.number("right");
  if (domain.left && domain.right && *domain.left >= *domain.right)  // NaN: [medium] has an error
    throw section.refuse(
        "right", "not to the right of domain.left",
        "> " + section.bound_as_written("right", *section.find("right"), ModelUnit::position, *domain.left));
}

void read_pulse(const Document& document, PulseOptions& pulse) {
  const Section section(document, "pulse");
  section.read("cells", pulse.cells);
  section.read("tolerance", pulse.tolerance);
  section.read("threshold", pulse.threshold);
  section.read("left", pulse.left);
  section.read("right", pulse.right);
  section.read("periodic", pulse.periodic);
  section.read("trains", pulse.many_trains);
}

void read_chain(const Document& document, ChainOptions& chain) {
  const Section section(document, "chain");
  section.read("scale", chain.scale);
  section.read("spacing", chain.spacing);
  section.read("model", chain.model);
  section.read("left", chain.left);
  section.read("right", chain.right);
  section.read("periodic", chain.periodic);
  section.read("window", chain.window);
  section.read("steps", chain.implicit);
  section.read("tolerance", chain.tolerance);
  section.read("precision", chain.phases_of_32_bits);
  if (section.has("tolerance") && section.has("steps") && !chain.implicit)
    throw section.refuse("tolerance", "is of implicit steps", "with chain.steps = \"implicit\" or [loading]");
}

Output read_output(const Document& document, double end) {
  const Section section(document, "output");
  Output output;
  output.times = read_times(section, end);
  output.every = section.number("every");
  if (output.every && section.has("times"))
    throw section.refuse("every", "output.times is given too", "one of the two");
  if (output.every && end / *output.every > most_outputs)
    throw section.refuse(
        "every", "more than a million outputs",
        ">= " + section.bound_as_written("every", *section.find("every"), ModelUnit::time, end / most_outputs));
  section.read("per_event", output.per_event);
  if (output.per_event > 0 && document.tables.count("loading") == 0)
    throw section.refuse("per_event", "without [loading] there are no slip events", "with [loading]");
  output.variables = read_variables(section);
  section.read("fronts", output.fronts);
  section.read("displacement", output.displacement);
  section.read("dislocations", output.dislocations);
  return output;
}

}  // namespace

void read_medium(const Document& document, medium::Constants& options) {
  const Section section(document, "medium");
  Errors errors;
  for (const medium::Constant& constant : medium::constants()) {
    const Value* const value = section.find(constant.name);
    if (!value) continue;
    errors.attempt([&] {
      const double quantity = section.quantity(constant.name, *value, constant.dimension);
      const Key& key = section.key(constant.name);
      if (!key.limits.hold(quantity))
        throw section.refuse(constant.name, key.limits.least < 0 ? "out of range" : "not positive", key.allowed());
      options.*constant.member = quantity;
    });
  }
  errors.throw_if_any();
}

namespace {

std::string read_title(const Document& document) {
  if (!document.title) return {};
  const Value& title = *document.title;
  if (title.kind == Value::Kind::text) return title.text;
  throw InputError({.file = title.overridden ? "--set" : document.file,
                    .line = title.line,
                    .key = "title",
                    .value = title.text,
                    .problem = "not a text",
                    .allowed = "a text in quotes"});
}

/// Reads [initial] of a scenario on a line.
RawStress read_line(const Document& document, const TableReader& tables, Scenario& scenario) {
  const Section output(document, "output");
  if (output.has("probes")) throw output.refuse("probes", "are points of a plane", "with [plane]");
  const Value* const lines = output.find("lines");
  if (lines && lines->kind == Value::Kind::truth && lines->number != 0)
    throw output.refuse("lines", "are those of a plane", "with [plane]");
  return read_initial(document, tables, scenario.initial);
}

void refuse_nucleation(const Document& document) {
  if (document.tables.count("nucleation") > 0)
    throw InputError({.file = document.file,
                      .line = document.tables.at("nucleation").line,
                      .key = "nucleation",
                      .problem = "this table is about a plane",
                      .allowed = "with [plane]"});
}

/// Reads the tables. It does not read a table whose single values have errors.
RawStress read_tables(const Document& document, const TableReader& tables, Scenario& scenario, Errors& errors) {
  std::vector<std::string_view> broken;
  for (const std::string_view table : known_tables())
    if (!errors.attempt([&] { Section(document, table).check_values(); })) broken.push_back(table);
  const auto attempt = [&](std::string_view table, const auto& task) {
    if (std::find(broken.begin(), broken.end(), table) == broken.end()) errors.attempt(task);
  };
  RawStress raw;
  const bool has_initial = document.tables.count("initial") > 0;
  if (has_initial || !document.errors.any())  // else the unknown table may be [initial]
    attempt("initial", [&] {
      if (!is_plane(document)) raw = read_line(document, tables, scenario);
    });
  attempt("domain", [&] { read_domain(document, scenario.domain); });
  attempt("friction", [&] { read_friction(document, tables, raw, scenario); });
  attempt("time", [&] { Section(document, "time").read("end", scenario.end); });
  attempt("pulse", [&] { read_pulse(document, scenario.pulse); });
  attempt("chain", [&] { read_chain(document, scenario.chain); });
  attempt("loading", [&] { read_loading(document, tables, scenario); });
  if (scenario.loading.acts()) scenario.chain.implicit = true;
  if (std::find(broken.begin(), broken.end(), "time") == broken.end())  // it bounds the times of results
    attempt("output", [&] { scenario.output = read_output(document, scenario.end); });
  return raw;
}

Scenario read(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
              const TableReader& tables) {
  Document document = read_document(text, file, overrides);
  Errors errors = document.errors;
  Scenario scenario;
  errors.attempt([&] { scenario.title = read_title(document); });
  scenario.file = file;
  scenario.text = document.text;
  scenario.overrides = overrides;
  document.in_si = first_in_si(document);
  const bool units = errors.attempt([&] { read_medium(document, scenario.medium); });
  document.units = ModelUnits(scenario.medium, units);
  const RawStress raw = read_tables(document, tables, scenario, errors);
  errors.throw_if_any();
  if (is_plane(document)) {
    read_plane(document, tables, scenario);
    read_plane_output(document, *scenario.plane);
  } else {
    refuse_nucleation(document);
    make_functions(document, raw, scenario);
  }
  scenario.in_si = document.units.used();
  if (!document.units.assumed().empty())
    scenario.warnings.push_back("SI units were converted with " + document.units.assumed() +
                                ", which [medium] does not give");
  return scenario;
}

}  // namespace

Scenario read_scenario(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const TableReader& tables) {
  try {
    return read(text, file, overrides, tables);
  } catch (const InputError& error) {  // an error of the parser or of a table does not name the file
    std::vector<Complaint> all = error.complaints();
    for (Complaint& complaint : all)
      if (complaint.file.empty()) complaint.file = file;
    const Complaint first = all.front();
    all.erase(all.begin());
    throw InputError(first, std::move(all));
  }
}

}  // namespace slipfront::scenario
