#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "events/catalogue/fault_model.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "math/digits.hpp"

namespace slipfront::catalogue::subfaults {
namespace {

struct Limit {
  const char* name;
  double Row::*member;
  double least, most;
  bool required;
};
constexpr Limit limits[] = {{"longitude", &Row::longitude, -360, 360, true},
                            {"latitude", &Row::latitude, -90, 90, true},
                            {"depth", &Row::depth, -1e4, 1e6, true},
                            {"slip", &Row::slip, -1e4, 1e4, true},
                            {"strike", &Row::strike, -360, 720, false},
                            {"dip", &Row::dip, 0, 90, false},
                            {"rake", &Row::rake, -720, 720, false},
                            {"area", &Row::area, 1e-12, 1e14, false},
                            {"rupture time", &Row::rupture_time, -1e6, 1e6, false},
                            {"rise time", &Row::rise_time, -1e6, 1e6, false},
                            {"shear modulus", &Row::shear_modulus, 1e3, 1e13, false}};

/// Slip and rake from the components, area from the sides, and one rise time from its two parts.
void complete(Row& row) {
  if (std::isnan(row.slip)) {
    row.slip = std::hypot(row.strike_slip, row.dip_slip);
    row.rake = row.slip > 0 ? std::atan2(row.dip_slip, row.strike_slip) / radians(1) : 0;
  }
  if (std::isnan(row.area)) row.area = row.length * row.width;
  if (!std::isnan(row.fall_time)) row.rise_time += row.fall_time;
  if (!(row.density > 0) || !(row.s_wave_speed > 0)) row.density = row.s_wave_speed = none;
  if (!(row.shear_modulus > 0)) row.shear_modulus = row.density * row.s_wave_speed * row.s_wave_speed;
  const double by_moment = row.moment / (row.area * std::fabs(row.slip));
  if (std::isnan(row.shear_modulus) && std::isfinite(by_moment) && by_moment > 0) row.shear_modulus = by_moment;
}

/// Moves a position from the middle of the upper edge to the centre.
void move_to_centre(Row& row) {
  const double half = row.width / 2, across = half * std::cos(radians(row.dip));
  row.longitude += across * std::cos(radians(row.strike)) / (m_per_degree * std::cos(radians(row.latitude)));
  row.latitude -= across * std::sin(radians(row.strike)) / m_per_degree;
  row.depth += half * std::sin(radians(row.dip));
}

void check(const Row& row, const std::string& file) {
  for (const Limit& limit : limits) {
    const double value = row.*limit.member;
    if ((std::isnan(value) && !limit.required) || (value >= limit.least && value <= limit.most)) continue;
    throw InputError({.file = file,
                      .line = row.line,
                      .key = limit.name,
                      .value = std::isnan(value) ? "" : digits(value),
                      .problem = std::isnan(value) ? "this subfault has none" : "out of range",
                      .allowed = digits(limit.least) + " to " + digits(limit.most)});
  }
}

/// Joins the subfaults at one position: the time windows of an inversion. Their slips add as vectors.
std::size_t join_windows(std::vector<Row>& rows) {
  std::map<std::tuple<double, double, double>, std::size_t> first;
  std::vector<Row> joined;
  for (const Row& row : rows) {
    const auto [at, is_new] = first.try_emplace({row.longitude, row.latitude, row.depth}, joined.size());
    if (is_new) {
      joined.push_back(row);
      continue;
    }
    Row& to = joined[at->second];
    if (!(row.slip > 0)) continue;
    const double along = to.slip * std::cos(radians(to.rake)) + row.slip * std::cos(radians(row.rake));
    const double up = to.slip * std::sin(radians(to.rake)) + row.slip * std::sin(radians(row.rake));
    const double end = std::fmax(row.rupture_time + row.rise_time, to.slip > 0 ? to.rupture_time + to.rise_time : 0);
    to.rupture_time = to.slip > 0 ? std::fmin(to.rupture_time, row.rupture_time) : row.rupture_time;
    to.rise_time = end - to.rupture_time;
    to.slip = std::hypot(along, up);
    to.rake = std::atan2(up, along) / radians(1);
  }
  const std::size_t windows = rows.size() - joined.size();
  rows = std::move(joined);
  return windows;
}

constexpr double same_direction = 0.5;  // degrees; positions in files are rounded

/// Numbers the segments by the numbers of the file, or by strike and dip. A mesh of many directions is one segment.
void number_segments(std::vector<Row>& rows) {
  double number = 0;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row &row = rows[i], &before = rows[i > 0 ? i - 1 : 0];
    const bool by_number = !std::isnan(row.segment);
    if (by_number ? row.segment != before.segment
                  : std::fabs(std::remainder(row.strike - before.strike, 360)) > same_direction ||
                        std::fabs(row.dip - before.dip) > same_direction)
      ++number;
    numbers.push_back(number);
  }
  const bool is_mesh = std::isnan(rows.front().segment) && number > std::fmax(10, double(rows.size()) / 8);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].segment = is_mesh ? 0 : numbers[i];
}

