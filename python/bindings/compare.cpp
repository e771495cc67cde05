#include "runs/compare.hpp"

#include <pybind11/stl.h>

#include <optional>
#include <vector>

#include "math/constants.hpp"
#include "results.hpp"
#include "runs/record/run_file.hpp"
#include "runs/run.hpp"
#include "scenario/estimate.hpp"
#include "slipfront/scenario/problem.hpp"
#include "system/files/whole_file.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;
using namespace pybind11::literals;
using run::ComparedModel;

/// The value of the unit of a number in the units of the results.
double in_results(const scenario::Scenario& s, const Description& about) {
  return s.results_in ? s.results_in->of(about.dimensional_unit).value : 1;
}

py::list trends(const std::vector<ComparedModel>& levels, const scenario::Scenario& s) {
  py::list rows;
  for (const output::Scalar& q : run::compared_numbers()) {
    const run::Trend t = run::trend_of(levels, q);
    const double unit = in_results(s, q.about);
    rows.append(py::make_tuple(std::string(q.about.name), t.exponent, t.extrapolated * unit, t.difference * unit));
  }
  return rows;
}

py::list level_rows(const std::vector<ComparedModel>& levels) {
  py::list rows;
  for (const ComparedModel& level : levels)
    rows.append(py::dict("name"_a = level.name, "closure"_a = level.closure, "scale"_a = level.scale,
                         "wall_seconds"_a = level.wall_seconds));
  return rows;
}

/// The variables that describe levels: (description, one value for each level).
py::list numbers_of_levels(const std::vector<ComparedModel>& levels) {
  py::list columns;
  for (const Description& about : {output::slip_window, output::velocity_window}) {
    std::vector<double> values;
    for (const ComparedModel& level : levels) values.push_back(level.number(about).value_or(none));
    columns.append(
        py::make_tuple(described(about), py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data())));
  }
  return columns;
}

py::dict run_compare(const py::dict& arguments, const std::vector<double>& scales, int threads) {
  const RunRequest a = request_of(arguments);
  const scenario::Scenario s = scenario_of(a);
  Watch watch(a.progress, s.end);
  std::vector<ComparedModel> levels;
  run::Comparison comparison;
  record::RunMetadata metadata;
  bool reached = false;
  {
    const py::gil_scoped_release others_may_run;
    comparison = run::comparison_of(s, scales);
    metadata = run::metadata_of(s, record::comparison_format, "compare", scales);
    const record::Output output(a.output, "");
    record::require_disk_space(a.output, comparison.need.disk);
    reached = run::compare(
        comparison, metadata, output, threads, levels, [] {},
        [&](const std::string& level, double time, long steps) { return watch(time, steps, level); });
  }
  watch.finish();
  py::dict result = dataset_of(metadata, reached, run::arrays_of(comparison, metadata, levels));
  result["levels"] = level_rows(levels);
  result["level_numbers"] = numbers_of_levels(levels);
  result["scale_about"] = described(output::scale_factor);
  result["trends"] = trends(levels, s);
  result["notes"] = run::notes_on(s, levels);
  const double C = s.friction.linear_coefficient().value_or(none);
  result["summary"] = py::dict("time"_a = s.end * in_results(s, output::end_time), "friction_coefficient"_a = C,
                               "damping_number"_a = C * s.end);
  return result;
}

py::dict check_compare(const py::dict& arguments, const std::vector<double>& scales) {
  const scenario::Scenario s = scenario_of(request_of(arguments));
  const run::Comparison c = run::comparison_of(s, scales);
  run::begin_levels(c);
  std::vector<double> chains;
  for (const run::Plan& plan : c.plans)
    if (plan.solver == scenario::SolverKind::chain) chains.push_back(plan.chain.scale);
  return py::dict("title"_a = s.title, "levels"_a = c.levels(), "closed_form"_a = c.exact.has_value(),
                  "scales"_a = chains, "left"_a = c.schedule.x_edges.front(), "right"_a = c.schedule.x_edges.back(),
                  "end"_a = s.end, "memory_bytes"_a = c.need.memory_with_file(), "disk_bytes"_a = c.need.disk);
}

}  // namespace

void bind_compare(py::module_& m) {
  m.def("compare", run_compare);
  m.def("check_compare", check_compare);
}
