#include <algorithm>
#include <cmath>

#include "events/catalogue/fsp/fsp.hpp"
#include "math/constants.hpp"

namespace slipfront::catalogue::fsp {
namespace {

constexpr double longest_rise_time = 900;  // s; this and larger values are placeholders

/// Whether a time of a row counts as absent only because it is so long.
bool is_too_long(const std::optional<std::size_t>& column, const std::vector<double>& values) {
  return column && values[*column] >= longest_rise_time && !is_placeholder(values[*column]);
}

[[noreturn]] void refuse_heading(std::size_t line, const std::string& file, const std::string& segment) {
  throw InputError({.file = file,
                    .line = line,
                    .key = segment,
                    .problem = "announced, but no table of subfaults follows: the file is cut short",
                    .allowed = "a line of column names and the rows it announces"});
}

/// The numbers of a row. A word that stands for an absent value is NaN if the row has one word a column. Other words
/// are skipped.
std::vector<double> numbers(const Words& row, std::size_t columns, const Place& place) {
  std::vector<double> out;
  for (const std::string_view word : row) {
    const auto value = row.size() == columns && is_placeholder(word) ? std::optional(none) : number(word);
    if (!value) continue;
    if (std::isinf(*value)) {
      throw InputError({.file = place.file,
                        .line = place.line,
                        .key = "subfault",
                        .value = std::string(word),
                        .problem = "out of range",
                        .allowed = "finite numbers"});
    }
    out.push_back(*value);
  }
  return out;
}

}  // namespace

bool SubfaultTables::is_heading(const Words& words) {
  return index_of(words, "LAT") && index_of(words, "LON") && index_of(words, "SLIP") && !index_of(words, "=");
}

void SubfaultTables::take_segment_line(std::string_view text, const Place& place) {
  if (announced_ > 0) refuse_heading(announced_, place.file, "SEGMENT");
  next_ = {};
  next_.strike = angle_of(text, "STRIKE", place);
  next_.dip = dip_of(text, "DIP", place);
  announced_ = place.line;
}

void SubfaultTables::take_keys(std::string_view text, const Place& place) {
  keep(next_.stated_rows, count_of(text, "Nsbfs", place));
  keep(next_.length, size_of(text, "LEN", place));
  keep(next_.width, size_of(text, "WID", place));
  keep(next_.dx, size_of(text, "Dx", place));
  keep(next_.dz, size_of(text, "Dz", place));
  if (const auto top = value_of(text, "Z2top", place); top && top->number && std::fabs(*top->number) < 99)
    next_.top = top->number;
}

void SubfaultTables::take_heading(const Words& names, const Place& place) {
  if (!segments_.empty() && segments_.back().rows == 0) {
    refuse_heading(segments_.back().line, place.file, label(segments_.size() - 1));
  }
  for (const std::string_view wanted : {"SLIP", "RISE"}) {
    if (std::count_if(names.begin(), names.end(), [&](std::string_view n) { return same(n, wanted); }) > 1) {
      throw InputError({.file = place.file,
                        .line = place.line,
                        .key = std::string(wanted),
                        .problem = "two columns of this name",
                        .allowed = "one"});
    }
  }
  next_.columns = names.size();
  next_.slip_column = index_of(names, "SLIP").value();
  next_.rise_column = index_of(names, "RISE");
  next_.time_column = index_of(names, "TRUP");
  next_.z_column = index_of(names, "Z");
  next_.rake_column = index_of(names, "RAKE");
  next_.latitude_column = index_of(names, "LAT").value();
  next_.longitude_column = index_of(names, "LON").value();
  for (std::size_t i = 0; i < names.size(); ++i) {  // X==NS or X==EW
    if (begins(names[i], "X==")) next_.x_column = i, next_.x_is_north = begins(names[i], "X==N");
    if (begins(names[i], "Y==")) next_.y_column = i;
  }
  next_.line = place.line;
  segments_.push_back(next_);
  next_ = {};
  announced_ = 0;
}

void SubfaultTables::take_row(const Words& row, const Place& place) {
  Segment& segment = segments_.back();
  const std::vector<double> values = numbers(row, segment.columns, place);
  if (values.size() != segment.columns) {
    throw InputError(
        {.file = place.file,
         .line = place.line,
         .key = "subfault",
         .value = tidy(row.front().substr(0, 40)) + " ...",
         .problem = std::to_string(values.size()) + " numbers in this row",
         .allowed = std::to_string(segment.columns) + ", one for each name of line " + std::to_string(segment.line)});
  }
  if (row.size() != values.size()) ++stray_rows_;
  ++segment.rows;
  if (is_placeholder(values[segment.slip_column])) {
    ++rows_without_slip_;
  } else {
    add_slip(segment, values);
    keep_subfault(segment, values);
  }
}

void SubfaultTables::add_slip(Segment& segment, const std::vector<double>& values) {
  const double slip = values[segment.slip_column];
  if (slip < 0) ++negative_rows_;
  if (slip > 0) ++slipping_rows_;
  if (is_too_long(segment.rise_column, values)) ++long_rises_;
  if (is_too_long(segment.time_column, values)) ++late_rows_;
  segment.slip += slip;
  ++segment.rows_with_slip;
  if (!segment.rise_column) return;
  const double rise = values[*segment.rise_column];
  if (slip > 0 && rise > 0 && rise < longest_rise_time) {
    ++rows_with_rise_;
    segment.slip_with_rise += slip;
    segment.slip_times_rise += slip * rise;
  }
}

void SubfaultTables::leave_out(std::size_t row) {
  Subfault& s = subfaults_[row];
  Segment& segment = segments_[s.segment];
  segment.slip -= s.slip;
  --segment.rows_with_slip;
  ++segment.rows_left_out;
  if (s.slip > 0) --slipping_rows_;
  if (s.slip > 0 && s.rise_time) {
    segment.slip_with_rise -= s.slip;
    segment.slip_times_rise -= s.slip * *s.rise_time;
    --rows_with_rise_;
  }
  s.slip = 0;
}

void SubfaultTables::keep_subfault(Segment& segment, const std::vector<double>& values) {
  if (!segment.x_column || !segment.y_column || !segment.z_column) return;
  for (const auto column : {segment.x_column, segment.y_column, segment.z_column})
    if (std::isnan(values[*column])) return;
  if (std::isnan(values[segment.longitude_column]) || std::isnan(values[segment.latitude_column])) return;
  Subfault s{.segment = segments_.size() - 1,
             .x = values[*segment.x_column] * m_per_km,
             .y = values[*segment.y_column] * m_per_km,
             .z = values[*segment.z_column] * m_per_km,
             .slip = values[segment.slip_column]};
  if (segment.rise_column && values[*segment.rise_column] > 0 && values[*segment.rise_column] < longest_rise_time)
    s.rise_time = values[*segment.rise_column];
  if (segment.time_column && values[*segment.time_column] >= 0 && values[*segment.time_column] < longest_rise_time)
    s.rupture_time = values[*segment.time_column];
  const auto cell = [&](const std::optional<std::size_t>& column, double least, double most) {
    const double value = column ? values[*column] : HUGE_VAL;
    return value > least && value < most ? std::optional(value) : std::nullopt;
  };
  segment.patches.push_back({.longitude = values[segment.longitude_column],
                             .latitude = values[segment.latitude_column],
                             .east = segment.x_is_north ? s.y : s.x,
                             .north = segment.x_is_north ? s.x : s.y,
                             .depth = s.z,
                             .slip = s.slip,
                             .rake = cell(segment.rake_column, -720, 720),
                             .rise_time = s.rise_time,
                             .rupture_time = cell(segment.time_column, -90, longest_rise_time),
                             .row = subfaults_.size()});
  subfaults_.push_back(s);
}

void SubfaultTables::check(const Header& header, const Place& end, std::vector<std::string>& warnings) const {
  if (announced_ > 0) refuse_heading(announced_, end.file, "SEGMENT");
  if (header.segments && segments_.size() < *header.segments) {
    throw InputError(
        {.file = end.file,
         .line = end.line,
         .key = "Nsg",
         .value = std::to_string(*header.segments),
         .problem = "only " + std::to_string(segments_.size()) + " segments have a table: the file is cut short",
         .allowed = "as many tables as segments"});
  }
  if (header.segments && segments_.size() > *header.segments) {
    warnings.push_back("Nsg = " + std::to_string(*header.segments) + ", but " + std::to_string(segments_.size()) +
                       " segments have a table: all are used");
  }
  for (std::size_t k = 0; k < segments_.size(); ++k) check_rows(k, header, end, warnings);
  if (stray_rows_ > 0) {
    warnings.push_back("rows with words that are no numbers, left out: " + std::to_string(stray_rows_));
  }
  if (rows_without_slip_ > 0) {
    warnings.push_back("subfaults whose slip is a placeholder, left out: " + std::to_string(rows_without_slip_));
  }
  if (negative_rows_ > 0) {
    warnings.push_back("subfaults that slip backwards, counted as written: " + std::to_string(negative_rows_));
  }
  for (const auto& [count, column] : {std::pair(long_rises_, "RISE"), std::pair(late_rows_, "TRUP")})
    if (count > 0)
      warnings.push_back(std::string("times of 900 s or more in column ") + column +
                         " are taken as placeholders: " + std::to_string(count));
}

/// Both Nsbfs and Nx*Nz can be wrong in a complete file. A table counts as complete if its number of rows equals one of
/// them or exceeds both.
void SubfaultTables::check_rows(std::size_t index, const Header& header, const Place& end,
                                std::vector<std::string>& warnings) const {
  const Segment& segment = segments_[index];
  if (segment.rows == 0) refuse_heading(segment.line, end.file, label(index));
  const std::size_t stated = segment.stated_rows.value_or(0);
  const bool has_grid = segments_.size() == 1 && header.along_strike_cells && header.down_dip_cells;
  const std::size_t grid = has_grid ? *header.along_strike_cells * *header.down_dip_cells : 0;

  const std::string found = label(index) + " has " + std::to_string(segment.rows) + " subfaults";
  if (stated == 0 && grid == 0) {
    warnings.push_back(found + ", but there is no Nsbfs to check that none is missing");
  } else if (segment.rows != stated && segment.rows != grid && segment.rows < std::max(stated, grid)) {
    throw InputError({.file = end.file,
                      .line = index + 1 == segments_.size() ? end.line : segments_[index + 1].line,
                      .key = stated > segment.rows ? "Nsbfs" : "Nx*Nz",
                      .value = std::to_string(stated > segment.rows ? stated : grid),
                      .problem = found + ": the file is cut short",
                      .allowed = "as many rows as announced"});
  } else if (stated > 0 && segment.rows != stated) {
    warnings.push_back(found + ", not Nsbfs = " + std::to_string(stated) + ": all are used");
  } else if (grid > 0 && segment.rows != grid) {
    warnings.push_back(found + ", not Nx*Nz = " + std::to_string(grid) + ": all are used");
  }
}

std::string SubfaultTables::label(std::size_t index) const {
  return segments_.size() > 1 ? "segment " + std::to_string(index + 1) : "the table";
}

/// Area of the whole segment, km^2.
std::optional<double> SubfaultTables::Segment::area(const Header& header) const {
  const double n = static_cast<double>(rows);
  if (dx && dz) return *dx * *dz * n;
  if (length && width) return *length * *width;
  if (header.dx && header.dz) return *header.dx * *header.dz * n;
  return std::nullopt;
}

double SubfaultTables::mean_slip(const Header& header, std::vector<std::string>& warnings) const {
  const bool one = segments_.size() == 1;
  const auto has_area = [&](const Segment& s) { return s.area(header).has_value(); };
  const bool areas = !one && std::all_of(segments_.begin(), segments_.end(), has_area);
  if (!one && !areas) warnings.push_back("segments without area: all subfaults have equal weight");

  double potency = 0, total = 0;
  for (const Segment& segment : segments_) {
    if (segment.rows_with_slip == 0) continue;
    const double rows = static_cast<double>(segment.rows_with_slip);
    const double left = 1 - static_cast<double>(segment.rows_left_out) / static_cast<double>(segment.rows);
    const double area = areas ? segment.area(header).value() * left : rows;
    potency += segment.slip / rows * area;
    total += area;
  }
  return total > 0 ? potency / total : 0;
}

std::optional<double> SubfaultTables::mean_rise_time(std::vector<std::string>& warnings) const {
  double slip = 0, slip_times_rise = 0;
  for (const Segment& segment : segments_) {
    slip += segment.slip_with_rise;
    slip_times_rise += segment.slip_times_rise;
  }
  const double mean = slip_times_rise / slip;
  if (!(slip > 0 && std::isfinite(mean) && mean > 0)) return std::nullopt;
  const std::string from = std::to_string(rows_with_rise_) + " of " + std::to_string(slipping_rows_);
  warnings.push_back("rise time from the slip-weighted mean of column RISE" +
                     (rows_with_rise_ < slipping_rows_ ? ", which only " + from + " subfaults with slip have" : ""));
  return mean;
}

}  // namespace slipfront::catalogue::fsp
