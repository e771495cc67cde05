#include "events/catalogue/fsp/fsp.hpp"

#include <cmath>

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
