#include "events/catalogue/fsp/fsp.hpp"

#include <algorithm>
#include <cmath>

#include "events/catalogue/fault_model.hpp"
#include "events/catalogue/format.hpp"
#include "math/digits.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace slipfront::catalogue {
namespace {

using fsp::begins;
using fsp::Place;
using fsp::Words;

/// Reads a model line by line; the comment signs of a line say little, its words say what it is.
class Reader {
 public:
  explicit Reader(const std::string& file) : file_(file) {}

  void take(std::string_view line);
  FaultModel finish_model();

 private:
  Observation finish();
  std::size_t leave_out_water(FaultModel& model);
  void take_text(std::string_view text, const Place& place);
  void refuse_unless_model(const Place& end) const;
  void fill_velocities(Observation& out) const;

  const std::string& file_;
  std::size_t line_ = 0;
  bool titled_ = false;
  bool in_velocity_table_ = false;
  fsp::Header header_;
  fsp::VelocityTable layers_;
  fsp::SubfaultTables tables_;
  std::size_t ignored_rows_ = 0;  ///< numbers before any column names
};

/// A line without comment sign: subfaults, or header text that lost its sign?
bool is_row(std::string_view text, const Words& words) {
  if (fsp::number(words.front())) return true;
  if (text.find_first_of("=:") != std::string_view::npos) return false;
  for (const std::string_view word : words) {
    if (fsp::number(word)) return true;
  }
  return false;
}

void Reader::take(std::string_view line) {
  const Place place{file_, ++line_};
  line = fsp::trimmed(line);
  const std::string_view text = fsp::uncommented(line);
  if (text.empty()) return;
  const Words words = fsp::words(text);
  if (fsp::SubfaultTables::is_heading(words)) {
    in_velocity_table_ = false;
    tables_.take_heading(words, place);
  } else if (line.front() == '%' || in_velocity_table_ || !is_row(text, words)) {
    take_text(text, place);
  } else if (tables_.empty() && !tables_.awaits_heading()) {
    ++ignored_rows_;
  } else if (tables_.awaits_heading()) {
    throw InputError({.file = file_,
                      .line = line_,
                      .key = "SEGMENT",
                      .problem = "rows without column names",
                      .allowed = "a line of column names before the rows of a segment"});
  } else {
    tables_.take_row(words, place);
  }
}

void Reader::take_text(std::string_view text, const Place& place) {
  if (text.find("FINITE-SOURCE") != std::string_view::npos) titled_ = true;
  if (begins(text, "VELOCITY-DENSITY")) {
    in_velocity_table_ = true;
  } else if (begins(text, "---") || begins(text, "SOURCE MODEL")) {
    in_velocity_table_ = false;
  } else if (begins(text, "SEGMENT")) {
    in_velocity_table_ = false;
    tables_.take_segment_line(text, place);
  } else if (in_velocity_table_) {
    layers_.take(text, place);
  } else if (!header_.take(text, place)) {
    tables_.take_keys(text, place);
  }
}

void Reader::refuse_unless_model(const Place& end) const {
  Complaint complaint{.file = end.file, .line = end.line, .allowed = "a model in SRCMOD / USGS .fsp format"};
  if (!titled_ && (header_.event_line == 0 || tables_.empty())) {
    complaint.problem = line_ == 0 ? "empty" : "not a finite-fault model";
  } else if (tables_.empty()) {
    complaint.problem = "ends before the table of subfaults (columns LAT LON ... SLIP): the file is cut short";
  } else if (header_.name.empty() && header_.tag.empty()) {
    complaint.line = header_.event_line;
    complaint.key = "Event";
    complaint.problem = "no name";
    complaint.allowed = "% Event : NAME DATE [REFERENCE]";
  } else {
    return;
  }
  throw InputError(std::move(complaint));
}

/// The number of a header field, unless it is left blank or holds a placeholder: 0, -99, 999, nan.
std::optional<double> given(const fsp::Field& field, const std::string& key, double limit,
                            std::vector<std::string>& warnings) {
  if (field.number && *field.number > 0 && *field.number < limit) return field.number;
  if (!field.present) {
    warnings.push_back("no " + key + " in the header");
  } else if (field.number) {
    warnings.push_back(key + " = " + shortest(*field.number) + " is taken as a placeholder: not given");
  } else {
    warnings.push_back(key + " = '" + field.text + "' has no number: not given");
  }
  return std::nullopt;
}

void Reader::fill_velocities(Observation& out) const {
  if (const auto v = given(header_.rupture_velocity_km_s, "avVr", 99, out.warnings)) {
    out.rupture_velocity_m_s = MeasuredValue{*v * fsp::m_per_km, *v * fsp::m_per_km};
  }
  std::optional<double> rise = given(header_.rise_time, "avTr", 900, out.warnings);
  if (!rise) rise = tables_.mean_rise_time(out.warnings);

  const double slip = tables_.mean_slip(header_, out.warnings);
  if (!std::isfinite(slip)) {
    throw InputError({.file = file_,
                      .line = line_,
                      .key = "SLIP",
                      .problem = "the mean is out of range",
                      .allowed = "slip and sizes with a finite mean"});
  }
  give_slip(out, slip, rise);
}

Observation Reader::finish() {
  const Place end{file_, line_};
  refuse_unless_model(end);
  Observation out;
  out.name = header_.name.empty() ? header_.tag : header_.name;
  out.date = header_.date;
  out.kind = "earthquake";
  out.citation = header_.citation();
  out.file = file_;
  out.line = header_.event_line > 0 ? header_.event_line : header_.tag_line;
  if (ignored_rows_ > 0) {
    out.warnings.push_back("lines of numbers before the column names, ignored: " + std::to_string(ignored_rows_));
  }
  tables_.check(header_, end, out.warnings);
  fill_velocities(out);
  out.subfaults = tables_.subfaults();
  layers_.fill(header_.hypocentre_depth(), out);
  return out;
}

/// Sets the slip of subfaults in water to 0. Their slip is no dislocation of rock, and has no moment.
std::size_t Reader::leave_out_water(FaultModel& model) {
  std::size_t count = 0;
  for (FaultSegment& segment : model.segments)
    for (FaultPatch& p : segment.patches) {
      if (p.slip == 0 || !layers_.is_water_at(p.depth / fsp::m_per_km)) continue;
      tables_.leave_out(p.row);
      p.slip = 0;
      ++count;
    }
  return count;
}

/// Warns of sizes or slip that are in another unit than the file states: their moment is far from that of the header.
void check_moment(FaultModel& model, double moment) {
  if (!model.moment || !(moment > 0)) return;
  const double ratio = moment / *model.moment;
  constexpr double most = 100;
  if (ratio > 1 / most && ratio < most) return;
  model.observation.warnings.push_back("slip, area and shear modulus of the subfaults give a moment of " +
                                       digits(moment, 3) + " N m, " + digits(ratio, 3) + " times that of the header");
}

FaultModel Reader::finish_model() {
  FaultModel out;
  tables_.fill(header_, out);
  const std::size_t in_water = leave_out_water(out);
  out.observation = finish();
  if (in_water > 0)
    out.observation.warnings.push_back("subfaults in the water layer, which has no rigidity; their slip is left out: " +
                                       std::to_string(in_water));
  out.rock = layers_.rock();
  if (const auto depth = header_.hypocentre_depth()) out.hypocentre_depth = fsp::m_per_km * *depth;
  out.moment = header_.moment;
  out.rake = header_.rake;
  check_moment(out, share_moment(out));
  return out;
}

void read(std::string_view text, Reader& reader) {
  while (!text.empty()) reader.take(take_line(text));
}

}  // namespace