/// A value that all rows of a segment share, up to `tolerance`, or NaN. The comparison is with the first row.
template <class Get>
double shared(const std::vector<const Row*>& rows, double tolerance, const Get& get) {
  const double first = get(*rows.front());
  double sum = 0;
  for (const Row* row : rows) {
    const double value = get(*row);
    if (!(std::fabs(value - first) <= tolerance)) return none;
    sum += value - first;
  }
  return first + sum / static_cast<double>(rows.size());
}

std::optional<double> given(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

/// Puts rows of a known length in order: downwards, and each in the direction of strike.
void order_rows(std::vector<FaultPatch>& patches, double strike, std::size_t length) {
  const auto along = [&](const FaultPatch& p) {
    return p.east * std::sin(radians(strike)) + p.north * std::cos(radians(strike));
  };
  std::vector<std::vector<FaultPatch>> rows;
  for (std::size_t from = 0; from < patches.size(); from += length) {
    const auto begin = patches.begin() + static_cast<std::ptrdiff_t>(from);
    rows.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(length));
    std::stable_sort(rows.back().begin(), rows.back().end(),
                     [&](const FaultPatch& a, const FaultPatch& b) { return along(a) < along(b); });
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a[0].depth < b[0].depth; });
  patches.clear();
  for (const auto& row : rows) patches.insert(patches.end(), row.begin(), row.end());
}

/// Builds the model of a table whose rows are complete.
class Assembly {
 public:
  explicit Assembly(Table& table) : table_(table) {}
  FaultModel model();

 private:
  FaultPatch patch_of(const Row& row, std::size_t at) const;
  FaultSegment segment_of(const std::vector<const Row*>& rows, std::size_t number);
  void find_hypocentre();
  void fill_rock();
  void observe();
  void observe_velocity();

  Table& table_;
  FaultModel out_;
  std::size_t placed_ = 0;
};

/// Without a hypocentre, the subfault that slips first. Without rupture times, the one that slips most. An epicentre
/// has the depth of the nearest subfault.
void Assembly::find_hypocentre() {
  if (std::isfinite(table_.longitude) && std::isfinite(table_.latitude)) {
    double nearest = HUGE_VAL;
    if (std::isfinite(table_.depth)) return;
    for (const Row& row : table_.rows) {
      const double distance =
          std::hypot(std::remainder(row.longitude - table_.longitude, 360), row.latitude - table_.latitude);
      if (distance < nearest) nearest = distance, table_.depth = row.depth;
    }
    return;
  }
  const Row *first = nullptr, *largest = &table_.rows.front();
  for (const Row& row : table_.rows) {
    if (row.slip > largest->slip) largest = &row;
    if (row.slip > 0 && row.rupture_time >= 0 && (!first || row.rupture_time < first->rupture_time)) first = &row;
  }
  const Row& origin = first ? *first : *largest;
  table_.longitude = origin.longitude, table_.latitude = origin.latitude, table_.depth = origin.depth;
  table_.notes.push_back(std::string("the file gives no hypocentre: taken at the subfault that slips ") +
                         (first ? "first" : "most"));
}

