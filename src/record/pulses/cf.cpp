#include "record/pulses/cf.hpp"

#include <numeric>
#include <span>
#include <string>
#include <string_view>

namespace slipfront::record::cf {
namespace {

using netcdf::Writer;

constexpr AxisVariables axis = {
    .time = {"time", "time", "b / (c A)", "Eq. 3"},
    .x = {"x", "position along the interface, centre of the cell", "b / A", "Eq. 3"},
    .x_bounds = {"x_bounds", "ends of the cell", "b / A", "Eq. 3"},
};
constexpr std::string_view paper = "Gershenzon, Bambakidis and Skinner (2015)";
constexpr std::string_view paper_title =
    "How does dissipation affect the transition from static to dynamic macroscopic friction?";

void describe(Writer& file, int variable, const Description& about, const PulseMetadata& metadata) {
  if (!metadata.units || about.dimensional_unit.empty()) {
    file.attribute(variable, "long_name", about.long_name);
    file.attribute(variable, "units", "1");
    file.attribute(variable, "dimensional_unit", about.dimensional_unit);
  } else {
    const medium::UnitInSi unit = metadata.units->of(about.dimensional_unit);
    file.attribute(variable, "long_name", long_name_of(about, unit));
    file.attribute(variable, "units", unit.name);
    file.attribute(variable, "scale_factor", unit.value);
    file.attribute(variable, "unit_of_model", about.dimensional_unit);
  }
  file.attribute(variable, "references", reference_of(about));
}

std::string comment_of(const PulseMetadata& metadata) {
  if (!metadata.units)
    return "All values are dimensionless. Multiply them by dimensional_unit, where A is the contact ratio, b the "
           "asperity spacing, c the speed of strain waves, mu the shear modulus and nu the Poisson ratio.";
  return "All values are in SI units, by the constants in the attribute medium. A file stores them in the unit of the "
         "model, with a scale_factor (CF, section 8.1) that readers of NetCDF apply.";
}

}  // namespace

int reals(Writer& file, const Description& about, const std::vector<int>& dimensions, const PulseMetadata& metadata) {
  const int variable = file.reals(std::string(about.name), dimensions);
  describe(file, variable, about, metadata);
  return variable;
}

Axes axes(Writer& file, std::size_t times, std::size_t cells, const PulseMetadata& metadata) {
  Axes axes{};
  axes.time = file.dimension("time", times);
  axes.x = file.dimension("x", cells);
  const int ends = file.dimension("ends", 2);
  axes.times = reals(file, axis.time, {axes.time}, metadata);
  axes.centres = reals(file, axis.x, {axes.x}, metadata);
  axes.bounds = reals(file, axis.x_bounds, {axes.x, ends}, metadata);
  file.attribute(axes.centres, "axis", "X");
  file.attribute(axes.centres, "bounds", axis.x_bounds.name);
  return axes;
}

void write_axes(Writer& file, const Axes& axes, const std::vector<double>& times, const std::vector<double>& edges) {
  file.write(axes.times, times);
  std::vector<double> centres;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    centres.push_back(std::midpoint(edges[i], edges[i + 1]));
    file.write_row(axes.bounds, i, std::span(edges).subspan(i, 2));
  }
  file.write(axes.centres, centres);
}

void describe_file(Writer& file, const PulseMetadata& metadata, const char* format, bool finished) {
  for (const auto& [name, value] : file_attributes(metadata, format))
    file.attribute(Writer::global, name, clean_text(value, netcdf::longest_text));
  file.attribute(Writer::global, "finished", finished ? 1 : 0);
}

}  // namespace slipfront::record::cf

namespace slipfront::record {

const AxisVariables& axis_variables() { return cf::axis; }

std::string long_name_of(const Description& about, const medium::UnitInSi& unit) {
  return std::string(about.long_name) + (unit.between_faces ? ", between the faces" : "");
}

std::string reference_of(const Description& about) {
  return std::string(cf::paper) + ", " + std::string(about.reference);
}

std::vector<std::pair<std::string, std::string>> file_attributes(const PulseMetadata& metadata,
                                                                 const std::string& format) {
  std::string warnings;
  for (const std::string& warning : metadata.warnings) warnings += (warnings.empty() ? "" : "\n") + warning;
  std::vector<std::pair<std::string, std::string>> all = {
      {"Conventions", "CF-1.10"},
      {"title", metadata.title},
      {"source", "slipfront " + metadata.version},
      {"history", metadata.command_line},
      {"references", std::string(cf::paper) + ", " + std::string(cf::paper_title)},
      {"comment", cf::comment_of(metadata)},
      {"version", metadata.version},
      {"warnings", warnings},
      {"scenario", metadata.scenario_text},
      {"slipfront_format", format},
  };
  if (metadata.units) {
    all.emplace_back("unit_system", "SI");
    all.emplace_back("medium", metadata.units->in_words());
  }
  return all;
}

}  // namespace slipfront::record
