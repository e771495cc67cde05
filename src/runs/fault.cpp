#include "runs/fault.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include "events/catalogue/fault_model.hpp"
#include "math/digits.hpp"
#include "runs/tables.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "slipfront/lattice/plane/source_parameters.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::run {

FaultResult fault_source(const CatalogueScenario& scenario, const finite_fault::SourceOptions& options) {
  const char* const allowed = "one finite-fault model, such as .fsp, SRF or .param";
  if (scenario.texts.size() != 1)
    throw InputError({.file = "command line",
                      .key = "FILE",
                      .value = std::to_string(scenario.texts.size()) + " files",
                      .problem = "a source is made of one model",
                      .allowed = allowed});
  const EventText& text = scenario.texts.front();
  if (!text.error.empty()) throw FileError(text.error);
  for (const std::string_view ending : {".csv", ".toml"})
    if (text.name.ends_with(ending) && !catalogue::is_fault_model(text.text))
      throw InputError({.file = text.name, .problem = "no finite-fault model", .allowed = allowed});
  catalogue::FaultModel model = catalogue::read_fault_model(text.text, text.name);
  const medium::Defaults defaults = medium::defaults_of(scenario.medium);
  FaultResult out{finite_fault::finite_source(model, defaults, options), {}};
  catalogue::Entry entry{std::move(model.observation), {}};
  out.event = results::evaluate(std::move(entry), defaults, scenario.evaluation);
  if (!out.event.estimate) return out;
  std::vector<std::string>& warnings = out.event.estimate->warnings;
  for (const std::string& note : out.source.notes)
    if (std::find(warnings.begin(), warnings.end(), note) == warnings.end()) warnings.push_back(note);
  return out;
}

