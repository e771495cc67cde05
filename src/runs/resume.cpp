#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "math/digits.hpp"
#include "runs/run.hpp"
#include "runs/tables.hpp"
#include "slipfront/lattice/chain/problem.hpp"

namespace slipfront::run {
namespace {

/// A file that a run continues, the scenario that began it, and the one that continues it.
struct Continued {
  const std::string& path;
  const scenario::Scenario& begun;
  const scenario::Scenario& now;

  [[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& allowed) const {
    throw InputError({.file = path, .key = key, .problem = problem, .allowed = allowed});
  }
};

/// The part of the scenario that may differ with a later end, and differs.
std::string free_part(const Continued& c) {
  if (c.begun.output.every != c.now.output.every) return "output.every differs";
  if (c.begun.output.times != c.now.output.times) return "output.times differs";
  return c.begun.title != c.now.title ? "title differs" : "comments or layout differ";
}

void require_later_end(const Continued& c) {
  const std::string key = scenario::differing_key(c.begun.text, c.now.text);
  if (!key.empty())
    c.refuse("resume", "was written by another scenario: " + key + " differs",
             "the scenario that started the run, with the same --set; time.end may be later");
  if (c.now.end == c.begun.end)
    c.refuse("resume", "was written by another scenario: " + free_part(c),
             "the scenario that started the run, or a later time.end, with which this may differ");
  if (c.now.end < c.begun.end)
    c.refuse("resume",
             "time.end = " + shortest(c.now.end) + " is earlier than the end of the file, " + shortest(c.begun.end),
             "time.end >= " + shortest(c.begun.end));
}

/// Something that follows from time.end, and that a run uses from its start.
struct Choice {
  std::string what;
  std::vector<double> values;
  std::string in_words, remedy;
};

Choice domain(double left, double right) {
  return {"the domain",
          {left, right},
          "x = " + digits(left) + " ... " + digits(right),
          "a new run with domain.left and domain.right, which can be continued"};
}

Choice number(const char* what, double value, const char* remedy) { return {what, {value}, digits(value), remedy}; }

std::vector<Choice> choices_of(const Plan& plan) {
  const char* const a_new_run = "a new run";
  if (plan.is_on_plane()) return {number("the time between two rows of the series", plan.on_plane.interval, a_new_run)};
  if (plan.solver == scenario::SolverKind::pulse)
    return {domain(plan.pulse.left, plan.pulse.right),
            number("the longest step under a forcing", plan.pulse.longest_step, a_new_run)};
  std::vector<Choice> choices = {domain(plan.chain.left, plan.chain.right),
                                 number("the spacing of sites, as contacts age,", plan.chain.spacing,
                                        "a new run with chain.spacing, which can be continued")};
  const chain::Problem chain = chain::problem_of(plan.chain, plan.share_of_machine);
  if (!chain.implicit)
    choices.push_back(
        number("the time step", chain::chosen_step(chain), "a new run, or chain.steps = \"implicit\" in one"));
  return choices;
}

void require_same_choices(const Continued& c, const std::vector<Choice>& begun, const std::vector<Choice>& now) {
  for (std::size_t i = 0; i < std::min(begun.size(), now.size()); ++i)
    if (begun[i].values != now[i].values)
      c.refuse("resume",
               begun[i].what + " follows from time.end: " + begun[i].in_words + " with end " + shortest(c.begun.end) +
                   " of the file, " + now[i].in_words + " with end " + shortest(c.now.end),
               begun[i].remedy);
}

/// Refuses other output times before the end of the file. Returns whether the end of the file is still an output time.
bool require_common_times(const Continued& c, const std::vector<double>& begun, const std::vector<double>& now) {
  const std::size_t before_end = begun.size() - 1;
  const double end = begun.back(), nearly = end * (1 - 1e-12);  // as for output.every
  const auto [was, is] = std::mismatch(begun.begin(), begun.end() - 1, now.begin(), now.end());
  const double first = was == begun.end() - 1 ? *is : std::min(*was, *is);  // now ends later, so `is` exists
  if (first < nearly)
    c.refuse(
        "resume",
        "the output times before the end of the file, " + shortest(end) + ", differ: first at t = " + shortest(first),
        "the output times of the file; later ones are free");
  return before_end < now.size() && now[before_end] == end;
}

/// Leaves out the snapshot at the end of the file unless it is an output time now.
template <class Snapshots>
void keep_common_snapshots(bool still_output, double end, Snapshots& snapshots) {
  if (!snapshots.empty() && snapshots.back().time == end && !still_output) snapshots.pop_back();
}

}  // namespace

record::Output output_of(const std::string& output, const std::string& resume, bool of_finished) {
  return {output.empty() ? resume : output, of_finished ? "" : resume};
}

record::Checkpoint checkpoint_of(const std::string& path, const Plan& plan) {
  const scenario::Scenario& scenario = plan.scenario;
  record::Checkpoint saved = record::read_checkpoint(path, plan.format());
  if (saved.version != SLIPFRONT_VERSION)
    throw InputError({.file = path,
                      .key = "resume",
                      .problem = "was written by another version",
                      .allowed = "version " SLIPFRONT_VERSION});
  if (saved.scenario_text == scenario.text) return saved;
  const scenario::Scenario begun = scenario::read_scenario(saved.scenario_text, scenario.file, {}, read_table);
  const Continued continued{path, begun, scenario};
  require_later_end(continued);
  const Plan first = plan_of(plan.solver, begun, plan.share_of_machine);
  require_same_choices(continued, choices_of(first), choices_of(plan));
  const bool still_output = require_common_times(continued, first.times(), plan.times());
  keep_common_snapshots(still_output, first.times().back(), saved.snapshots);
  keep_common_snapshots(still_output, first.times().back(), saved.fields);
  return saved;
}

}  // namespace slipfront::run
