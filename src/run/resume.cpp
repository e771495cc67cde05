#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "foundation/text/digits.hpp"
#include "run/plane.hpp"
#include "run/run.hpp"
#include "run/tables.hpp"
#include "slipfront/chain/problem.hpp"

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
  /// Refuses because `what` follows from time.end, which the run has used from its start.
  [[noreturn]] void refuse_choice(const std::string& what, const std::string& of_file, const std::string& of_now,
                                  const std::string& remedy) const {
    refuse("resume",
           what + " follows from time.end: " + of_file + " with end " + shortest(begun.end) + " of the file, " +
               of_now + " with end " + shortest(now.end),
           remedy);
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

void require_same_domain(const Continued& c, double left, double right, double left_now, double right_now) {
  if (left == left_now && right == right_now) return;
  const auto range = [](double from, double to) { return "x = " + digits(from) + " ... " + digits(to); };
  c.refuse_choice("the domain", range(left, right), range(left_now, right_now),
                  "a new run with domain.left and domain.right, which can be continued");
}

void require_same_problem(const Continued& c, const PulsePlan& begun, const PulsePlan& now) {
  const pulse::Problem &a = begun.problem, &b = now.problem;
  require_same_domain(c, a.left, a.right, b.left, b.right);
  if (a.longest_step != b.longest_step)
    c.refuse_choice("the longest step under a forcing", digits(a.longest_step), digits(b.longest_step), "a new run");
}

/// Compares the chains at a later end with those that began, which were planned with the same share of the machine.
void require_same_problem(const Continued& c, const ChainPlan& begun, const ChainPlan& now, double share_of_machine) {
  require_same_domain(c, begun.chain.left, begun.chain.right, now.chain.left, now.chain.right);
  if (begun.chain.spacing != now.chain.spacing)
    c.refuse_choice("the spacing of sites, as contacts age,", digits(begun.chain.spacing), digits(now.chain.spacing),
                    "a new run with chain.spacing, which can be continued");
  const chain::Problem a = chain::problem_of(begun.chain, share_of_machine);
  const chain::Problem b = chain::problem_of(now.chain, share_of_machine);
  if (a.implicit) return;
  const double step = chain::chosen_step(a), step_now = chain::chosen_step(b);
  if (step != step_now)
    c.refuse_choice("the time step", digits(step), digits(step_now), "a new run, or chain.steps = \"implicit\" in one");
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

/// `same_problem` refuses a plan of the later end that differs from that of the file in more than the end.
template <class Plan, class PlanOf, class SameProblem>
record::Checkpoint read(const std::string& path, const std::string& format, const scenario::Scenario& scenario,
                        const Plan& plan, const PlanOf& plan_of, const SameProblem& same_problem) {
  record::Checkpoint saved = record::read_checkpoint(path, format);
  if (saved.version != SLIPFRONT_VERSION)
    throw InputError({.file = path,
                      .key = "resume",
                      .problem = "was written by another version",
                      .allowed = "version " SLIPFRONT_VERSION});
  if (saved.scenario_text == scenario.text) return saved;
  const scenario::Scenario begun = scenario::read_scenario(saved.scenario_text, scenario.file, {}, read_table);
  const Continued continued{path, begun, scenario};
  require_later_end(continued);
  const Plan first = plan_of(begun);
  same_problem(continued, first);
  const std::vector<double>& times = first.schedule.times;
  const bool still_output = require_common_times(continued, times, plan.schedule.times);
  keep_common_snapshots(still_output, times.back(), saved.snapshots);
  keep_common_snapshots(still_output, times.back(), saved.fields);
  return saved;
}

}  // namespace

record::Output output_of(const std::string& output, const std::string& resume, bool of_finished) {
  return {output.empty() ? resume : output, of_finished ? "" : resume};
}

record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const PulsePlan& plan) {
  return read(
      path, record::pulse_format, scenario, plan, plan_pulse,
      [&](const Continued& continued, const PulsePlan& begun) { require_same_problem(continued, begun, plan); });
}

record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const ChainPlan& plan,
                                 double share_of_machine) {
  return read(
      path, record::pulse_format, scenario, plan,
      [&](const scenario::Scenario& begun) { return plan_chain(begun, share_of_machine); },
      [&](const Continued& continued, const ChainPlan& begun) {
        require_same_problem(continued, begun, plan, share_of_machine);
      });
}

record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const PlanePlan& plan) {
  return read(
      path, record::plane_format, scenario, plan,
      [&](const scenario::Scenario& begun) { return plan_plane(begun, plan.lines); },
      [&](const Continued& continued, const PlanePlan& begun) {
        if (begun.schedule.interval != plan.schedule.interval)
          continued.refuse_choice("the time between two rows of the series", digits(begun.schedule.interval),
                                  digits(plan.schedule.interval), "a new run");
      });
}

}  // namespace slipfront::run
