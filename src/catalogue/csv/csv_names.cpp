#include "catalogue/csv/csv_names.hpp"

#include <algorithm>
#include <utility>

namespace slipfront::catalogue {
namespace {

using Role = Column::Role;
using Name = std::pair<std::string_view, std::string_view>;

constexpr Name names[] = {
    {"rupturespeed", "rupture_velocity"},
    {"rupturepropagationvelocity", "rupture_velocity"},
    {"rupturepropagationspeed", "rupture_velocity"},
    {"propagationvelocity", "rupture_velocity"},
    {"propagationspeed", "rupture_velocity"},
    {"propagationrate", "rupture_velocity"},
    {"migrationvelocity", "rupture_velocity"},
    {"migrationspeed", "rupture_velocity"},
    {"migrationrate", "rupture_velocity"},
    {"frontvelocity", "rupture_velocity"},
    {"frontspeed", "rupture_velocity"},
    {"vr", "rupture_velocity"},
    {"rv", "rupture_velocity"},
    {"vrup", "rupture_velocity"},
    {"avvr", "rupture_velocity"},
    {"sliprate", "slip_velocity"},
    {"slipspeed", "slip_velocity"},
    {"slidingvelocity", "slip_velocity"},
    {"slippingvelocity", "slip_velocity"},
    {"avtr", "rise_time"},
    {"delta\xCF\x83", "stress_drop"},
    {"\xCE\x94\xCF\x83", "stress_drop"},
    {"effectivenormalstress", "normal_stress"},
    {"rigidity", "shear_modulus"},
    {"poissonsratio", "poisson_ratio"},
    {"poisson'sratio", "poisson_ratio"},
    {"swavevelocity", "s_wave_speed"},
    {"shearwavevelocity", "s_wave_speed"},
    {"shearwavespeed", "s_wave_speed"},
    {"vsathypocentre", "s_wave_speed"},
    {"vsathypocenter", "s_wave_speed"},
    {"pwavevelocity", "p_wave_speed"},
    {"vpathypocentre", "p_wave_speed"},
    {"vpathypocenter", "p_wave_speed"},
    {"m0", "moment"},
    {"mo", "moment"},
    {"scalarmoment", "moment"},
    {"seismicmoment", "moment"},
    {"mw", "moment_magnitude"},
    {"magnitudemw", "moment_magnitude"},
    {"length", "rupture_length"},
    {"faultlength", "rupture_length"},
    {"alongstrikelength", "rupture_length"},
    {"lengthalongstrike", "rupture_length"},
    {"width", "rupture_width"},
    {"faultwidth", "rupture_width"},
    {"downdipwidth", "rupture_width"},
    {"area", "rupture_area"},
    {"faultarea", "rupture_area"},
    {"sliparea", "rupture_area"},
};

constexpr std::pair<std::string_view, Role> roles[] = {
    {"name", Role::name},         {"event", Role::name},         {"eventname", Role::name}, {"earthquake", Role::name},
    {"evid", Role::identifier},   {"eventid", Role::identifier}, {"id", Role::identifier},  {"no", Role::identifier},
    {"#", Role::identifier},      {"date", Role::date},          {"datetime", Role::date},  {"origintime", Role::date},
    {"startdate", Role::date},    {"starttime", Role::date},     {"year", Role::year},      {"yyyy", Role::year},
    {"yr", Role::year},           {"month", Role::month},        {"day", Role::day},        {"kind", Role::kind},
    {"citation", Role::citation}, {"source", Role::citation},    {"note", Role::note},      {"notes", Role::note},
};

constexpr std::string_view unused[] = {"lat",         "latitude",
                                       "lon",         "long",
                                       "lng",         "longitude",
                                       "depth",       "dep",
                                       "strike",      "dip",
                                       "rake",        "ml",
                                       "mb",          "ms",
                                       "md",          "m",
                                       "mag",         "magnitude",
                                       "magtype",     "type",
                                       "number",      "index",
                                       "doi",         "url",
                                       "reference",   "ref",
                                       "region",      "location",
                                       "place",       "zone",
                                       "fault",       "segment",
                                       "mechanism",   "time",
                                       "hour",        "minute",
                                       "second",      "hh",
                                       "mm",          "ss",
                                       "enddate",     "endtime",
                                       "comment",     "comments",
                                       "agency",      "catalog",
                                       "tag",         "eventtag",
                                       "x",           "y",
                                       "z",           "evlo",
                                       "evla",        "evdp",
                                       "authors",     "author",
                                       "study",       "longitudedeg",
                                       "latitudedeg", "lastname",
                                       "mww",         "momentmagnitudetype"};

constexpr std::string_view neutral[] = {"mean",     "average", "avg",      "ave",     "av",       "estimated", "est",
                                        "observed", "obs",     "measured", "seismic", "geodetic", "coseismic", "source",
                                        "event",    "rupture", "fault",    "total",   "local",    "est."};

constexpr std::string_view physical_words[] = {
    "velocity",   "speed",        "slip",       "stress",   "rate",     "drop",     "duration", "moment",
    "energy",     "modulus",      "frequency",  "length",   "width",    "area",     "radius",   "strain",
    "friction",   "displacement", "efficiency", "rigidity", "period",   "pressure", "density",  "sliprate",
    "stressdrop", "risetime",     "fc",         "offset",   "viscosity"};

template <class Words>
bool contains(const Words& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

}  // namespace

const Key* quantity_of_name(std::string_view name) {
  for (const auto& [published, key] : names)
    if (name == published) return find_key(key);
  for (const Key& key : quantity_keys()) {
    if (key.name == "friction_coefficient") continue;  // in publications this is not C, so only the exact title counts
    std::string joined(key.name);
    joined.erase(std::remove(joined.begin(), joined.end(), '_'), joined.end());
    if (name == joined) return &key;
  }
  return nullptr;
}

std::optional<Role> role_of_name(std::string_view name) {
  for (const auto& [word, role] : roles)
    if (name == word) return role;
  return contains(unused, name) ? std::optional(Role::unused) : std::nullopt;
}

bool is_neutral(std::string_view word) { return contains(neutral, word); }

bool is_physical_word(std::string_view word) { return contains(physical_words, word); }

double deviations_of(std::string_view word) {
  constexpr std::string_view one[] = {"err",      "error",    "errors",    "sd",          "std",     "stdev",
                                      "stddev",   "sigma",    "unc",       "uncertainty", "+-",      "+/-",
                                      "\xC2\xB1", "\xCF\x83", "1\xCF\x83", "1sigma",      "1-sigma", "stderr"};
  constexpr std::string_view two[] = {"2\xCF\x83", "2sigma", "2-sigma", "2sd"};
  return contains(one, word) ? 1 : contains(two, word) ? 2 : 0;
}

}  // namespace slipfront::catalogue
