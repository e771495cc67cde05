#pragma once
/// \file
/// The parts of the .fsp reader: text, header lines, velocity table and subfault tables, with one .cpp file each.
/// Private to src/events/catalogue.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/fault_model.hpp"

namespace slipfront::catalogue::fsp {

inline constexpr double m_per_km = 1000;

/// Reads a model. \throws InputError when the text is cut, empty or not such a model.
FaultModel read_model(std::string_view text, const std::string& file);

// Text (fsp_text.cpp). Control characters count as blanks. No function depends on the locale.

/// The file and the line that the reader has reached, for error messages.
struct Place {
  const std::string& file;
  std::size_t line;
};

using Words = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text);
/// The line without its leading comment signs. Some published files repeat the sign.
std::string_view uncommented(std::string_view line);
Words words(std::string_view text);
/// Compares two texts without regard to the case of ASCII letters.
bool same(std::string_view a, std::string_view b);
bool begins(std::string_view text, std::string_view with);
std::optional<std::size_t> index_of(const Words& words, std::string_view word);

/// Reads a word as a number. The result is infinite if the number overflows or underflows a double, NaN if the word is
/// `nan`, and absent if the word is not a number as a whole.
std::optional<double> number(std::string_view word);
/// Words and numbers that stand for an absent value: n/a, null, - and the like; NaN, -99, 999, -999, 9999 and -9999.
bool is_placeholder(std::string_view word);
bool is_placeholder(double value);
/// Text for display: single blanks, no control characters, valid UTF-8. Text that is not UTF-8 is read as Latin-1.
std::string tidy(std::string_view text);

/// The value after `key =`.
struct Value {
  std::string_view text;         ///< first word; empty if the line ends or the next key follows
  std::optional<double> number;  ///< that word as a finite number
  std::string_view unit;         ///< attached to the number, or the word after it
};

/// The value of a key, if the line has it. \throws InputError for a number outside the range of a double.
std::optional<Value> value_of(std::string_view text, std::string_view key, const Place& place);
/// Like `value_of`, but for a size in km. It is absent unless positive, and absent for a placeholder.
std::optional<double> size_of(std::string_view text, std::string_view key, const Place& place);
/// Like `value_of`, but for a count. It is absent unless it is a positive whole number.
std::optional<std::size_t> count_of(std::string_view text, std::string_view key, const Place& place);

/// A later line overrides an earlier one only if it gives the value.
template <class T>
void keep(std::optional<T>& field, const std::optional<T>& found) {
  if (found) field = found;
}

// Header (fsp_header.cpp)

/// A velocity or a time of the `Rupt` line. It is stored as read, because it may be a placeholder.
struct Field {
  bool present = false;
  std::string text;
  std::optional<double> number;
};

/// The `label : key = value` lines that open a file.
struct Header {
  std::string name, date, reference, tag;
  std::size_t event_line = 0, tag_line = 0;  ///< line numbers; 0: not read yet
  Field rupture_velocity_km_s;               ///< avVr, km/s
  Field rise_time;                           ///< avTr, s
  std::optional<double> depth, down_dip;     ///< position of the hypocentre, km
  std::optional<std::size_t> along_strike_cells, down_dip_cells, segments;
  std::optional<double> dx, dz;             ///< km
  std::optional<double> strike, dip, rake;  ///< degrees
  std::optional<double> top;                ///< depth of the upper edge, km
  std::optional<double> moment;             ///< N m
  std::optional<bool> positions_are_tops;   ///< whether positions are those of upper edges or of centres

  /// Reads a line if it begins with a label of the header. Returns whether it did.
  bool take(std::string_view text, const Place& place);
  std::string citation() const;
  /// Depth of the hypocentre in km: DEP, or HypZ if DEP is absent.
  std::optional<double> hypocentre_depth() const;

 private:
  bool take_geometry(std::string_view label, std::string_view rest, const Place& place);
};

// Velocity table (fsp_layers.cpp)

