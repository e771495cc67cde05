#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "math/constants.hpp"
#include "math/digits.hpp"
#include "runs/run.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"
#include "system/machine.hpp"

namespace slipfront::run {
namespace {

/// Appends the warnings of a finished run to those of its scenario.
void add_warnings(const std::vector<std::string>& of_run, record::RunMetadata& metadata) {
  for (const std::string& warning : of_run) metadata.warnings.push_back(scenario::in_results(warning, metadata.units));
}

/// Writes the whole run to its output. Until the run has ended, the file is marked as unfinished.
class Checkpoints {
 public:
  Checkpoints(const Result& result, const Options& options) : result_(result), options_(options) {}

  /// Whether it is time for a checkpoint. Each writes the whole file, so we limit writing to a small part of the work.
  bool due() const {
    return options_.output.wanted() &&
           any(is_first() && seconds_since(written_) > 0.05 && seconds_since(written_) > 20 * cost_);
  }
  /// Whether `mine` is true on any rank.
  bool any(bool mine) const { return options_.ranks ? options_.ranks->any(mine) : mine; }

  /// `bytes` is the approximate size of the file.
  void require_disk_space(double bytes) const {
    if (options_.output.wanted()) on_first([&] { record::require_disk_space(options_.output.finished(), bytes); });
  }

  /// Throws the error of the run, with the file of what was computed. All ranks throw it together.
  void fail(std::string why) const {
    std::error_code none;
    if (options_.output.wanted() && std::filesystem::exists(options_.output.unfinished(), none))
      why += "; what was computed is in " + options_.output.unfinished();
    const auto fails = [&] { throw NumericsError(why); };
    options_.ranks ? options_.ranks->together(fails) : fails();
  }

  void write() {
    if (!options_.output.wanted()) return;
    const auto begun = Clock::now();
    const output::Run& run = *result_.run;
    const std::string state = run.saved();  // all ranks send their parts to the first rank
    record::RunMetadata metadata = result_.metadata;
    if (run.finished()) add_warnings(run.warnings(), metadata);  // warnings() needs all ranks
    on_first([&] {
      const record::Output& output = options_.output;
      record::write_run(run.finished() ? output.finished() : output.unfinished(), metadata, result_.arrays(), state,
                        run.finished());
      if (run.finished()) output.clear();
    });
    cost_ = seconds_since(begun);
    written_ = Clock::now();
  }

 private:
  bool is_first() const { return !options_.ranks || options_.ranks->rank() == 0; }
  /// Does `work` on the first rank. If it throws, all ranks throw.
  template <class Work>
  void on_first(const Work& work) const {
    const auto mine = [&] { is_first() ? work() : void(); };
    options_.ranks ? options_.ranks->together(mine) : mine();
  }

  const Result& result_;
  const Options& options_;
  Clock::time_point written_ = Clock::now();
  double cost_ = 0;  ///< seconds that the last checkpoint took
};

/// Warnings of a finished run that follow from its plan.
std::vector<std::string> notes_on_results(const Plan& plan) {
  if (plan.solver != scenario::SolverKind::plane_direct || plan.scenario.chain.scale) return {};
  const double scale = scenario::scale_of_lines(plan.scenario);
  if (!(scale > 1)) return {};
  return {"chain.scale is not given. At scale " + digits(scale) +
          " the largest initial slip has 20 dislocation lines; a larger one brings results closer to those of many "
          "lines"};
}

/// Continues to the end, or until it is stopped. Returns whether the run has reached its end.
bool go(const Result& result, const Options& options, double bytes) {
  output::Run& run = *result.run;
  Checkpoints checkpoints(result, options);
  checkpoints.require_disk_space(bytes);
  if (!options.checkpoint && !options.output.replaces()) checkpoints.write();
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool stop = options.after_step && options.after_step(run.time(), run.steps());
      if (checkpoints.due()) checkpoints.write();
      return checkpoints.any(stop);
    });
  } catch (const NumericsError& error) {  // the run or its last checkpoint has a valid state
    if (run.can_checkpoint()) checkpoints.write();
    checkpoints.fail(scenario::in_results(error.what(), result.metadata.units));
  }
  checkpoints.write();
  return reached;
}

}  // namespace

Duration expected_duration(const Result& begun, const Plan& plan, const Options& options, double most) {
  output::Run& run = *begun.run;
  const Clock::time_point start = Clock::now();
  const double end = plan.times().back(), first_time = run.time();
  std::optional<Pace> of_time, of_steps;  // after the results at the start and the first steps, which both take longer
  bool reached = false;
  try {
    reached = run.go([&] {
      const bool enough = of_time && seconds_since(start) > most;
      if (!of_time) of_time.emplace(run.time()), of_steps.emplace(static_cast<double>(run.steps()));
      return options.ranks ? options.ranks->any(enough) : enough;
    });
  } catch (const NumericsError& error) {
    throw NumericsError(scenario::in_results(error.what(), begun.metadata.units));
  }
  const double steps = static_cast<double>(run.steps()), taken = seconds_since(start);
  double left = reached ? 0 : of_time->seconds_left(run.time(), end);
  // The first steps of fine cells and of implicit chains are much shorter than most.
  constexpr double few = 0.01;
  if (!reached && run.time() - first_time < few * (end - first_time)) {
    if (run.expected_steps() > steps) left = of_steps->seconds_left(steps, run.expected_steps());
    if (plan.chain.implicit) left = none;
  }
  return {.seconds = seconds_since(options.begun) + left + begun.cost_of_errors * (taken + left),
          .of_a_step = reached ? taken / steps : of_steps->seconds_each(steps)};
}

Result carry_out(const Plan& plan, const Options& options) {
  Result result = begin(plan, options);
  const long first = result.run->steps();
  const auto begun = Clock::now();
  const bool reached = go(result, options, plan.need.disk);
  const double stepping = seconds_since(begun);
  if (!reached) return result;
  add_warnings(result.run->warnings(), result.metadata);  // asks all ranks
  add_warnings(notes_on_results(plan), result.metadata);
  result.summary = result.numbers({.stepping = stepping,
                                   .wall = seconds_since(options.begun),
                                   .steps = result.run->steps() - first,
                                   .ranks = options.ranks ? options.ranks->size() : 1,
                                   .threads = options.threads});
  return result;
}

}  // namespace slipfront::run
