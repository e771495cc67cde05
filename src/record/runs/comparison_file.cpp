#include "record/runs/comparison_file.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "foundation/math/constants.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/runs/arrays.hpp"
#include "record/runs/cf.hpp"
#include "record/runs/run_variables.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;
using output::Snapshot;
using ComparedLevels = std::vector<ComparedLevel>;

/// Names as rows of equal length: what CF calls a label.
struct Labels {
  std::size_t width = 1;
  std::string text;
};
Labels labels_of(const ComparedLevels& levels) {
  Labels labels;
  for (const ComparedLevel& level : levels) labels.width = std::max(labels.width, level.name.size());
  for (const ComparedLevel& level : levels) {
    labels.text += level.name;
    labels.text.append(labels.width - level.name.size(), '\0');
  }
  return labels;
}

/// All of the file.
void fill(Writer& file, const RunMetadata& metadata, const std::vector<double>& times, const ComparedLevels& levels,
          bool finished) {
  const Labels labels = labels_of(levels);
  Levels snapshots;
  std::vector<double> scales;
  for (const ComparedLevel& level : levels) {
    snapshots.push_back(&level.snapshots);
    scales.push_back(level.scale.value_or(none));
  }
  std::vector<Array> arrays = arrays_of(metadata, times, snapshots);
  for (Array& array : arrays)
    if (array.dimensions.front().name == "level") array.attributes.emplace_back("coordinates", "name scale");
  arrays.push_back({output::scale_factor, {{"level", levels.size()}}, [scales] { return scales; }, {}});
  cf::describe_file(file, metadata, comparison_format, finished);
  const Defined defined = define(file, arrays, metadata);
  const int name = file.characters("name", {defined.dimensions.at("level"), file.dimension("letters", labels.width)});
  file.attribute(name, "long_name", "level of theory");
  file.end_definitions();
  if (!levels.empty()) file.write_all(name, labels.text);  // a dimension of size 0 is an unlimited one
  write(file, defined, arrays);
}

}  // namespace

void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<double>& times,
                      const ComparedLevels& levels, bool finished) {
  const auto fields = chosen_fields(metadata.variables);
  const std::size_t cells = metadata.x_edges.size() - 1;
  for (const ComparedLevel& level : levels) {
    if (level.snapshots.size() != times.size())
      throw std::invalid_argument("write_comparison: a level is not finished");
    for (const Snapshot& snapshot : level.snapshots)
      for (const FieldVariable* field : fields)
        if ((snapshot.profile.*field->values).size() != cells)
          throw std::invalid_argument("write_comparison: a profile has not as many cells as x");
  }
  write_netcdf(path, 0, [&](Writer& file) { fill(file, metadata, times, levels, finished); });
}

}  // namespace slipfront::record
