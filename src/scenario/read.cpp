#include "scenario/profile/initial.hpp"
#include "scenario/settings.hpp"
#include "scenario/text/document.hpp"
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

Scenario read(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
              const TableReader& tables) {
  const Document document = read_document(text, file, overrides);
  Scenario scenario;
  scenario.title = read_title(document);
  scenario.file = file;
  scenario.text = document.text;
  scenario.overrides = overrides;
  const RawStress raw = read_initial(document, tables, scenario.initial);
  read_medium(document, scenario.medium);
  read_friction(document, tables, scenario);
  read_domain(document, scenario.domain);
  scenario.end = read_end(document, scenario.end);
  read_pulse(document, scenario.pulse);
  read_chain(document, scenario.chain);
  read_loading(document, scenario.loading);
  if (scenario.loading.acts()) scenario.chain.implicit = true;
  scenario.output = read_output(document, scenario.end);
  make_functions(document, raw, scenario);
  return scenario;
}

}  // namespace

Scenario read_scenario(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const TableReader& tables) {
  try {
    return read(text, file, overrides, tables);
  } catch (const InputError& error) {  // an error of the parser or of a table does not name the file
    Complaint complaint = error.complaint();
    if (!complaint.file.empty()) throw;
    complaint.file = file;
    throw InputError(complaint);
  }
}

}  // namespace slipfront::scenario