/// The table VELOCITY-DENSITY STRUCTURE: either layers, or only an assumed shear modulus.
class VelocityTable {
 public:
  void take(std::string_view text, const Place& place);
  /// Sets the elastic constants at a depth in km. Adds a warning if the table does not give them.
  void fill(std::optional<double> depth, Observation& out) const;
  /// Whether the layer at a depth in km is water, which has no rigidity.
  bool is_water_at(double depth) const;
  /// All layers of rock, downwards. There are none if the table is not usable.
  std::vector<RockLayer> rock() const;

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

/// An angle in degrees, unless it is a placeholder. A dip must be above 0 and at most 90.
std::optional<double> angle_of(std::string_view text, std::string_view key, const Place& place);
std::optional<double> dip_of(std::string_view text, std::string_view key, const Place& place);

// Subfault tables (fsp_table.cpp, and fsp_fault.cpp for their geometry)

/// Slip of the subfaults. The reader sums it over each segment row by row.
class SubfaultTables {
 public:
  static bool is_heading(const Words& words);

  void take_segment_line(std::string_view text, const Place& place);
  void take_keys(std::string_view text, const Place& place);
  void take_heading(const Words& names, const Place& place);
  void take_row(const Words& row, const Place& place);

  bool empty() const { return segments_.empty(); }
  bool awaits_heading() const { return announced_ > 0; }
  /// \throws InputError if a table is incomplete.
  void check(const Header& header, const Place& end, std::vector<std::string>& warnings) const;
  /// Mean slip in m, weighted by the areas of the subfaults.
  double mean_slip(const Header& header, std::vector<std::string>& warnings) const;
  /// The single rows of those segments that give X, Y and Z.
  const std::vector<Subfault>& subfaults() const { return subfaults_; }
  /// Mean of column RISE in s, weighted by slip, over the rows that give both. Adds where it comes from to the
  /// warnings.
  std::optional<double> mean_rise_time(std::vector<std::string>& warnings) const;
  /// Removes the slip of a row of subfaults() from all means.
  void leave_out(std::size_t row);
  /// The segments with their subfaults, and the decisions about positions.
  void fill(const Header& header, FaultModel& out) const;

 private:
  struct Segment {
    std::optional<double> strike, dip, top;  ///< degrees, and km
    bool x_is_north = false;
    std::optional<std::size_t> rake_column;
    std::size_t latitude_column = 0, longitude_column = 0;
    std::vector<FaultPatch> patches;  ///< positions as the file gives them

    std::optional<std::size_t> stated_rows;
    std::optional<double> length, width, dx, dz;  ///< km
    std::size_t columns = 0, slip_column = 0;
    std::optional<std::size_t> rise_column, time_column, x_column, y_column, z_column;
    std::size_t line = 0, rows = 0, rows_with_slip = 0, rows_left_out = 0;
    double slip = 0, slip_with_rise = 0, slip_times_rise = 0;

    std::optional<double> area(const Header& header) const;
  };

  void add_slip(Segment& segment, const std::vector<double>& values);
  void keep_subfault(Segment& segment, const std::vector<double>& values);
  static FaultSegment geometry_of(const Segment& table, const Header& header, bool exchanged);
  void check_rows(std::size_t index, const Header& header, const Place& end, std::vector<std::string>& warnings) const;
  std::string label(std::size_t index) const;

  std::vector<Segment> segments_;
  std::vector<Subfault> subfaults_;
  Segment next_;                ///< the segment whose line of column names is still to come
  std::size_t announced_ = 0;   ///< line number of its `SEGMENT #`; 0 if there was none
  std::size_t stray_rows_ = 0;  ///< rows that hold words other than numbers
  std::size_t negative_rows_ = 0;
  std::size_t rows_without_slip_ = 0;
  std::size_t slipping_rows_ = 0, rows_with_rise_ = 0;  ///< with slip > 0, and those of them that have a rise time
  std::size_t long_rises_ = 0, late_rows_ = 0;          ///< values of RISE and TRUP that count as placeholders
};

}  // namespace slipfront::catalogue::fsp
