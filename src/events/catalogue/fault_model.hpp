#pragma once
/// \file
/// The geometry, rock and slip of a finite-fault model, subfault by subfault, for files that describe a source.
///
/// Rows and columns of the subfaults of a segment, whatever the format of their file.

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/events/catalogue/observation.hpp"

namespace slipfront::catalogue {

/// Length of one degree on a sphere of radius 6371 km.
inline constexpr double m_per_degree = 111194.9266;

/// A layer of rock, in SI units, from its depth `top` to that of the next layer.
struct RockLayer {
  double top, p_wave_speed, s_wave_speed, density;
};

/// A subfault. Positions are those of its centre. A value is absent if its column is missing or holds a placeholder.
struct FaultPatch {
  double longitude = 0, latitude = 0;     ///< degrees
  double east = 0, north = 0, depth = 0;  ///< m, from the epicentre at the surface; depth is positive downwards
  double slip = 0;                        ///< m, as written
  std::optional<double> strike = {}, dip = {}, rake = {};  ///< degrees; strike and dip by default of the segment
  std::optional<double> rise_time = {};                    ///< s
  std::optional<double> rupture_time = {};                 ///< s, as written; it may be negative
  std::optional<double> area = {};                         ///< m^2; by default that of all subfaults of the segment
  std::optional<double> shear_modulus = {};                ///< Pa; by default that of `FaultModel::rock`
  std::optional<double> density = {};                      ///< kg/m^3
  std::size_t row = 0;                                     ///< index in Observation::subfaults
};

/// A planar segment.
struct FaultSegment {
  std::size_t line = 0;               ///< line of its column names
  std::optional<double> strike, dip;  ///< degrees
  /// Size of a subfault in m. Their product is the area that `Observation::slip` uses.
  std::optional<double> cell_length, cell_width;
  /// Numbers of subfaults. They are 0 if the subfaults do not form rows of equal depth and equal length.
  std::size_t along_strike = 0, down_dip = 0;
  /// By row, from the top down, and in each row in the direction of strike. In the order of the file if there is no
  /// grid.
  std::vector<FaultPatch> patches;
};

/// A finite-fault model as its file gives it.
struct FaultModel {
  Observation observation;
  std::vector<FaultSegment> segments;      ///< empty if the file does not give positions (X, Y, Z)
  std::vector<RockLayer> rock;             ///< downwards, without water; empty if there is no usable velocity table
  std::optional<double> rake;              ///< degrees, for subfaults without their own
  std::optional<double> hypocentre_depth;  ///< m; the epicentre is the origin of the positions
  std::optional<double> moment;            ///< N m, as the header states it
  std::vector<std::string> notes;          ///< decisions about the positions, one line each
};

/// Whether the text is a finite-fault model in one of the formats that read_fault_model reads.
bool is_fault_model(std::string_view text);

/// Reads a model: .fsp, SRF, GeoJSON or .param of the USGS, .rupt of MudPy, or CSV of subfaults. The text decides
/// which. A text of none of them is read as .fsp. \throws InputError.
FaultModel read_fault_model(std::string_view text, const std::string& file);

/// Sets the slip of an observation in m, and its slip velocity if the rise time in s is known. Adds a warning for what
/// is not positive or out of range.
void give_slip(Observation& observation, double slip, std::optional<double> rise_time);

/// Computes `Subfault::moment_share` of all subfaults. Without shear moduli that is uniform, and without
/// sizes the areas are equal. Returns the moment in N m; 0 without
/// shear moduli or sizes.
double share_moment(FaultModel& model);

/// The layer at a depth in m. Above the first layer it is the first. `rock` must not be empty.
const RockLayer& rock_at(const std::vector<RockLayer>& rock, double depth);

inline constexpr double least_gap = 10;  // m; depths that differ by less are one row, because files round positions

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Sorts the subfaults into rows of equal depth, and each row in the direction of strike. Returns the number of rows,
/// or 0 if the rows have different lengths.
std::size_t sort_into_rows(std::vector<FaultPatch>& patches, double strike);

/// Moves positions from the upper edges of subfaults to their centres.
void move_to_centres(FaultSegment& segment);

}  // namespace slipfront::catalogue
