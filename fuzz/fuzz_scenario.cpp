// libFuzzer target: no text and no overrides may crash the scenario reader, and the stress of an accepted scenario is
// valid. The text after the first byte 0xFF, which TOML never contains, is a list of overrides, one per line.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>

#include "slipfront/scenario/scenario.hpp"

namespace {

void require(bool truth) {
  if (!truth) std::abort();
}

std::vector<std::vector<double>> small_table(const std::string&, const std::vector<std::string>& columns) {
  if (columns.size() == 3) return {{-2, -2, 1}, {3, -2, 0.5}, {-2, 3, 0.25}, {3, 3, 0}};
  return {{-2, 1}, {0, 0.5}, {0.25, 0}, {3, 0}};
}

double checked_stress(const slipfront::scenario::Scenario& scenario, double x) {
  const double stress = scenario.stress(x);
  require(stress >= 0 && std::isfinite(stress));
  return stress;
}

double checked_slip(const slipfront::scenario::Scenario& scenario) {
  const double slip = scenario.plane->problem.slip(0, 0);
  require(slip >= 0 && std::isfinite(slip));
  return slip;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> overrides;
  if (const std::size_t end = text.find('\xFF'); end != std::string::npos) {
    for (std::size_t at = end + 1; at < text.size();
         at = text.find('\n', at) == std::string::npos ? text.size() : text.find('\n', at) + 1)
      overrides.push_back(text.substr(at, text.find('\n', at) - at));
    text.resize(end);
  }
  try {
    const auto scenario = slipfront::scenario::read_scenario(text, "fuzz.toml", overrides, small_table);
    std::optional<slipfront::scenario::Scenario> again;
    try {
      again = slipfront::scenario::read_scenario(scenario.text, "fuzz.toml", {}, small_table);
    } catch (const slipfront::InputError&) {
    }
    require(again.has_value());  // the text that a run stores must give the same scenario again
    require(again->end == scenario.end && again->pulse.cells == scenario.pulse.cells &&
            again->friction.parameter("coefficient") == scenario.friction.parameter("coefficient") &&
            again->forcing == scenario.forcing);
    if (scenario.forcing_at) require(std::isfinite(scenario.forcing_at(0.1, 0.2)));
    if (scenario.contact_at) require(scenario.contact_at(0.1) > 0);
    if (scenario.plane)
      require(checked_slip(scenario) == again->plane->problem.slip(0, 0));
    else
      require(checked_stress(scenario, 0.1) == again->stress(0.1));
  } catch (const slipfront::InputError& error) {
    // The message has a line for each error.
    const std::string message = error.what();
    require(std::count(message.begin(), message.end(), '\n') + 1 == std::ssize(error.complaints()));
  }
  return 0;
}