/// Gives each subfault a shear modulus, if some have one: the mean by potency.
void Assembly::fill_rock() {
  double potency = 0, moment = 0, mass = 0, known = 0;
  for (const Row& row : table_.rows) {
    if (std::isnan(row.shear_modulus)) continue;
    const double p = std::fabs(row.slip) * (std::isnan(row.area) ? 1 : row.area);
    potency += p, moment += p * row.shear_modulus;
    if (!std::isnan(row.density)) known += p, mass += p * row.density;
  }
  if (!(potency > 0)) return;
  const double mean = moment / potency;
  for (Row& row : table_.rows)
    if (std::isnan(row.shear_modulus)) row.shear_modulus = mean;
  Observation& o = out_.observation;
  o.shear_modulus = mean;
  if (!(known > 0)) return;
  o.density = mass / known;
  o.s_wave_speed = std::sqrt(mean / *o.density);
}

FaultPatch Assembly::patch_of(const Row& row, std::size_t at) const {
  constexpr double longest_time = 900;  // s
  return {
      .longitude = row.longitude,
      .latitude = row.latitude,
      .east = m_per_degree * std::cos(radians(row.latitude)) * std::remainder(row.longitude - table_.longitude, 360),
      .north = m_per_degree * (row.latitude - table_.latitude),
      .depth = row.depth,
      .slip = row.slip,
      .strike = given(row.strike),
      .dip = given(row.dip),
      .rake = given(row.rake),
      .rise_time = row.rise_time > 0 && row.rise_time < longest_time ? given(row.rise_time) : std::nullopt,
      .rupture_time = row.rupture_time > -90 ? given(row.rupture_time) : std::nullopt,
      .area = given(row.area),
      .shear_modulus = given(row.shear_modulus),
      .density = given(row.density),
      .row = at};
}

FaultSegment Assembly::segment_of(const std::vector<const Row*>& rows, std::size_t number) {
  FaultSegment segment;
  segment.line = rows.front()->line;
  const double strike = rows.front()->strike;
  const double turned =
      shared(rows, same_direction, [&](const Row& r) { return std::remainder(r.strike - strike, 360); });
  const double length = shared(rows, 0.02 * rows.front()->length, [](const Row& r) { return r.length; });
  const double width = shared(rows, 0.02 * rows.front()->width, [](const Row& r) { return r.width; });
  segment.strike = given(strike);
  segment.dip = given(rows.front()->dip);
  if (const double dip = shared(rows, same_direction, [](const Row& r) { return r.dip; }); dip > 0) segment.dip = dip;
  segment.cell_length = given(length), segment.cell_width = given(width);
  for (const Row* row : rows) segment.patches.push_back(patch_of(*row, placed_++));
  const Grid grid = number < table_.grids.size() ? table_.grids[number] : Grid{};
  if (std::isnan(turned)) return segment;
  if (grid.along_strike > 0 && grid.along_strike * grid.down_dip == rows.size()) {
    order_rows(segment.patches, strike, grid.along_strike);
    segment.down_dip = grid.down_dip;
  } else {
    segment.down_dip = sort_into_rows(segment.patches, strike);
  }
  if (segment.down_dip > 0) segment.along_strike = rows.size() / segment.down_dip;
  return segment;
}

