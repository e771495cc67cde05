#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "slipfront/catalogue/read.hpp"
#include "slipfront/finite_fault/sources.hpp"
#include "slipfront/parallel.hpp"
#include "slipfront/record/text_file.hpp"
#include "slipfront/results/columns.hpp"
#include "slipfront/results/memory.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::catalogue;
using namespace slipfront::inference;
using namespace slipfront::finite_fault;
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

/// Columns of all events of all sources: texts as lists, numbers as arrays.
py::dict evaluate_all(const std::vector<Source>& sources, const medium::StatedDefaults& medium,
                      const EvaluationOptions& plan, int threads) {
  std::vector<EventResult> results;
  std::vector<std::string> ignored;
  {
    const py::gil_scoped_release others_may_run;
    const medium::Defaults defaults = medium::defaults_of(medium);
    std::vector<Entry> entries;
    for (const auto& [content, name, is_path] : sources)
      for (std::string& title : read_events(is_path ? record::read_text(name) : content, name,
                                            [&](Entry&& entry) { entries.push_back(std::move(entry)); }))
        if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
    warn_of_other_sources(entries, defaults);
    require_memory(plan, entries.size(), threads);
    results.resize(entries.size());
    for_each_parallel(
        entries.size(), threads, [&](std::size_t i) { results[i] = evaluate(std::move(entries[i]), defaults, plan); },
        1);
  }
  py::dict columns;
  py::list of_numbers, of_texts;
  for (const NumberColumn& c : number_columns({.pulse = plan.pulse, .draws = plan.sampling.draws}))
    of_numbers.append(py::make_tuple(c.name, dimensions(c.axis), numbers(results, c), c.long_name, c.unit,
                                     c.dimensional_unit, c.reference));
  for (const TextColumn& c : text_columns(plan.pulse))
    of_texts.append(py::make_tuple(c.name, texts(results, c), c.long_name));
  columns["numbers"] = of_numbers;
  columns["texts"] = of_texts;
  columns["ignored"] = ignored;
  return columns;
}

}  // namespace

void bind_event(py::module_& m) {
  m.def("event",
        [](const std::vector<Source>& sources, const std::string& p_wave_speed, const std::string& poisson_ratio,
           const std::string& shear_modulus, std::optional<std::size_t> samples, std::uint64_t seed,
           const std::string& closure, bool pulse, std::size_t draws, int threads) {
          const EvaluationOptions plan{{.samples = samples.value_or(Sampling{}.samples),
                                        .seed = seed,
                                        .closure = modulation::closure_named(closure),
                                        .draws = draws},
                                       samples.has_value(),
                                       false,
                                       pulse};
          return evaluate_all(sources, {p_wave_speed, poisson_ratio, shear_modulus}, plan, threads);
        });
}