FaultModel fsp::read_model(std::string_view text, const std::string& file) {
  Reader reader(file);
  read(text, reader);
  return reader.finish_model();
}

Observation read_fsp(std::string_view text, const std::string& file) { return fsp::read_model(text, file).observation; }

}  // namespace slipfront::catalogue

namespace slipfront::catalogue::fsp {
namespace {

/// Whether positions are those of upper edges. The depth of the upper edge of the segment decides. If it does not, the
/// text of the file decides. Files that give neither have centres.
bool are_tops(const FaultSegment& segment, std::optional<double> top, std::optional<bool> stated) {
  const double half = *segment.cell_width / 2 * std::sin(radians(*segment.dip));
  double shallowest = HUGE_VAL;
  for (const FaultPatch& p : segment.patches) shallowest = std::fmin(shallowest, p.depth);
  if (top && half > 2 * least_gap) {
    const double below = (shallowest - m_per_km * *top) / half;
    if (std::fabs(below) < 0.25) return true;
    if (std::fabs(below - 1) < 0.25) return false;
  }
  return stated.value_or(false);
}

/// Whether latitude and longitude contradict `east` and `north`, and agree if these two are exchanged. Most older files
/// of SRCMOD have the titles X==NS and Y==EW over columns that are the other way round.
bool are_exchanged(const std::vector<FaultPatch>& patches) {
  const FaultPatch& first = patches.front();
  double as_titled = 0, exchanged = 0;
  for (const FaultPatch& p : patches) {
    const double x = p.east - first.east, y = p.north - first.north;
    const double north = m_per_degree * (p.latitude - first.latitude);
    const double east =
        m_per_degree * std::cos(radians(p.latitude)) * std::remainder(p.longitude - first.longitude, 360);
    as_titled += std::hypot(x - east, y - north);
    exchanged += std::hypot(y - east, x - north);
  }
  return exchanged < 0.5 * as_titled;
}

std::optional<double> size(const std::optional<double>& km) {
  return km ? std::optional(m_per_km * *km) : std::nullopt;
}

}  // namespace

FaultSegment SubfaultTables::geometry_of(const Segment& table, const Header& header, bool exchanged) {
  FaultSegment segment;
  segment.line = table.line;
  segment.strike = table.strike ? table.strike : header.strike;
  segment.dip = table.dip ? table.dip : header.dip;
  segment.patches = table.patches;
  if (exchanged)
    for (FaultPatch& p : segment.patches) std::swap(p.east, p.north);
  segment.down_dip = segment.strike ? sort_into_rows(segment.patches, *segment.strike) : 0;
  if (segment.down_dip > 0) segment.along_strike = segment.patches.size() / segment.down_dip;
  const bool outlined = table.length && table.width;
  if (table.dx && table.dz) {
    segment.cell_length = size(table.dx), segment.cell_width = size(table.dz);
  } else if (outlined && segment.down_dip > 0) {
    segment.cell_length = m_per_km * *table.length / static_cast<double>(segment.along_strike);
    segment.cell_width = m_per_km * *table.width / static_cast<double>(segment.down_dip);
  } else if (!outlined) {
    segment.cell_length = size(header.dx), segment.cell_width = size(header.dz);
  }
  return segment;
}

void SubfaultTables::fill(const Header& header, FaultModel& out) const {
  std::size_t moved = 0, contradictions = 0;
  std::vector<FaultPatch> patches;
  for (const Segment& table : segments_) patches.insert(patches.end(), table.patches.begin(), table.patches.end());
  const bool exchanged = !patches.empty() && are_exchanged(patches);
  if (exchanged) out.notes.push_back("latitude and longitude show that the titles of columns X and Y are exchanged");
  for (const Segment& table : segments_) {
    if (table.patches.empty()) continue;
    FaultSegment& segment = out.segments.emplace_back(geometry_of(table, header, exchanged));
    if (!segment.strike || !segment.dip || !segment.cell_width) continue;
    const auto top = table.top || segments_.size() > 1 ? table.top : header.top;
    const bool tops = are_tops(segment, top, header.positions_are_tops);
    if (header.positions_are_tops && tops != *header.positions_are_tops) ++contradictions;
    if (tops) move_to_centres(segment), ++moved;
  }
  const bool all = moved == out.segments.size();
  out.notes.push_back(moved == 0 ? "positions in the file are those of centres"
                                 : std::string("positions in the file are those of upper edges") +
                                       (all ? "" : " on " + std::to_string(moved) + " segments") +
                                       ": moved down dip to the centres");
  if (contradictions > 0)
    out.notes.push_back("the depth of the upper edge, not the text of the file, decides what the positions are");
}

}  // namespace slipfront::catalogue::fsp
