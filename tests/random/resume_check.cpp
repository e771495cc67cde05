// Runs each scenario of a pulse that the command line names three times: in one piece, in three pieces that are saved
// and resumed, and to an earlier end from which it continues to the end. If the final states differ in any bit, it
// prints a line for that scenario and returns exit code 1.

#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runs/record/netcdf/table_file.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "system/files/whole_file.hpp"

using namespace slipfront;

namespace {

/// The state at the end, or the error that stopped the run. Both must be the same for whole and resumed runs.
std::string end_of(pulse::Run& run, const std::function<bool()>& interrupted, bool& finished) {
  try {
    finished = run.go(interrupted);
    return run.saved();
  } catch (const NumericsError& error) {
    finished = true;
    return error.what();
  }
}

/// Whether a run that has finished at an earlier end, at no output time, continues to the same end.
bool continues(const pulse::Problem& problem, const output::Schedule& schedule, const std::string& end) {
  output::Schedule first = schedule;
  const double earlier = 0.61 * schedule.times.back();
  std::erase_if(first.times, [&](double time) { return time >= earlier; });
  first.times.push_back(earlier);
  bool finished = false;
  pulse::Run begun(problem, first);
  end_of(begun, {}, finished);
  if (!begun.finished()) return true;  // the numerics failed, so there is nothing to continue
  std::vector<output::Snapshot> snapshots = begun.snapshots();
  snapshots.pop_back();
  pulse::Run continued(problem, schedule, begun.saved(), std::move(snapshots));
  return end_of(continued, {}, finished) == end;
}

bool resumes(const char* path) {
  const scenario::Scenario s = scenario::read_scenario(record::read_text(path), path, {}, record::read_table);
  if (s.loading.acts()) return true;  // only chains support loading
  const pulse::Problem problem = scenario::pulse_problem(s);
  const output::Schedule schedule = scenario::pulse_schedule(s, problem);
  bool finished = false;
  pulse::Run whole(problem, schedule);
  const std::string end = end_of(whole, {}, finished);
  const long piece = whole.steps() / 3 + 1;
  auto run = std::make_unique<pulse::Run>(problem, schedule);
  while (true) {
    const long until = run->steps() + piece;
    const std::string state = end_of(
        *run, [&] { return run->steps() >= until; }, finished);
    if (finished) return state == end && continues(problem, schedule, end);
    run = std::make_unique<pulse::Run>(problem, schedule, state, run->snapshots());
  }
}

}  // namespace

int main(int argc, char** argv) {
  int code = 0;
  for (int i = 1; i < argc; ++i) {
    try {
      if (resumes(argv[i])) continue;
      std::printf("%s: the resumed or continued run ends in another state\n", argv[i]);
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", argv[i], error.what());
    }
    code = 1;
  }
  return code;
}
