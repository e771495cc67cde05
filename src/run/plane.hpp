#pragma once
/// \file
/// Turns a scenario on a plane into a result: plans it, runs or resumes it, and summarizes it.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/planes/plane_file.hpp"
#include "run/run.hpp"
#include "slipfront/plane/run.hpp"
#include "slipfront/scenario/problem.hpp"

namespace slipfront::run {

/// A run on a plane that has been checked.
struct PlanePlan {
  scenario::Lines lines = scenario::Lines::averaged;
  plane::Schedule schedule;
  record::PlaneGrid grid;
  double disk = 0;  ///< approximate number of bytes of the file
};

/// \throws InputError.
PlanePlan plan_plane(const scenario::Scenario& scenario, scenario::Lines lines);

/// As for a pulse. \throws InputError also if time.end decides when the series has rows.
record::Checkpoint checkpoint_of(const std::string& path, const scenario::Scenario& scenario, const PlanePlan& plan);

struct PlaneResult {
  std::unique_ptr<plane::Run> run;
  record::PulseMetadata metadata;  ///< includes the warnings of a finished run
  std::vector<Row> summary = {};   ///< numbers of a finished run, in the units of the model
  bool finished() const { return run->finished(); }
};

/// \throws NumericsError, after writing the results so far; InputError, FileError.
PlaneResult plane(const scenario::Scenario& scenario, const PlanePlan& plan, const Options& options);

/// Sets the errors of the summary of a finished run by runs with half and a quarter of the cells, or of the scale of a
/// direct run, which take a quarter of its time. An error is 1.5 times the larger of two changes: that of the last
/// doubling, and half of that at the doubling before. There is none if a run with fewer cells fails, or if
/// `interrupted` returned true, and for a direct run with fewer than 20 lines, whose convergence is not regular. The
/// peak slip velocity has no error.
void add_errors(PlaneResult& fine, const scenario::Scenario& scenario, const std::function<bool()>& interrupted,
                scenario::Lines lines, int threads);

}  // namespace slipfront::run
