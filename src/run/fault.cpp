#include "run/fault.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "catalogue/fault_model.hpp"
#include "slipfront/error.hpp"

namespace slipfront::run {

FaultResult fault_source(const CatalogueScenario& scenario, const finite_fault::SourceOptions& options) {
  const char* const allowed = "one finite-fault model in .fsp format";
  if (scenario.texts.size() != 1)
    throw InputError({.file = "command line",
                      .key = "FILE",
                      .value = std::to_string(scenario.texts.size()) + " files",
                      .problem = "a source is made of one model",
                      .allowed = allowed});
  const EventText& text = scenario.texts.front();
  if (!text.error.empty()) throw FileError(text.error);
  for (const std::string_view ending : {".csv", ".toml"})
    if (text.name.ends_with(ending))
      throw InputError({.file = text.name, .problem = "no finite-fault model", .allowed = allowed});
  catalogue::FaultModel model = catalogue::read_fault_model(text.text, text.name);
  const medium::Defaults defaults = medium::defaults_of(scenario.medium);
  FaultResult out{finite_fault::finite_source(model, defaults, options), {}};
  catalogue::Entry entry{std::move(model.observation), {}};
  out.event = results::evaluate(std::move(entry), defaults, scenario.evaluation);
  if (!out.event.estimate) return out;
  std::vector<std::string>& warnings = out.event.estimate->warnings;
  for (const std::string& note : out.source.notes)
    if (std::find(warnings.begin(), warnings.end(), note) == warnings.end()) warnings.push_back(note);
  return out;
}

}  // namespace slipfront::run
