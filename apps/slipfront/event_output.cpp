#include "event_output.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "events/results/columns.hpp"
#include "json.hpp"

namespace {

using slipfront::finite_fault::FaultPulse;
using slipfront::finite_fault::pulse_quantities;
using slipfront::inference::answer_quantities;
using slipfront::inference::bound_quantities;
using slipfront::inference::Posterior;
using slipfront::inference::posterior_quantities;
using slipfront::results::answer_of;
using slipfront::results::event_numbers;
using slipfront::results::EventResult;

Json posterior_json(const EventResult& result) {
  if (!result.posterior) return nullptr;
  const Posterior& p = *result.posterior;
  Json j;
  for (const auto& quantity : posterior_quantities()) {
    const auto& q = p.*quantity.quantiles;
    const std::string name(quantity.about.name);
    j[name] = q ? Json(q->median) : Json();
    j[name + "_interval"] = q ? Json{q->low, q->high} : Json();
  }
  j["slip_velocity_is"] = name_of(result.observation.measure());
  j["friction_identified"] = p.friction_identified;
  j["prior_share"] = {{"contact_ratio", json_of(p.contact_ratio_prior_share)},
                      {"damping_number", json_of(p.damping_number_prior_share)}};
  j["trade_off"] = Json::array();
  for (const auto& t : p.trade_off)
    j["trade_off"].push_back(
        {{"damping_number", t.damping_number}, {"contact_ratio", t.contact_ratio}, {"stress_pa", t.stress_pa}});
  j["notes"] = p.notes;
  for (const auto& prediction : p.predictions) j["predictive_check"][prediction.observation] = prediction.below;
  if (p.predictions.empty()) j["predictive_check"] = Json::object();
  j["contradicted"] = p.contradicted;
  j["suffices"] = p.suffices;
  j["effective_samples"] = p.effective_samples;
  j["pareto_k"] = p.pareto_k;
  j["samples"] = p.samples;
  j["seed"] = p.seed;
  return j;
}

/// The observations that disagree with the others, and the result without each of them.
Json tension_json(const EventResult& result) {
  Json all = Json::array();
  if (!result.posterior) return all;
  for (const auto& t : result.posterior->tension) {
    Json j = {{"observation", t.observation}, {"sigmas", json_of(t.sigmas)}};
    for (const auto& quantity : posterior_quantities()) {
      const auto& q = t.without.*quantity.quantiles;
      const std::string name(quantity.about.name);
      j["without"][name] = q ? Json(q->median) : Json();
      j["without"][name + "_interval"] = q ? Json{q->low, q->high} : Json();
    }
    all.push_back(j);
  }
  return all;
}

Json along_fault_json(const EventResult& result) {
  Json all = Json::array();
  for (const auto& s : result.along_fault)
    all.push_back({{"segment", s.subfault.segment + 1},
                   {"along_strike_m", s.along_strike},
                   {"down_dip_m", s.down_dip},
                   {"depth_m", s.subfault.z},
                   {"slip_m", s.subfault.slip},
                   {"rupture_velocity_m_s", json_of(s.rupture_velocity_m_s)},
                   {"slip_velocity_m_s", json_of(s.slip_velocity_m_s)},
                   {"stress", json_of(s.stress)},
                   {"contact_ratio", json_of(s.contact_ratio)},
                   {"stress_pa", json_of(s.stress_pa)}});
  return all;
}

Json pulse_json(const FaultPulse& p) {
  if (!p.reason.empty()) return {{"reason", p.reason}};
  const auto times = [](const std::vector<std::optional<double>>& all) {
    Json j = Json::array();
    for (const auto& time : all) j.push_back(json_of(time));
    return j;
  };
  Json j = {{"reason", nullptr},
            {"x_m", p.x},
            {"stress", p.stress},
            {"model_rupture_time_s", times(p.model_time)},
            {"pulse_front_time_s", times(p.front_time)},
            {"model_slip_m", p.model_slip},
            {"pulse_slip_m", p.pulse_slip},
            {"end_s", p.end},
            {"columns_reached", p.reached}};
  for (const auto& q : pulse_quantities())  // without the prefix "pulse_", because the object is named "pulse"
    if (!q.is_count) j[std::string(q.about.name.substr(6))] = json_of(q.get(p));
  return j;
}

}  // namespace

std::string columns_json(const slipfront::run::CatalogueColumns& columns) {
  Json tables = Json::array();
  for (const auto& [file, table] : columns.files)
    tables.push_back({{"file", file},
                      {"ignored_columns", table.ignored},
                      {"ignored_quantities", table.ignored_quantities},
                      {"notes", table.notes}});
  return "\"ignored_columns\": " + text_of(columns.ignored) +
         ", \"ignored_quantities\": " + text_of(columns.ignored_quantities) + ", \"tables\": " + text_of(tables);
}

std::string event_json(const EventResult& result) {
  const auto& o = result.observation;
  Json j;
  j["name"] = o.name;
  j["date"] = o.date;
  j["kind"] = o.kind;
  j["citation"] = o.citation;
  j["note"] = o.note;
  j["file"] = o.file;
  j["line"] = o.line;
  for (const auto& number : event_numbers()) j[std::string(number.about.name)] = json_of(number.get(result));
  for (const auto quantities : {answer_quantities(), bound_quantities()})
    for (const auto& q : quantities) {
      const auto x = answer_of(result, q);
      const std::string name(q.about.name);
      j[name] = x ? Json(x->value) : Json();
      j[name + "_interval"] = x && x->interval ? Json{x->interval->low, x->interval->high} : Json();
    }
  j["rupture_velocity_is"] = name_of(o.rupture_velocity_is);
  j["front_threshold"] = o.front_threshold;
  j["stress_drop_is"] = name_of(o.stress_drop_is);
  j["tension"] = tension_json(result);
  j["posterior"] = posterior_json(result);
  if (result.faster_than_c.timed > 0)
    j["faster_than_c"] = {{"subfaults", result.faster_than_c.subfaults},
                          {"subfaults_with_velocity", result.faster_than_c.timed},
                          {"moment_share", result.faster_than_c.moment_share}};
  if (!result.along_fault.empty()) j["along_fault"] = along_fault_json(result);
  if (result.pulse) j["pulse"] = pulse_json(*result.pulse);
  j["moment_n_m"] = o.moment ? Json(o.moment->middle()) : Json();
  j["bounds"] = Json::array();
  for (const auto& b : o.bounds)
    j["bounds"].push_back({{"quantity", b.quantity}, {b.is_upper ? "below" : "above", b.limit}});
  j["warnings"] = result.warnings();
  j["error"] = result.error.empty() ? Json() : Json(result.error);
  return text_of(j);
}
