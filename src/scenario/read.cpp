#include <algorithm>
#include <utility>
#include <vector>

#include "scenario/plane/plane.hpp"
#include "scenario/profile/initial.hpp"
#include "scenario/settings.hpp"
#include "scenario/text/document.hpp"
#include "scenario/text/section.hpp"
#include "scenario/validate.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {
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
  const auto profile = Section(document, "initial").text("profile");
  if (profile == "radial" || profile == "grid")
    throw Section(document, "initial")
        .refuse("profile", "is of a plane", "step, tanh, formula, table, or with [plane]");
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
  attempt("friction", [&] { read_friction(document, tables, scenario); });
  attempt("domain", [&] { read_domain(document, scenario.domain); });
  attempt("time", [&] { scenario.end = read_end(document, scenario.end); });
  attempt("pulse", [&] { read_pulse(document, scenario.pulse); });
  attempt("chain", [&] { read_chain(document, scenario.chain); });
  attempt("loading", [&] { read_loading(document, scenario.loading); });
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
  std::string coefficient;
  if (is_plane(document)) errors.attempt([&] { coefficient = take_coefficient(document); });
  scenario.file = file;
  scenario.text = document.text;
  scenario.overrides = overrides;
  document.in_si = first_in_si(document);
  const bool units = errors.attempt([&] { read_medium(document, scenario.medium); });
  document.units = ModelUnits(scenario.medium, units);
  const RawStress raw = read_tables(document, tables, scenario, errors);
  errors.throw_if_any();
  if (is_plane(document)) {
    read_plane(document, tables, coefficient, scenario);
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
