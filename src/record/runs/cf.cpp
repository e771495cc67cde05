#include "record/runs/cf.hpp"

#include <string>
#include <string_view>

namespace slipfront::record::cf {
namespace {

using netcdf::Writer;

constexpr std::string_view paper = "Gershenzon, Bambakidis and Skinner (2015)";
constexpr std::string_view paper_title =
    "How does dissipation affect the transition from static to dynamic macroscopic friction?";

void describe(Writer& file, int variable, const Description& about, const RunMetadata& metadata) {
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

std::string comment_of(const RunMetadata& metadata) {
  if (!metadata.units)
    return "All values are dimensionless. Multiply them by dimensional_unit, where A is the contact ratio, b the "
           "asperity spacing, c the speed of strain waves, mu the shear modulus and nu the Poisson ratio.";
  return "All values are in SI units, by the constants in the attribute medium. A file stores them in the unit of the "
         "model, with a scale_factor (CF, section 8.1) that readers of NetCDF apply.";
}

}  // namespace

int reals(Writer& file, const Description& about, const std::vector<int>& dimensions, const RunMetadata& metadata) {
  const int variable = file.reals(std::string(about.name), dimensions);
  describe(file, variable, about, metadata);
  return variable;
}

void describe_file(Writer& file, const RunMetadata& metadata, const char* format, bool finished) {
  for (const auto& [name, value] : file_attributes(metadata, format))
    file.attribute(Writer::global, name, clean_text(value, netcdf::longest_text));
  file.attribute(Writer::global, "finished", finished ? 1 : 0);
}

}  // namespace slipfront::record::cf

namespace slipfront::record {

std::string long_name_of(const Description& about, const medium::UnitInSi& unit) {
  return std::string(about.long_name) + (unit.between_faces ? ", between the faces" : "");
}

std::string reference_of(const Description& about) {
  return std::string(cf::paper) + ", " + std::string(about.reference);
}

std::vector<std::pair<std::string, std::string>> file_attributes(const RunMetadata& metadata,
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
