#include "events/catalogue/fault_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "events/catalogue/format.hpp"
#include "events/catalogue/fsp/fsp.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "math/digits.hpp"

namespace slipfront::catalogue {
namespace {

constexpr const subfaults::FaultFormat* fault_formats[] = {&subfaults::srf_format, &subfaults::param_format,
                                                           &subfaults::rupt_format, &subfaults::geojson_format,
                                                           &subfaults::csv_format};

const subfaults::FaultFormat* format_of_subfaults(std::string_view text) {
  const auto at = std::find_if(std::begin(fault_formats), std::end(fault_formats),
                               [text](const auto* format) { return format->looks_like(text); });
  return at == std::end(fault_formats) ? nullptr : *at;
}

}  // namespace

bool is_fault_model(std::string_view text) { return first_character(text) == '%' || format_of_subfaults(text); }

FaultModel read_fault_model(std::string_view text, const std::string& file) {
  const subfaults::FaultFormat* format = format_of_subfaults(text);
  return format ? subfaults::model_of(format->read(text, file)) : fsp::read_model(text, file);
}

void give_slip(Observation& o, double slip, std::optional<double> rise_time) {
  if (rise_time) o.rise_time = MeasuredValue{*rise_time, *rise_time};
  if (!(slip > 0)) {
    o.warnings.push_back("mean slip = " + shortest(slip) + " m is not positive: not given");
    return;
  }
  o.slip = MeasuredValue{slip, slip};
  const double velocity = rise_time ? slip / *rise_time : 0;
  if (!rise_time)
    o.warnings.push_back("no rise time: slip velocity not given");
  else if (std::isfinite(velocity) && velocity > 0)
    o.slip_velocity_m_s = MeasuredValue{velocity, velocity};
  else
    o.warnings.push_back("slip / rise time is out of range: slip velocity not given");
}

const Format fault_format{
    .ending = ".fsp",
    .looks_like = is_fault_model,
    .read = [](std::string_view text, const std::string& file, const Sink& sink, const TableOptions&) {
      sink({read_fault_model(text, file).observation, {}});
      return TableNotes{};
    }};

std::size_t sort_into_rows(std::vector<FaultPatch>& patches, double strike) {
  for (const FaultPatch& p : patches)
    if (!std::isfinite(p.east) || !std::isfinite(p.north) || !std::isfinite(p.depth)) return 0;
  if (patches.empty()) return 0;
  const auto along = [&](const FaultPatch& p) {
    return p.east * std::sin(radians(strike)) + p.north * std::cos(radians(strike));
  };
  std::vector<FaultPatch> sorted = patches;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const FaultPatch& a, const FaultPatch& b) { return a.depth < b.depth; });
  double widest = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i) widest = std::fmax(widest, sorted[i].depth - sorted[i - 1].depth);
  std::size_t rows = 0, length = 0;
  for (std::size_t from = 0, to = 0; from < sorted.size(); from = to, ++rows) {
    while (++to < sorted.size() && sorted[to].depth - sorted[to - 1].depth <= std::fmax(widest / 2, least_gap)) {
    }
    if (rows == 0) length = to;
    if (to - from != length) return 0;
    std::stable_sort(sorted.begin() + static_cast<std::ptrdiff_t>(from),
                     sorted.begin() + static_cast<std::ptrdiff_t>(to),
                     [&](const FaultPatch& a, const FaultPatch& b) { return along(a) < along(b); });
  }
  patches = std::move(sorted);
  return rows;
}

void move_to_centres(FaultSegment& segment) {
  const double half = *segment.cell_width / 2, dip = radians(*segment.dip), strike = radians(*segment.strike);
  const double east = half * std::cos(dip) * std::cos(strike), north = -half * std::cos(dip) * std::sin(strike);
  for (FaultPatch& p : segment.patches) {
    p.longitude += east / (m_per_degree * std::cos(radians(p.latitude)));
    p.latitude += north / m_per_degree;
    p.east += east, p.north += north;
    p.depth += half * std::sin(dip);
  }
}

double share_moment(FaultModel& model) {
  const bool sized = std::all_of(model.segments.begin(), model.segments.end(), [](const FaultSegment& s) {
    return (s.cell_length && s.cell_width) ||
           std::all_of(s.patches.begin(), s.patches.end(), [](const FaultPatch& p) { return p.area.has_value(); });
  });
  bool is_known = sized;
  std::vector<double> moments(model.observation.subfaults.size(), 0);
  double sum = 0;
  for (const FaultSegment& segment : model.segments)
    for (const FaultPatch& p : segment.patches) {
      double area = p.area.value_or(1), modulus = p.shear_modulus.value_or(1);
      if (!p.area && sized) area = *segment.cell_length * *segment.cell_width;
      if (!p.shear_modulus && !model.rock.empty()) {
        const RockLayer& layer = rock_at(model.rock, p.depth);
        modulus = layer.density * layer.s_wave_speed * layer.s_wave_speed;
      }
      is_known = is_known && (p.shear_modulus || !model.rock.empty());
      moments[p.row] = modulus * (sized ? area : 1) * std::fabs(p.slip);
      sum += moments[p.row];
    }
  for (std::size_t i = 0; i < moments.size(); ++i)
    if (sum > 0) model.observation.subfaults[i].moment_share = moments[i] / sum;
  return is_known ? sum : 0;
}

const RockLayer& rock_at(const std::vector<RockLayer>& rock, double depth) {
  std::size_t at = 0;
  while (at + 1 < rock.size() && rock[at + 1].top <= depth) ++at;
  return rock[at];
}

}  // namespace slipfront::catalogue