/// Rupture velocity from the rupture times: least squares of the distance from the hypocentre, weighted by slip.
void Assembly::observe_velocity() {
  double largest = 0, first = HUGE_VAL, dt = 0, tt = 0;
  std::size_t count = 0;
  for (const FaultSegment& segment : out_.segments)
    for (const FaultPatch& p : segment.patches) {
      largest = std::fmax(largest, p.slip);
      if (p.slip > 0) first = std::fmin(first, p.rupture_time.value_or(HUGE_VAL));
    }
  for (const FaultSegment& segment : out_.segments)
    for (const FaultPatch& p : segment.patches) {
      const double time = p.rupture_time.value_or(-HUGE_VAL) - first;
      if (!(time > 0) || p.slip < 0.05 * largest) continue;
      ++count;
      dt += p.slip * std::hypot(p.east, p.north, p.depth - out_.hypocentre_depth.value_or(p.depth)) * time;
      tt += p.slip * time * time;
    }
  const double velocity = dt / tt;
  Observation& o = out_.observation;
  if (count < 2 || !std::isfinite(velocity) || !(velocity > 0)) {
    o.warnings.push_back("no rupture times: rupture velocity not given");
    return;
  }
  o.rupture_velocity_m_s = MeasuredValue{velocity, velocity};
  o.warnings.push_back(
      "rupture velocity from the rupture times: distance from the hypocentre by least squares, weighted by slip");
}

void Assembly::observe() {
  double potency = 0, area = 0, slip = 0, slip_times_rise = 0;
  std::size_t timed = 0, slipping = 0;
  Observation& o = out_.observation;
  for (std::size_t k = 0; k < out_.segments.size(); ++k)
    for (const FaultPatch& p : out_.segments[k].patches) {
      o.subfaults[p.row] = {.segment = k,
                            .x = p.east,
                            .y = p.north,
                            .z = p.depth,
                            .slip = p.slip,
                            .rise_time = p.rise_time,
                            .rupture_time = p.rupture_time && *p.rupture_time >= 0 ? p.rupture_time : std::nullopt};
      potency += p.slip * p.area.value_or(1), area += p.area.value_or(1);
      if (!(p.slip > 0)) continue;
      ++slipping;
      if (p.rise_time) ++timed, slip += p.slip, slip_times_rise += p.slip * *p.rise_time;
    }
  std::optional<double> rise;
  if (timed > 0) rise = slip_times_rise / slip;
  if (rise)
    o.warnings.push_back("rise time from the slip-weighted mean of " + std::to_string(timed) + " of " +
                         std::to_string(slipping) + " subfaults with slip");
  give_slip(o, potency / area, rise);
}

FaultModel Assembly::model() {
  find_hypocentre();
  fill_rock();
  out_.notes = table_.notes;
  out_.notes.push_back(table_.tops ? "positions in the file are those of upper edges: moved down dip to the centres"
                                   : "positions in the file are those of centres");
  Observation& o = out_.observation;
  o.name = table_.name;
  o.kind = "earthquake";
  o.file = table_.file;
  o.line = table_.rows.front().line;
  o.subfaults.resize(table_.rows.size());
  out_.hypocentre_depth = given(table_.depth);
  std::vector<std::vector<const Row*>> segments;
  for (const Row& row : table_.rows) {
    if (row.segment >= static_cast<double>(segments.size())) segments.emplace_back();
    segments.back().push_back(&row);
  }
  for (std::size_t k = 0; k < segments.size(); ++k) out_.segments.push_back(segment_of(segments[k], k));
  observe_velocity();
  observe();
  share_moment(out_);
  return std::move(out_);
}

}  // namespace

FaultModel model_of(Table&& table) {
  if (table.rows.empty())
    throw InputError(
        {.file = table.file, .problem = "no subfaults (" + table.format + ")", .allowed = "at least one row"});
  if (table.name.empty()) table.name = table.file.substr(table.file.find_last_of('/') + 1);
  for (Row& row : table.rows) {
    complete(row);
    if (table.tops) move_to_centre(row);
    check(row, table.file);
  }
  if (const std::size_t windows = join_windows(table.rows); windows > 0) {
    table.grids.clear();
    table.notes.push_back("subfaults at one position are time windows, joined: " + std::to_string(windows));
  }
  number_segments(table.rows);
  return Assembly(table).model();
}

}  // namespace slipfront::catalogue::subfaults
