#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "events/results/columns.hpp"
#include "runs/catalogue.hpp"
#include "runs/record/events/event_file.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "system/files/whole_file.hpp"
#include "watch.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::inference;
using namespace slipfront::results;

py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

py::array_t<double> numbers(const std::vector<EventResult>& results, const NumberColumn& column) {
  const auto width = static_cast<py::ssize_t>(column.count);
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(results.size())};
  if (column.axis != Axis::none) shape.push_back(width);
  py::array_t<double> values(shape);
  double* out = values.mutable_data();
  for (const EventResult& r : results) {
    column.get(r, out);
    out += width;
  }
  return values;
}

py::list texts(const std::vector<EventResult>& results, const TextColumn& column) {
  py::list values;
  for (const EventResult& r : results) values.append(text(column.get(r)));
  return values;
}

/// Dimensions of a column besides `event`, as the files have them.
py::tuple dimensions(Axis axis) {
  switch (axis) {
    case Axis::none:
      return py::make_tuple("event");
    case Axis::bound:
      return py::make_tuple("event", "bound");
    case Axis::quantile:
      return py::make_tuple("event", "quantile");
    case Axis::draw:
      return py::make_tuple("event", "draw");
  }
  throw std::logic_error("an axis that is none");
}

/// Text, name (a path if there is no text to it), whether it is a path.
using Source = std::tuple<std::string, std::string, bool>;

/// The events of sources, and how they are to be evaluated.
run::CatalogueScenario scenario_of(const std::vector<Source>& sources, const py::dict& options) {
  const auto text = [&](const char* key) { return options[key].cast<std::string>(); };
  run::CatalogueScenario scenario;
  scenario.command_line = "slipfront event";
  for (const auto& [content, name, is_path] : sources) {
    for (run::EventText& event : is_path ? run::texts_of(name) : std::vector<run::EventText>{{name, content}})
      scenario.texts.push_back(std::move(event));
    scenario.command_line += " " + name;
  }
  if (const std::string map = text("columns_file"); !map.empty())
    scenario.table = {record::read_text(map), map};
  else if (const std::string content = text("columns"); !content.empty())
    scenario.table = {content, "columns"};
  catalogue::check_column_map(scenario.table);
  scenario.strict = options["strict"].cast<bool>();
  scenario.medium = {text("p_wave_speed"), text("poisson_ratio"), text("shear_modulus")};
  EvaluationOptions& evaluation = scenario.evaluation;
  evaluation.sample_all = !options["samples"].is_none();
  if (evaluation.sample_all) evaluation.sampling.samples = options["samples"].cast<std::size_t>();
  evaluation.sampling.seed = options["seed"].cast<std::uint64_t>();
  evaluation.sampling.closure = friction::closure_named(text("closure"));
  evaluation.sampling.draws = options["draws"].cast<std::size_t>();
  evaluation.pulse = options["pulse"].cast<bool>();
  return scenario;
}

/// Columns of all events: texts as lists, numbers as arrays.
py::dict columns_of(const std::vector<EventResult>& results, const EvaluationOptions& evaluation,
                    const run::CatalogueColumns& not_read) {
  py::dict columns;
  py::list of_numbers, of_texts;
  for (const NumberColumn& c : number_columns({.pulse = evaluation.pulse, .draws = evaluation.sampling.draws}))
    of_numbers.append(py::make_tuple(c.name, dimensions(c.axis), numbers(results, c), c.long_name, c.unit,
                                     c.dimensional_unit, c.reference));
  for (const TextColumn& c : text_columns(evaluation.pulse))
    of_texts.append(py::make_tuple(c.name, texts(results, c), c.long_name));
  columns["numbers"] = of_numbers;
  columns["texts"] = of_texts;
  columns["ignored"] = not_read.ignored;
  columns["ignored_quantities"] = not_read.ignored_quantities;
  return columns;
}

bool is_csv(const std::string& path) { return path.ends_with(".csv"); }

/// \throws InputError for an output that is neither NetCDF nor CSV, and for a CSV file that cannot hold what it should.
void check_output(const std::string& output, const std::string& resume, std::size_t draws) {
  const auto refuse = [&](const char* problem, const char* allowed) {
    throw InputError({.file = "event", .key = "output", .value = output, .problem = problem, .allowed = allowed});
  };
  if (output.empty()) return;
  if (!output.ends_with(".nc") && !is_csv(output)) refuse("unsupported file type", "a name that ends in .nc or .csv");
  if (is_csv(output) && draws > 0) refuse("a CSV file has no draws", "a name that ends in .nc");
  if (is_csv(output) && !resume.empty()) refuse("a CSV file cannot be resumed", "a name that ends in .nc");
}

py::dict evaluate_all(const std::vector<Source>& sources, const py::dict& options) {
  const run::CatalogueScenario scenario = scenario_of(sources, options);
  const auto output = options["output"].cast<std::string>(), resume = options["resume"].cast<std::string>();
  const int threads = options["threads"].cast<int>();
  check_output(output, resume, scenario.evaluation.sampling.draws);
  run::CatalogueColumns not_read;
  run::CatalogueResult result;
  std::optional<Watch> watch;
  {
    const py::object progress = options["progress"];
    const py::gil_scoped_release others_may_run;
    const std::string& path = output.empty() ? resume : output;
    run::CataloguePlan plan = run::plan_catalogue(scenario, threads, !path.empty());
    const auto total = static_cast<double>(plan.entries.size());
    {
      const py::gil_scoped_acquire lock;
      watch.emplace(progress, total);
    }
    not_read = plan.columns;
    if (is_csv(path)) record::require_disk_space(path, plan.disk);  // for NetCDF, run::catalogue checks
    result = run::catalogue(std::move(plan), {.output = record::Output(is_csv(path) ? "" : path, resume),
                                              .resume = resume,
                                              .threads = threads,
                                              .after_step = [&](std::size_t done) {
                                                return (*watch)(static_cast<double>(done), static_cast<long>(done));
                                              }});
    if (is_csv(path) && result.finished) record::write_events_csv(path, result.events, scenario.evaluation.pulse);
  }
  watch->finish();
  return columns_of(result.events, scenario.evaluation, not_read);
}

}  // namespace

void bind_event(py::module_& m) {
  m.def("event", evaluate_all);
  /// (name, dimensional_unit, label) of each quantity of a fault's state.
  m.def("event_quantities", [] {
    py::list all;
    for (const Quantity& q : quantities())
      all.append(py::make_tuple(text(std::string(q.about.name)),
                                text(std::string(q.about.si_unit.empty() ? q.about.dimensional_unit : q.about.si_unit)),
                                text(std::string(q.label))));
    return all;
  });
}
