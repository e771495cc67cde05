#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "slipfront/event/evaluate.hpp"
#include "slipfront/event/read.hpp"
#include "slipfront/parallel.hpp"
#include "slipfront/record/text_file.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::event;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

template <class Get>
py::array_t<double> numbers(const std::vector<EventResult>& results, Get&& get) {
  py::array_t<double> column(static_cast<py::ssize_t>(results.size()));
  double* out = column.mutable_data();
  for (const EventResult& r : results) *out++ = r.estimate ? get(*r.estimate) : none;
  return column;
}

py::array_t<double> intervals(const std::vector<EventResult>& results, std::optional<Inferred> Estimate::*value) {
  py::array_t<double> column({static_cast<py::ssize_t>(results.size()), py::ssize_t{2}});
  double* out = column.mutable_data();
  for (const EventResult& r : results) {
    const bool known = r.estimate && (*r.estimate).*value && ((*r.estimate).*value)->interval;
    *out++ = known ? ((*r.estimate).*value)->interval->low : none;
    *out++ = known ? ((*r.estimate).*value)->interval->high : none;
  }
  return column;
}

template <class Get>
py::array_t<double> of_posterior(const std::vector<EventResult>& results, Get&& get) {
  py::array_t<double> column(static_cast<py::ssize_t>(results.size()));
  double* out = column.mutable_data();
  for (const EventResult& r : results) *out++ = r.posterior ? get(*r.posterior) : none;
  return column;
}

/// 5 %, median, 95 %.
py::array_t<double> quantiles(const std::vector<EventResult>& results, std::optional<Quantiles> Posterior::*value) {
  py::array_t<double> column({static_cast<py::ssize_t>(results.size()), py::ssize_t{3}});
  double* out = column.mutable_data();
  for (const EventResult& r : results) {
    const Quantiles q = (r.posterior ? (*r.posterior).*value : std::nullopt).value_or(Quantiles{none, none, none});
    for (const double x : {q.low, q.median, q.high}) *out++ = x;
  }
  return column;
}

template <class Get>
py::list texts(const std::vector<EventResult>& results, Get&& get) {
  py::list column;
  for (const EventResult& r : results) column.append(text(get(r)));
  return column;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : "; ") + part;
  return out;
}

/// Text, name (a path if there is no text to it), whether it is a path.
using Source = std::tuple<std::string, std::string, bool>;

/// Columns of all events of all sources: texts as lists, numbers as arrays.
py::dict evaluate_all(const std::vector<Source>& sources, const StatedMedium& medium, const Plan& plan, int threads) {
  std::vector<EventResult> results;
  std::vector<std::string> ignored;
  {
    const py::gil_scoped_release others_may_run;
    const MediumDefaults defaults = defaults_of(medium);
    std::vector<Entry> entries;
    for (const auto& [content, name, is_path] : sources)
      for (std::string& title : read_events(is_path ? record::read_text(name) : content, name,
                                            [&](Entry&& entry) { entries.push_back(std::move(entry)); }))
        if (std::find(ignored.begin(), ignored.end(), title) == ignored.end()) ignored.push_back(std::move(title));
    results.resize(entries.size());
    for_each_parallel(entries.size(), threads,
                      [&](std::size_t i) { results[i] = evaluate(std::move(entries[i]), defaults, plan); });
  }
  py::dict about;
  py::list measured, inferred;
  for (const auto& q : measured_quantities())
    measured.append(py::make_tuple(described(q.about),
                                   numbers(results, [&](const Estimate& e) { return (e.*q.value).value_or(none); })));
  for (const auto& q : inferred_quantities())
    inferred.append(
        py::make_tuple(described(q.about),
                       numbers(results, [&](const Estimate& e) { return e.*q.value ? (e.*q.value)->value : none; }),
                       intervals(results, q.value)));
  about["name"] = texts(results, [](const EventResult& r) { return r.observation.name; });
  about["date"] = texts(results, [](const EventResult& r) { return r.observation.date; });
  about["kind"] = texts(results, [](const EventResult& r) { return r.observation.kind; });
  about["citation"] = texts(results, [](const EventResult& r) { return r.observation.citation; });
  about["note"] = texts(results, [](const EventResult& r) { return r.observation.note; });
  about["warnings"] = texts(results, [](const EventResult& r) { return joined(r.warnings()); });
  about["error"] = texts(results, [](const EventResult& r) { return r.error; });
  py::dict columns;
  columns["about"] = about;
  columns["c_m_s"] = numbers(results, [](const Estimate& e) { return e.speed; });
  columns["measured"] = measured;
  columns["inferred"] = inferred;
  py::list posterior;
  for (const auto& q : posterior_quantities())
    posterior.append(py::make_tuple(described(q.about), quantiles(results, q.value)));
  columns["posterior"] = posterior;
  columns["effective_samples"] = of_posterior(results, [](const Posterior& p) { return p.effective_samples; });
  columns["friction_identified"] =
      of_posterior(results, [](const Posterior& p) { return p.friction_identified ? 1.0 : 0.0; });
  columns["ignored"] = ignored;
  return columns;
}

}  // namespace

void bind_event(py::module_& m) {
  m.def("event", [](const std::vector<Source>& sources, const std::string& p_wave_speed,
                    const std::string& poisson_ratio, const std::string& shear_modulus,
                    std::optional<std::size_t> samples, std::uint64_t seed, bool paper, int threads) {
    const Plan plan{{.samples = samples.value_or(Sampling{}.samples),
                     .seed = seed,
                     .closure = paper ? modulation::Closure::paper : modulation::Closure::consistent},
                    samples.has_value(),
                    false};
    return evaluate_all(sources, {p_wave_speed, poisson_ratio, shear_modulus}, plan, threads);
  });
}
