#include "scenario/settings.hpp"

#include <algorithm>

#include "foundation/text/digits.hpp"
#include "scenario/text/section.hpp"

namespace slipfront::scenario {
namespace {

constexpr double most_outputs = 1e6;

std::vector<double> read_times(const Section& section, double end) {
  std::vector<double> times;
  const Value* const array = section.array("times", "an array of times, such as [1, 2.5]");
  if (!array) return times;
  const Limits limits{.least = 0, .most = end};  // [time] end
  for (const Value& item : array->items) {
    const double time = section.item_in("times", item, ModelUnit::time, limits);
    if (!times.empty() && !(time > times.back()))
      throw section.refuse("times", item, "not after the time before it", "times strictly increasing");
    times.push_back(time);
  }
  return times;
}

std::vector<std::string> read_variables(const Section& section) {
  const std::vector<std::string_view>& known = section.words("variables");
  std::vector<std::string> variables;
  const Value* const array = section.array("variables", "an array of names, such as [\"Sigma\", \"slip\"]");
  if (!array) return variables;
  for (const Value& item : array->items) {
    const auto found = std::find(known.begin(), known.end(), item.text);
    if (item.kind != Value::Kind::text || found == known.end())
      throw section.refuse("variables", item, "unknown variable", nearest_or_all(item.text, known));
    if (std::find(variables.begin(), variables.end(), item.text) != variables.end())
      throw section.refuse("variables", item, "given twice", "each name once");
    variables.push_back(item.text);
  }
  if (variables.empty()) throw section.refuse("variables", "an empty list", "leave it out to write all");
  return variables;
}

}  // namespace

void read_domain(const Document& document, Domain& domain) {
  const Section section(document, "domain");
  domain.left = section.number("left");
  domain.right = section.number("right");
  if (domain.left && domain.right && !(*domain.left < *domain.right))
    throw section.refuse(
        "right", "not to the right of domain.left",
        "> " + section.bound_as_written("right", *section.find("right"), ModelUnit::position, *domain.left));
}

double read_end(const Document& document, double otherwise) {
  return Section(document, "time").number("end").value_or(otherwise);
}

void read_pulse(const Document& document, PulseOptions& pulse) {
  const Section section(document, "pulse");
  pulse.cells = section.whole_number("cells").value_or(pulse.cells);
  pulse.tolerance = section.number("tolerance").value_or(pulse.tolerance);
  pulse.threshold = section.number("threshold").value_or(pulse.threshold);
  const auto end = [&](const char* key, pulse::End otherwise) {
    return section
        .choice<pulse::End>(
            key, {{"continued", pulse::End::continued}, {"fixed", pulse::End::fixed}, {"free", pulse::End::free}})
        .value_or(otherwise);
  };
  pulse.left = end("left", pulse.left);
  pulse.right = end("right", pulse.right);
  pulse.periodic = section.truth("periodic").value_or(pulse.periodic);
  pulse.many_trains = section.choice<bool>("trains", {{"one", false}, {"many", true}}).value_or(pulse.many_trains);
}

void read_chain(const Document& document, ChainOptions& chain) {
  const Section section(document, "chain");
  chain.scale = section.number("scale");
  chain.spacing = section.number("spacing");
  chain.model = section
                    .choice<chain::Model>(
                        "model", {{"sine-gordon", chain::Model::sine_gordon}, {"lattice", chain::Model::lattice}})
                    .value_or(chain.model);
  const auto end = [&](const char* key, chain::End otherwise) {
    return section
        .choice<chain::End>(
            key, {{"free", chain::End::free}, {"fixed", chain::End::fixed}, {"absorbing", chain::End::absorbing}})
        .value_or(otherwise);
  };
  chain.left = end("left", chain.left);
  chain.right = end("right", chain.right);
  chain.periodic = section.truth("periodic").value_or(chain.periodic);
  chain.window = section.number("window");
  chain.implicit = section.choice<bool>("steps", {{"explicit", false}, {"implicit", true}}).value_or(chain.implicit);
  if (section.has("tolerance") && section.has("steps") && !chain.implicit)
    throw section.refuse("tolerance", "is of implicit steps", "with chain.steps = \"implicit\" or [loading]");
  chain.tolerance = section.number("tolerance").value_or(chain.tolerance);
}

Output read_output(const Document& document, double end) {
  const Section section(document, "output");
  Output output;
  output.times = read_times(section, end);
  output.every = section.number("every");
  if (output.every && section.has("times"))
    throw section.refuse("every", "output.times is given too", "one of the two");
  if (output.every && end / *output.every > most_outputs)
    throw section.refuse(
        "every", "more than a million outputs",
        ">= " + section.bound_as_written("every", *section.find("every"), ModelUnit::time, end / most_outputs));
  output.per_event = section.whole_number("per_event").value_or(0);
  if (output.per_event > 0 && document.tables.count("loading") == 0)
    throw section.refuse("per_event", "without [loading] there are no slip events", "with [loading]");
  output.variables = read_variables(section);
  output.fronts = section.whole_number("fronts").value_or(0);
  return output;
}

}  // namespace slipfront::scenario
