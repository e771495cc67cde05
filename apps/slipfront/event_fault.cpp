#include <string_view>

#include "event_print.hpp"
#include "event_run.hpp"
#include "runs/fault.hpp"
#include "runs/record/faults/fault_files.hpp"
#include "slipfront/error.hpp"

namespace {

bool is_srf(const EventArguments& a) { return std::string_view(a.output).ends_with(".srf"); }

}  // namespace

bool describes_fault(const EventArguments& a) { return is_srf(a) || a.fault_grid; }

int write_fault(const EventArguments& a, const slipfront::run::CatalogueScenario& scenario) {
  slipfront::finite_fault::SourceOptions options{.closure = slipfront::friction::closure_named(a.closure)};
  if (a.damping_number) options.damping_number = *a.damping_number;
  const slipfront::run::FaultResult result = slipfront::run::fault_source(scenario, options);
  const std::string history = scenario.command_line + (a.fault_grid ? " --fault-grid -o " : " -o ") + a.output;
  if (is_srf(a))
    slipfront::record::write_srf(a.output, result.source, history);
  else
    slipfront::record::write_fault_grid(a.output, result.source, SLIPFRONT_VERSION, history);
  EventPrinter printer(a.common, {.rows = false});
  printer.take(printer.printed(result.event, 1));
  printer.finish({}, a.output);
  return printer.errors() > 0 ? exit_input : exit_done;
}
