#include <string_view>

#include "event_print.hpp"
#include "event_run.hpp"
#include "record/faults/srf_file.hpp"
#include "run/fault.hpp"
#include "slipfront/error.hpp"

bool describes_fault(const EventArguments& a) { return std::string_view(a.output).ends_with(".srf"); }

int write_fault(const EventArguments& a, const slipfront::run::CatalogueScenario& scenario) {
  slipfront::finite_fault::SourceOptions options{.closure = slipfront::friction::closure_named(a.closure)};
  if (a.damping_number) options.damping_number = *a.damping_number;
  const slipfront::run::FaultResult result = slipfront::run::fault_source(scenario, options);
  slipfront::record::write_srf(a.output, result.source, scenario.command_line + " -o " + a.output);
  EventPrinter printer(a.common, {.rows = false});
  printer.take(printer.printed(result.event));
  printer.finish({}, a.output);
  return printer.errors() > 0 ? exit_input : exit_done;
}