namespace {

using finite_fault::OnPlane;
using std::numbers::pi;

constexpr double stronger = 1.2;           ///< strength over what holds the initial state
constexpr double largest_slip_lines = 10;  ///< dislocation lines that the largest slip has

std::string in_unit(double value, const char* unit) { return '"' + shortest(value) + ' ' + unit + '"'; }

std::string in_pascals(double stress) { return shortest(stress) + " Pa"; }

double asperity_spacing(const FaultOnPlane& model) {
  return model.fault.largest_slip / (medium::face_factor * largest_slip_lines);
}

/// [medium]: what the model gives, the contact ratio, and the spacing that makes the number of lines.
std::string medium_table(const FaultOnPlane& model, double contact_ratio) {
  const medium::Elastic rock = medium::elastic(model.event.observation, {});
  const double nu = rock.poisson_ratio, density = rock.shear_modulus * 2 / (1 - nu) / (rock.speed * rock.speed);
  return "[medium]\nshear_modulus = " + in_unit(rock.shear_modulus, "Pa") + "\npoisson_ratio = " + shortest(nu) +
         "\ndensity = " + in_unit(density, "kg/m3") + "\ncontact_ratio = " + shortest(contact_ratio) +
         "\nasperity_spacing = " + in_unit(asperity_spacing(model), "m") + "\n";
}

double rounded(double number) { return medium::number(digits(number, 3)).value(); }

double force_unit(const medium::Elastic& rock, double contact_ratio) {
  return medium::traction_unit(rock.shear_modulus, rock.poisson_ratio, contact_ratio);
}

/// Spacing of the sites, for lines that are up to 1.5 times as dense as the differences of the slip imply.
double spacing_for(const OnPlane& fault, double contact_ratio) {
  const double stress = fault.largest_gradient * 2 * pi / (medium::face_factor * contact_ratio);
  return std::fmin(0.4, 2 * pi / (5.5 * stress));
}

/// The scenario, with this strength in Pa.
std::string text_of(const FaultOnPlane& model, const std::string& file, double contact_ratio, double strength) {
  const OnPlane& f = model.fault;
  const double margin = margin_of(f), half_x = f.cell_length / 2, half_y = f.cell_width / 2;
  const double width = f.x.back() - f.x.front() + 2 * (half_x + margin);
  const double radius = std::fmax(2 * std::fmax(f.cell_length, f.cell_width),
                                  0.1 * std::fmin(f.x.back() - f.x.front(), f.y.back() - f.y.front()));
  const medium::Elastic rock = medium::elastic(model.event.observation, {});
  const medium::Units unit = medium::units(rock.shear_modulus, rock.speed, contact_ratio, asperity_spacing(model));
  const int cells = static_cast<int>(std::clamp(std::round(3 * width / f.cell_length), 40.0, 400.0));
  return "title = \"rupture from the slip of " + std::filesystem::path(file).filename().string() +
         "\"\n[plane]\nleft = " + in_unit(f.x.front() - half_x - margin, "m") +
         "\nright = " + in_unit(f.x.back() + half_x + margin, "m") +
         "\nbottom = " + in_unit(f.y.front() - half_y - margin, "m") +
         "\ntop = " + in_unit(f.y.back() + half_y + margin, "m") + "\ncells = " + std::to_string(cells) +
         "\nedges = \"absorbing\"\n[initial]\nprofile = \"grid\"\nunits = \"SI\"\nfile = '" +
         std::filesystem::path(file).filename().string() +
         "'\n[friction]\nlaw = \"slip-weakening\"\nstrength = " + '"' + in_pascals(strength) + '"' + "\nresidual = 0" +
         "\ncharacteristic_slip = " + in_unit(medium::face_factor * unit.slip, "m") +
         "\n[nucleation]\nradius = " + in_unit(radius, "m") + "\n[time]\nend = " + in_unit(2 * f.end, "s") +
         "\n[chain]\nscale = 1\nspacing = " + in_unit(rounded(spacing_for(f, contact_ratio)) * unit.length, "m") +
         "\n" + medium_table(model, contact_ratio);
}

/// Times at which two sources rupture the same subfaults, in s since the first of them.
struct Times {
  std::vector<double> model, plane;
};

Times rupture_times(const FaultOnPlane& model, const plane::MapGrid& grid, const plane::Problem& p,
                    const plane::Maps& maps, const medium::Units& units) {
  constexpr double least = 0.05;  // fraction of the largest slip
  const OnPlane& f = model.fault;
  Times times;
  for (std::size_t j = 0; j < f.y.size(); ++j)
    for (std::size_t i = 0; i < f.x.size(); ++i) {
      if (f.slip[f.at(i, j)] < least * f.largest_slip) continue;
      const int column = static_cast<int>((f.x[i] / units.length - p.left) / grid.dx);
      const int row = static_cast<int>((f.y[j] / units.length - p.bottom) / grid.dy);
      times.model.push_back(f.rupture_time[f.at(i, j)]);
      times.plane.push_back(maps.rupture_time[grid.at(column, row)] * units.time);
    }
  return times;
}

double correlation(const Times& t) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < t.model.size(); ++i) {
    const double a = t.model[i], b = t.plane[i];
    if (std::isnan(b)) continue;
    ++n, x += a, y += b, xx += a * a, xy += a * b, yy += b * b;
  }
  return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
}

/// The factor that turns rupture times of the model into those on the plane, by least squares.
double ratio_of(const Times& t) {
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < t.model.size(); ++i)
    if (!std::isnan(t.plane[i])) {
      xx += t.model[i] * t.model[i];
      xy += t.model[i] * t.plane[i];
    }
  return xy / xx;
}

/// The moment rate of the model as the series of a run.
std::vector<plane::SeriesRow> series_of(const FaultOnPlane& model) {
  constexpr std::size_t count = 500;
  const double interval = 1.2 * model.fault.end / count;
  std::vector<plane::SeriesRow> series(1);
  double moment = 0;
  for (const double rate : finite_fault::moment_rate(model.source, interval, count)) {
    moment += rate * interval;
    plane::SeriesRow row;
    row.time = (static_cast<double>(series.size()) - 0.5) * interval;
    row.potency_rate = rate;
    row.potency = moment;
    series.push_back(row);
  }
  return series;
}

}  // namespace

FaultOnPlane fault_on_plane(const std::string& text, const std::string& file) {
  FaultResult result = fault_source({.texts = {{.name = file, .text = text}}}, {});
  OnPlane fault = finite_fault::on_plane(result.source);
  return {.source = std::move(result.source), .fault = std::move(fault), .event = std::move(result.event)};
}

