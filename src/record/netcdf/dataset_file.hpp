#pragma once
/// \file
/// NetCDF files of any content: what Python writes of sweeps and figures.

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

}  // namespace slipfront::record
