#include "cf.hpp"

#include <string>
#include <string_view>

#include "utf8.hpp"

namespace slipfront::record::cf {
namespace {

using netcdf::Writer;

constexpr std::string_view paper = "Gershenzon, Bambakidis and Skinner (2015)";
constexpr std::string_view paper_title =
    "How does dissipation affect the transition from static to dynamic macroscopic friction?";

void describe(Writer& file, int variable, const Description& about) {
  file.attribute(variable, "long_name", about.long_name);
  file.attribute(variable, "units", "1");
  file.attribute(variable, "dimensional_unit", about.dimensional_unit);
  file.attribute(variable, "references", std::string(paper) + ", " + std::string(about.reference));
}

}  // namespace

int reals(Writer& file, const Description& about, const std::vector<int>& dimensions) {
  const int variable = file.reals(std::string(about.name), dimensions);
  describe(file, variable, about);
  return variable;
}

void describe_file(Writer& file, const PulseMetadata& metadata, const char* format, bool finished) {
  const auto text = [&](const char* name, std::string_view value) {
    file.attribute(Writer::global, name, clean_text(value, netcdf::longest_text));
  };
  text("Conventions", "CF-1.10");
  text("title", metadata.title);
  text("source", "slipfront " + metadata.version);
  text("history", metadata.command_line);
  text("references", std::string(paper) + ", " + std::string(paper_title));
  text("comment",
       "All values are dimensionless; multiply by dimensional_unit: A contact ratio, b asperity spacing, c speed of "
       "strain waves, mu shear modulus, nu Poisson ratio.");
  text("version", metadata.version);
  text("scenario", metadata.scenario_text);
  text("slipfront_format", format);
  file.attribute(Writer::global, "finished", finished ? 1 : 0);
}

}  // namespace slipfront::record::cf