double margin_of(const OnPlane& fault) {
  return 0.3 * std::fmin(fault.x.back() - fault.x.front(), fault.y.back() - fault.y.front()) +
         2 * std::fmax(fault.cell_length, fault.cell_width);
}

scenario::Scenario scenario_of_fault(const FaultOnPlane& model, const std::string& file,
                                     const std::vector<std::string>& overrides) {
  std::optional<double> contact_ratio;
  if (model.event.estimate && model.event.estimate->stress)
    contact_ratio = model.fault.mean_gradient * 2 * pi / (medium::face_factor * model.event.estimate->stress->value);
  constexpr std::string_view key = "medium.contact_ratio=";
  for (const std::string& setting : overrides)
    if (setting.starts_with(key)) contact_ratio = medium::number(setting.substr(key.size()));
  if (!contact_ratio)
    throw InputError({.file = file,
                      .key = "medium.contact_ratio",
                      .problem = "the model has no rupture velocity below c, from which the contact ratio follows",
                      .allowed = "--set medium.contact_ratio=..."});
  const auto rows = [&](const std::string& path, const std::vector<std::string>& columns) {
    return path == file ? finite_fault::slip_to_come(model.fault, margin_of(model.fault)) : read_table(path, columns);
  };
  // The strength depends on the other numbers of the scenario, which `overrides` may change.
  const double unit = force_unit(medium::elastic(model.event.observation, {}), *contact_ratio);
  scenario::Scenario s = scenario::read_scenario(text_of(model, file, *contact_ratio, unit), file, overrides, rows);
  const std::string unknown = in_pascals(unit);
  const std::size_t at = s.text.find(unknown);
  if (at == std::string::npos) return s;                             // `overrides` give it
  scenario::plane_solver(s, scenario::SolverKind::plane_direct, 1);  // refuses what needs too much memory
  const plane::Schedule grid = scenario::plane_schedule(s, scenario::SolverKind::plane_direct);
  const double unbalanced = plane::largest_unbalanced_force(
      s.plane->problem, {.scale = scenario::scale_of_lines(s), .spacing = *s.chain.spacing}, grid.nx, grid.ny);
  const double strength = rounded(stronger * unbalanced) * unit;
  s.text.replace(at, unknown.size(), in_pascals(strength));
  const double in_model = strength / force_unit(medium::elastic(s.medium, {}), *s.medium.contact_ratio);
  s.friction = s.plane->problem.friction = s.friction.with("strength", in_model);
  return s;
}

std::vector<Row> compare_with_model(const FaultOnPlane& model, const scenario::Scenario& s, const plane::Run& run) {
  const medium::Elastic rock = medium::elastic(s.medium, {});
  const medium::Units units =
      medium::units(rock.shear_modulus, rock.speed, *s.medium.contact_ratio, *s.medium.asperity_spacing);
  const plane::Problem& p = run.solver().problem();
  const plane::MapGrid grid = plane::grid_of(p, run.schedule());
  const Times times = rupture_times(model, grid, p, run.maps(), units);
  const auto reached = static_cast<double>(
      std::count_if(times.plane.begin(), times.plane.end(), [](double t) { return !std::isnan(t); }));
  const std::vector<plane::SeriesRow> series = series_of(model);
  const auto row = [](std::string_view name, double value, std::string_view meaning) {
    Row of_model({.name = name, .long_name = meaning, .dimensional_unit = {}, .reference = {}}, value);
    of_model.group = "model";
    return of_model;
  };
  return {row("model_moment", model.fault.moment, "seismic moment of the segment of the hypocentre, in N m"),
          row("model_duration", plane::duration(series), "time in which its moment grows from 5 to 95 %, in s"),
          row("model_subfaults", static_cast<double>(times.model.size()), "with at least 5 % of the largest slip"),
          row("model_reached", reached, "number of these that the rupture on the plane reaches"),
          row("model_correlation_of_rupture_times", correlation(times), "Pearson's coefficient over these"),
          row("model_rupture_time_ratio", ratio_of(times), "rupture times on the plane over those of the model")};
}

}  // namespace slipfront::run
