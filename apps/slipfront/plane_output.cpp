#include "plane_output.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "batch.hpp"
#include "json.hpp"
#include "run/plane_summary.hpp"
#include "terminal_table.hpp"

using namespace slipfront;

namespace {

Json json_of_row(const run::PlaneRow& row) {
  if (row.is_list) return row.values;
  if (row.is_whole) return static_cast<long>(row.values.front());
  return row.values.front();
}

/// The values, errors and units of rows as JSON objects.
struct JsonParts {
  Json values = Json::object(), errors = Json::object(), units = Json::object(), reasons = Json::object();

  void add(const std::vector<run::PlaneRow>& rows, const scenario::Scenario& s) {
    for (const run::PlaneRow& row : rows) {
      values[row.key] = json_of_row(row);
      if (!row.reason.empty()) reasons[row.key] = row.reason;
      if (s.results_in && !row.unit.empty()) units[row.key] = row.unit;
      if (std::none_of(row.errors.begin(), row.errors.end(), [](double e) { return std::isfinite(e); })) continue;
      if (row.is_list)
        for (const double error : row.errors) errors[row.key].push_back(rounded(error));
      else
        errors[row.key] = rounded(row.errors.front());
    }
  }
  void add(const std::string& key, const JsonParts& part) {
    values[key] = part.values;
    errors[key] = part.errors;
    units[key] = part.units;
  }
};

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

/// One line a value; the values of probes are numbered.
void print(const std::string& prefix, const std::vector<run::PlaneRow>& rows) {
  for (const run::PlaneRow& row : rows)
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      const std::string key = prefix + row.key + (row.is_list ? fmt::format("[{}]", i) : "");
      const std::string error = std::isfinite(row.errors[i]) ? fmt::format("+- {:.2g}", row.errors[i]) : "";
      put(fitted(fmt::format("{:<26} {:<24} {:<12} {}", key, shown(row.values[i]), error,
                             with_reason(row.meaning, row.reason)),
                 26 + 1 + 24 + 1 + 12 + 1));
    }
}

}  // namespace

void print_plane(const scenario::Scenario& s, const run::PlaneResult& result, const run::PlaneNumbers& errors,
                 const run::FaultOnPlane* model, const ScenarioArguments& a) {
  const run::PlaneSummary summary = summary_of(s, result, errors);
  const std::vector<run::PlaneRow> of_model =
      model ? run::compare_with_model(*model, s, result) : std::vector<run::PlaneRow>{};
  const std::vector<std::string>& warnings = result.metadata.warnings;
  if (!a.common.quiet)
    for (std::size_t i = s.warnings.size(); i < warnings.size(); ++i) complain("warning: " + warnings[i]);
  if (a.common.json) {
    JsonParts all, of_energy;
    of_energy.add(summary.energies, s);
    all.add(summary.rows, s);
    all.add("energies", of_energy);
    JsonParts comparison;
    comparison.add(of_model, s);
    if (model) all.values["model"] = comparison.values;
    all.add(summary.counts, s);
    Json j = all.values;
    j["errors"] = all.errors;
    if (!all.reasons.empty()) j["reasons"] = all.reasons;
    if (s.results_in) {
      j["unit_system"] = "SI";
      j["units"] = all.units;
    }
    j["warnings"] = warnings;
    put(text_of(j) + "\n");
    return;
  }
  if (!s.title.empty()) put(fitted(s.title));
  print("", summary.rows);
  print("energies.", summary.energies);
  print("model.", of_model);
  print("", summary.counts);
  const std::string& output = a.output.empty() ? a.resume : a.output;
  if (!output.empty() && !a.common.quiet) put("written to " + output + "\n");
}
