#pragma once
/// \file
/// One model from the subfaults of any format. A reader fills a table of rows in SI units, and `model_of` finds
/// segments, rows and means. Private to src/events/catalogue.
///
/// Titles of the columns of subfaults, in any format that has columns.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/fault_model.hpp"
#include "math/constants.hpp"

namespace slipfront::catalogue::subfaults {

/// A subfault as its file gives it, in SI units and degrees. A value that the file does not give is NaN.
struct Row {
  std::size_t line = 0;
  double segment = none;
  double longitude = none, latitude = none, depth = none;
  double length = none, width = none, area = none;
  double strike = none, dip = none, rake = none;
  double slip = none, strike_slip = none, dip_slip = none;  ///< `dip_slip` is positive up dip
  double rupture_time = none, rise_time = none, fall_time = none;
  double moment = none, shear_modulus = none, density = none, s_wave_speed = none;
};

/// Numbers of subfaults of a segment. The file gives them row by row.
struct Grid {
  std::size_t along_strike = 0, down_dip = 0;
};

struct Table {
  std::string file = {};
  std::string format = {};  ///< for messages, such as "SRF 2.0"
  std::string name = {};    ///< name of the event, by default that of the file
  std::vector<Row> rows = {};
  std::vector<Grid> grids = {};  ///< by segment; a segment without one is sorted by depth
  bool tops = false;             ///< positions are the middles of upper edges instead of centres
  double longitude = none, latitude = none, depth = none;  ///< hypocentre, in degrees and m
  std::vector<std::string> notes = {};
};

/// The model. Subfaults at one position, such as the time windows of an inversion, are joined. Without a hypocentre it
/// is the centre of the subfault that slips first. \throws InputError for values out of range.
FaultModel model_of(Table&& table);

/// A format: how to recognise and how to read it. `read` throws InputError.
struct FaultFormat {
  bool (*looks_like)(std::string_view text);
  Table (*read)(std::string_view text, const std::string& file);
};
extern const FaultFormat srf_format, geojson_format, param_format, rupt_format, csv_format;

/// Units of the numbers whose title has none.
enum class Units { si, param };  ///< m, s, Pa; or km, cm and dyn cm

/// A column: the member of a row that it gives, or null, and the factor to SI units.
struct Column {
  double Row::*member = nullptr;
  double factor = 1;
};

/// Reads a title such as "depth", "z(km)" or "length [km]".
Column column_of(std::string_view title, Units units);

/// Reads a number. \throws InputError for a word that is none; NaN for a placeholder.
double number_in(std::string_view word, const std::string& file, std::size_t line);

/// One row of numbers. \throws InputError for another number of cells than columns.
Row row_of(const std::vector<std::string_view>& cells, const std::vector<Column>& columns, const std::string& file,
           std::size_t line);

}  // namespace slipfront::catalogue::subfaults
