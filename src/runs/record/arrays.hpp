#pragma once
/// \file
/// The variables of a result, as files and Python hold them, and the parts that the CF-1.10 conventions require of all
/// files.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "runs/record/netcdf/netcdf.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/description.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/text/output/dislocation_paths.hpp"

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

/// One level of theory in the file of a comparison.
struct Level {
  std::string name;
  double scale;  ///< NaN unless it is a chain
  const std::vector<output::Snapshot>* snapshots;
};

/// The variables of results. They refer to the run, or to the snapshots, which must outlive them. `variables` are names
/// of field_variables(), as chosen_fields takes them. \throws InputError for an unknown variable.
std::vector<Array> arrays_of(const pulse::Run& run, const std::vector<std::string>& variables);
std::vector<Array> arrays_of(const chain::Run& run, const std::vector<std::string>& variables);
/// On a plane, a file has all variables.
std::vector<Array> arrays_of(const plane::Run& run, const std::vector<std::string>& variables);
/// Each variable over "level" first. Every level has a snapshot at each time of the schedule.
std::vector<Array> arrays_of(const output::Schedule& schedule, const std::vector<std::string>& variables,
                             const std::vector<Level>& levels);
/// The variables of a run along a line, without slip events, sites and dislocations.
std::vector<Array> arrays_of(const std::vector<double>& x_edges, const std::vector<std::string>& variables,
                             const std::vector<output::Snapshot>& snapshots);
void add_displacement(std::vector<Array>& all, const std::vector<double>& sites,
                      const std::vector<output::Snapshot>& snapshots);
void add_dislocations(std::vector<Array>& all, const output::PathSettings& settings,
                      const std::vector<output::Snapshot>& snapshots);

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

/// The attributes of a variable, in the units of `metadata`.
Attributes attributes_of(const Description& about, const RunMetadata& metadata);

/// The content of a file. A scenario that no attribute can hold is cleaned and truncated there.
Dataset dataset_of(const std::vector<Array>& arrays, const RunMetadata& metadata, bool finished);

/// Writes the file of a run with its saved state. A file holds neither date nor host. \throws as write_dataset.
void write_run(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
               const std::string& state, bool finished);

/// Writes the file of a comparison in the same way.
void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
                      const std::vector<Level>& levels, bool finished);

}  // namespace slipfront::record
