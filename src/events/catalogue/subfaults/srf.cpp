#include <algorithm>
#include <cmath>

#include "events/catalogue/fault_model.hpp"
#include "events/catalogue/format.hpp"
#include "events/catalogue/fsp/fsp.hpp"
#include "events/catalogue/subfaults/subfaults.hpp"
#include "text/characters.hpp"

/// \file
/// The Standard Rupture Format, versions 1.0 and 2.0 (Graves 2014). Units are km, cm, cm^2, g/cm^3 and degrees.

namespace slipfront::catalogue::subfaults {
namespace {

/// The words of a file without its comments, one after the other.
class WordStream {
 public:
  WordStream(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  /// The next word; empty at the end.
  std::string_view word() {
    while (at_ >= line_words_.size() && next_line()) {
    }
    return at_ < line_words_.size() ? line_words_[at_++] : std::string_view();
  }
  double number() {
    const std::string_view next = word();
    if (next.empty())
      throw InputError({.file = file_,
                        .line = line_,
                        .problem = "the file is cut short",
                        .allowed = "as many subfaults and slip rates as announced"});
    return number_in(next, file_, line_);
  }
  std::size_t count(std::size_t most) {
    const double value = number();
    if (!(value >= 0) || value > static_cast<double>(most) || value != std::floor(value))
      throw InputError({.file = file_,
                        .line = line_,
                        .value = std::string(line_words_[at_ - 1]),
                        .problem = "not a count",
                        .allowed = "0 to " + std::to_string(most)});
    return static_cast<std::size_t>(value);
  }
  std::size_t line() const { return line_; }

 private:
  bool next_line() {
    if (text_.empty()) return false;
    const std::string_view line = trimmed(take_line(text_));
    ++line_;
    line_words_ = line.starts_with('#') ? fsp::Words() : fsp::words(line);
    at_ = 0;
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  fsp::Words line_words_;
  std::size_t at_ = 0, line_ = 0;
};

constexpr double km = 1000, cm = 0.01, cm2 = 1e-4, g_per_cm3 = 1000;
constexpr std::size_t most_subfaults = 10000000;

/// Number and size of the subfaults of a plane.
struct PlaneHeader {
  Grid grid;
  double length, width;
};

PlaneHeader read_plane(WordStream& in, Table& table) {
  const double longitude = in.number(), latitude = in.number();
  PlaneHeader plane{.grid = {in.count(most_subfaults), in.count(most_subfaults)}, .length = 0, .width = 0};
  plane.length = km * in.number() / static_cast<double>(plane.grid.along_strike);
  plane.width = km * in.number() / static_cast<double>(plane.grid.down_dip);
  const double strike = radians(in.number()), dip = radians(in.number()), top = km * in.number();
  const double along = km * in.number(), down = km * in.number();
  if (std::fabs(along) > 900 * km || !(down >= 0) || !std::isnan(table.longitude)) return plane;  // -999.9 is absent
  const double across = down * std::cos(dip);
  const double north = along * std::cos(strike) - across * std::sin(strike);
  const double east = along * std::sin(strike) + across * std::cos(strike);
  table.latitude = latitude + north / m_per_degree;
  table.longitude = longitude + east / (m_per_degree * std::cos(radians(latitude)));
  table.depth = top + down * std::sin(dip);
  return plane;
}

Row read_point(WordStream& in, bool has_rock) {
  Row row{.line = in.line()};
  row.longitude = in.number(), row.latitude = in.number(), row.depth = km * in.number();
  row.line = in.line();
  row.strike = in.number(), row.dip = in.number(), row.area = cm2 * in.number();
  row.rupture_time = in.number();
  const double step = in.number();
  if (has_rock) row.s_wave_speed = cm * in.number(), row.density = g_per_cm3 * in.number();
  const double rake = in.number();
  double slips[2] = {0, 0};
  std::size_t rates = 0, longest = 0;
  for (int direction = 0; direction < 3; ++direction) {  // along the rake, across it, and normal to the plane
    const double slip = cm * in.number();
    const std::size_t count = in.count(most_subfaults);
    if (direction < 2) slips[direction] = slip, longest = std::max(longest, count);
    rates += count;
  }
  for (std::size_t i = 0; i < rates; ++i) in.number();
  row.slip = slips[1] == 0 ? slips[0] : std::hypot(slips[0], slips[1]);
  row.rake = slips[1] == 0 ? rake : rake + std::atan2(slips[1], slips[0]) / radians(1);
  row.rise_time = static_cast<double>(longest) * step;
  return row;
}

/// The first comment that is not empty, which our own files have the name of the event in.
std::string first_comment(std::string_view text) {
  const std::size_t sign = text.find('#');
  if (sign > 20) return {};
  return fsp::tidy(text.substr(sign + 1, text.substr(sign + 1).find('\n')).substr(0, 80));
}

Table read_srf(std::string_view text, const std::string& file) {
  WordStream in(text, file);
  const std::string version(in.word());
  Table table{.file = file, .format = "SRF " + version, .name = first_comment(text)};
  std::vector<PlaneHeader> planes;
  std::size_t block = 0;
  for (std::string_view word = in.word(); !word.empty(); word = in.word()) {
    if (word == "PLANE") {
      for (std::size_t n = in.count(most_subfaults); n > 0; --n) planes.push_back(read_plane(in, table));
    } else if (word == "POINTS") {
      const PlaneHeader* plane = block < planes.size() ? &planes[block] : nullptr;
      table.grids.push_back(plane ? plane->grid : Grid{});
      ++block;
      for (std::size_t n = in.count(most_subfaults); n > 0; --n) {
        Row& row = table.rows.emplace_back(read_point(in, version == "2.0"));
        row.segment = static_cast<double>(block);
        if (plane) row.length = plane->length, row.width = plane->width;
      }
    } else {
      throw InputError({.file = file,
                        .line = in.line(),
                        .value = std::string(word),
                        .problem = "not part of SRF " + version,
                        .allowed = "PLANE or POINTS"});
    }
  }
  return table;
}

bool is_srf_text(std::string_view text) {
  while (trimmed(text).starts_with('#')) {
    text = trimmed(text);
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
  const std::string_view start = trimmed(text).substr(0, 4);
  return (start.starts_with("1.0") || start.starts_with("2.0")) && trimmed(start).size() == 3 &&
         text.find("\nPOINTS") != std::string_view::npos;
}

}  // namespace

const FaultFormat srf_format{is_srf_text, read_srf};

}  // namespace slipfront::catalogue::subfaults
