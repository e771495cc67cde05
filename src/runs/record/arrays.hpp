#pragma once
/// \file
/// The variables of a result, as files and Python hold them, and the parts that the CF-1.10 conventions require of all
/// files.

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "runs/record/netcdf/netcdf.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/description.hpp"
#include "slipfront/lattice/plane/run.hpp"

namespace slipfront::record::cf {

/// Defines a variable of numbers and its attributes, in the units of `metadata`. Returns its id.
int reals(netcdf::Writer& file, const Description& about, const std::vector<int>& dimensions,
          const RunMetadata& metadata);

/// Writes the attributes of the file. The number in `format` increases when old readers would fail. A scenario that no
/// attribute can hold is cleaned and truncated.
void describe_file(netcdf::Writer& file, const RunMetadata& metadata, const char* format, bool finished);

}  // namespace slipfront::record::cf

namespace slipfront::record {

struct Array {
  struct Dimension {
    std::string_view name;
    std::size_t size;
  };
  Description about;
  std::vector<Dimension> dimensions;
  std::function<std::vector<double>()> values;                            ///< row by row
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< further ones, by the CF conventions
};

/// A coordinate: its name is that of its dimension.
Array coordinate(const Description& about, std::vector<double> values, std::string_view axis = {});

/// One series of snapshots for each level of theory.
using Levels = std::vector<const std::vector<output::Snapshot>*>;

/// The variables of a run along a line, or of a comparison `by_level`, where "level" is the first dimension. They refer
/// to the arguments. \throws InputError if the metadata has an unknown variable.
std::vector<Array> arrays_of(const RunMetadata& metadata, const std::vector<output::Snapshot>& snapshots);
std::vector<Array> arrays_of(const RunMetadata& metadata, const std::vector<double>& times, const Levels& levels,
                             bool by_level = true);

/// The variables of a run on a plane, which must outlive them.
std::vector<Array> arrays_of(const plane::Run& run);

/// The values of all items, one after the other. `get` returns the number or the vector of one, or is such a member.
template <class Items, class Get>
std::function<std::vector<double>()> values_of(const Items& items, Get get) {
  return [&items, get] {
    std::vector<double> values;
    for (const auto& item : items) {
      const auto& one = std::invoke(get, item);
      if constexpr (std::is_same_v<decltype(one), const double&>) {
        values.push_back(one);
      } else {
        if (values.empty()) values.reserve(items.size() * one.size());
        values.insert(values.end(), one.begin(), one.end());
      }
    }
    return values;
  };
}

/// The ids of dimensions by their names, and those of variables.
struct Defined {
  std::map<std::string_view, int> dimensions;
  std::vector<int> variables;
};
Defined define(netcdf::Writer& file, const std::vector<Array>& arrays, const RunMetadata& metadata);
/// Writes the values of arrays that `define` has defined.
void write(netcdf::Writer& file, const Defined& defined, const std::vector<Array>& arrays);

/// Writes the file of a run, completely or not at all, with its saved state. On a plane there is no `checksum`. \throws
/// FileError (one line: path and reason).
void write_run(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
               const std::string& state, bool finished, const std::string& checksum = {});

}  // namespace slipfront::record
