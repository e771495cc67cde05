#include <string_view>

#include "event_print.hpp"
#include "event_run.hpp"
#include "math/digits.hpp"
#include "runs/fault.hpp"
#include "runs/record/faults/fault_files.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

namespace {

using slipfront::run::FaultResult;

bool ends_with(const EventArguments& a, std::string_view ending) {
  return std::string_view(a.output).ends_with(ending);
}

/// Writes a text format. Adds a note for what the format does not hold.
void write_fault_text(const EventArguments& a, FaultResult& result, const std::string& history) {
  using slipfront::record::SrfVersion;
  const auto version = a.srf_version == "1.0" ? SrfVersion::v1 : SrfVersion::v2;
  const slipfront::record::DescribedSource described{result.source, result.event.observation};
  slipfront::record::write_text(a.output, ends_with(a, ".srf")   ? srf_text(result.source, history, version)
                                          : ends_with(a, ".fsp") ? fsp_text(described, history)
                                                                 : slipfront::record::subfaults_csv(result.source));
  if (!ends_with(a, ".srf") || version == SrfVersion::v2 || !result.event.estimate) return;
  double potency = 0;
  for (const auto& segment : result.source.segments)
    for (const auto& point : segment.points) potency += segment.cell_area() * point.slip;
  result.event.estimate->warnings.push_back(
      "SRF 1.0 holds no shear modulus: its moment is " + slipfront::digits(result.source.moment, 7) +
      " N m only with that of this model, " + slipfront::digits(result.source.moment / potency, 4) + " Pa in the mean");
}

}  // namespace

bool describes_fault(const EventArguments& a) { return writes_source(a) || a.fault_grid; }

bool writes_source(const EventArguments& a) { return ends_with(a, ".srf") || ends_with(a, ".fsp"); }

int write_fault(const EventArguments& a, const slipfront::run::CatalogueScenario& scenario) {
  slipfront::finite_fault::SourceOptions options{.closure = slipfront::friction::closure_named(a.closure),
                                                 .any_mesh = ends_with(a, ".srf")};
  if (a.damping_number) options.damping_number = *a.damping_number;
  FaultResult result = slipfront::run::fault_source(scenario, options);
  const std::string history = scenario.command_line + (a.fault_grid ? " --fault-grid -o " : " -o ") + a.output;
  if (ends_with(a, ".nc"))
    slipfront::record::write_fault_grid(a.output, result.source, SLIPFRONT_VERSION, history);
  else
    write_fault_text(a, result, history);
  EventPrinter printer(a.common, {.rows = false});
  printer.take(printer.printed(result.event, 1));
  printer.finish({}, a.output);
  return printer.errors() > 0 ? exit_input : exit_done;
}
