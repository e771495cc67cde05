#pragma once
/// \file
/// NetCDF files of any content, which Python writes of sweeps and figures, and tables from separate files: initial
/// profiles and friction laws.

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace slipfront::record {

using AttributeValue = std::variant<std::string, std::int64_t, double>;
using Attributes = std::vector<std::pair<std::string, AttributeValue>>;

struct DatasetVariable {
  std::string name;
  std::vector<std::string> dimensions;
  /// As many as the dimensions hold, the last dimension fastest.
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::int8_t>, std::vector<std::string>>
      values;
  Attributes attributes;  ///< _FillValue is that of a variable of doubles
};

struct Dataset {
  std::vector<std::pair<std::string, std::size_t>> dimensions;
  std::vector<DatasetVariable> variables;
  Attributes attributes;
};

/// Writes `path` whole or not at all. \throws FileError (one line: path and reason), std::invalid_argument where a
/// variable has not as many values as its dimensions say, or a dimension that is none of `dataset`.
void write_dataset(const std::string& path, const Dataset& dataset);

/// Reads the rows of some columns, at least one, in the order of the file; all numbers are finite. The extension of
/// `path` gives the format. A .csv file has a header line with columns of these names; other columns are ignored. A .nc
/// file (any NetCDF) has one-dimensional variables of these names and of equal length. Three columns may also be two
/// coordinates and a variable over the second and the first of them, such as slip(y, x). The caller checks the order
/// and the signs. \throws FileError if the file cannot be read, InputError (file, line, key, value, allowed) if its
/// content is wrong.
std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns);

}  // namespace slipfront::record
