#pragma once
/// \file
/// The parts of the .fsp reader, one .cpp each: text, header lines, velocity table, subfault tables. Private to
/// src/catalogue.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/catalogue/observation.hpp"

namespace slipfront::catalogue::fsp {

// Text (fsp_text.cpp). Every control character counts as a blank; nothing depends on the locale.

/// Where the reader stands.
struct Place {
  const std::string& file;
  std::size_t line;
};

using Words = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text);
/// A line without the comment signs it begins with; some published files repeat them.
std::string_view uncommented(std::string_view line);
Words words(std::string_view text);
/// Equal, whatever the case of ASCII letters.
bool same(std::string_view a, std::string_view b);
bool begins(std::string_view text, std::string_view with);
std::optional<std::size_t> index_of(const Words& words, std::string_view word);

/// The number that is all of a word: not finite if it overflows or underflows double, absent if the word is no number.
std::optional<double> number(std::string_view word);
/// Text for a person: single blanks, no control characters, valid UTF-8 (anything else is read as Latin-1).
std::string tidy(std::string_view text);

/// What stands after `key =`.
struct Value {
  std::string_view text;         ///< first word; empty if the line ends or the next key follows
  std::optional<double> number;  ///< of that word, finite
  std::string_view unit;         ///< glued to the number or the word after it
};

/// The value of a key, if the line has it. \throws InputError for a number outside double.
std::optional<Value> value_of(std::string_view text, std::string_view key, const Place& place);
/// The same for a size in km: absent unless positive and not a placeholder.
std::optional<double> size_of(std::string_view text, std::string_view key, const Place& place);
/// The same for a count: absent unless a positive whole number.
std::optional<std::size_t> count_of(std::string_view text, std::string_view key, const Place& place);

/// A later line overrides an earlier one only where it says something.
template <class T>
void keep(std::optional<T>& field, const std::optional<T>& found) {
  if (found) field = found;
}

// Header (fsp_header.cpp)

/// A velocity or time of the `Rupt` line, kept until it is known whether it is a placeholder.
struct Field {
  bool present = false;
  std::string text;
  std::optional<double> number;
};

/// The `label : key = value` lines that open a file.
struct Header {
  std::string name, date, reference, tag;
  std::size_t event_line = 0, tag_line = 0;  ///< 0: not seen yet
  Field rupture_velocity_km_s;               ///< avVr, km/s
  Field rise_time;                           ///< avTr, s
  std::optional<double> depth, down_dip;     ///< of the hypocentre, km
  std::optional<std::size_t> along_strike_cells, down_dip_cells, segments;
  std::optional<double> dx, dz;  ///< km

  /// Takes a line if it begins with a label of the header.
  bool take(std::string_view text, const Place& place);
  std::string citation() const;
  /// Depth of the hypocentre in km: DEP, else HypZ.
  std::optional<double> hypocentre_depth() const;
};

// Velocity table (fsp_layers.cpp)

/// VELOCITY-DENSITY STRUCTURE: layers, or an assumed shear modulus alone.
class VelocityTable {
 public:
  void take(std::string_view text, const Place& place);
  /// Elastic constants at a depth in km; where the table does not give them, a warning.
  void fill(std::optional<double> depth, Observation& out) const;

 private:
  struct Layer {
    double depth, p, s, density;  ///< km, km/s, km/s, g/cm^3
  };
  struct Columns {
    std::size_t depth, p, s, density;
  };

  void take_layer(const Words& row, const Place& place);
  std::string why_unusable() const;
  std::size_t layer_at(double depth) const;
  static bool is_water(const Layer& layer);
  static bool is_physical(const Layer& layer);

  std::optional<std::size_t> stated_layers_;
  std::optional<Columns> columns_;
  std::vector<Layer> layers_;
  bool modulus_follows_ = false;
  std::optional<double> modulus_;  ///< 1e10 Pa
};

// Subfault tables (fsp_table.cpp)

/// Slip of the subfaults, summed over each segment while its rows are read.
class SubfaultTables {
 public:
  static bool is_heading(const Words& words);

  void take_segment_line(const Place& place);
  void take_keys(std::string_view text, const Place& place);
  void take_heading(const Words& names, const Place& place);
  void take_row(const Words& row, const Place& place);

  bool empty() const { return segments_.empty(); }
  bool awaits_heading() const { return announced_ > 0; }
  /// Refuses tables that are not whole. \throws InputError
  void check(const Header& header, const Place& end, std::vector<std::string>& warnings) const;
  /// Mean slip, m, weighted with the areas of the subfaults.
  double mean_slip(const Header& header, std::vector<std::string>& warnings) const;
  /// The rows one by one, of segments that give X, Y and Z.
  const std::vector<Subfault>& subfaults() const { return subfaults_; }
  /// Mean of column RISE, s, weighted with slip, over rows where both are given.
  std::optional<double> mean_rise_time() const;

 private:
  struct Segment {
    std::optional<std::size_t> stated_rows;
    std::optional<double> length, width, dx, dz;  ///< km
    std::size_t columns = 0, slip_column = 0;
    std::optional<std::size_t> rise_column, time_column, x_column, y_column, z_column;
    std::size_t line = 0, rows = 0;
    double slip = 0, slip_with_rise = 0, slip_times_rise = 0;

    std::optional<double> area(const Header& header) const;
  };

  void keep_subfault(const Segment& segment, const std::vector<double>& values);
  void check_rows(std::size_t index, const Header& header, const Place& end, std::vector<std::string>& warnings) const;
  std::string label(std::size_t index) const;

  std::vector<Segment> segments_;
  std::vector<Subfault> subfaults_;
  Segment next_;                ///< what has been said of the segment whose column header is still to come
  std::size_t announced_ = 0;   ///< line of its `SEGMENT #`, 0 if there was none
  std::size_t stray_rows_ = 0;  ///< rows with words that are no numbers
  std::size_t negative_rows_ = 0;
};

}  // namespace slipfront::catalogue::fsp
