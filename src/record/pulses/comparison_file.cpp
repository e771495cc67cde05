#include "record/pulses/comparison_file.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "foundation/math/constants.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/pulses/cf.hpp"
#include "record/pulses/pulse_variables.hpp"

namespace slipfront::record {
namespace {

using netcdf::Writer;
using output::Snapshot;
using Levels = std::vector<ComparedLevel>;

/// A value of every snapshot, level by level.
std::vector<double> over_time(const Levels& levels, const output::Scalar& variable) {
  std::vector<double> values;
  for (const ComparedLevel& level : levels)
    for (const Snapshot& snapshot : level.snapshots) values.push_back(variable.get(snapshot));
  return values;
}

/// And of every cell.
std::vector<double> over_time_and_x(const Levels& levels, const FieldVariable& variable) {
  std::vector<double> values;
  for (const ComparedLevel& level : levels)
    for (const Snapshot& snapshot : level.snapshots) {
      const std::vector<double> row = variable.of(snapshot, level.snapshots.front());
      values.insert(values.end(), row.begin(), row.end());
    }
  return values;
}

/// Names as rows of equal length: what CF calls a label.
struct Labels {
  std::size_t width = 1;
  std::string text;
};
Labels labels_of(const Levels& levels) {
  Labels labels;
  for (const ComparedLevel& level : levels) labels.width = std::max(labels.width, level.name.size());
  for (const ComparedLevel& level : levels) {
    labels.text += level.name;
    labels.text.append(labels.width - level.name.size(), '\0');
  }
  return labels;
}

/// All of the file.
void fill(Writer& file, const PulseMetadata& metadata, const std::vector<double>& times, const Levels& levels,
          bool finished, const std::vector<const FieldVariable*>& fields) {
  const std::size_t cells = metadata.x_edges.size() - 1;
  const Labels labels = labels_of(levels);
  cf::describe_file(file, metadata, comparison_format, finished);
  const int level = file.dimension("level", levels.size()), letters = file.dimension("letters", labels.width);
  const int name = file.characters("name", {level, letters});
  file.attribute(name, "long_name", "level of theory");
  const int scale = cf::reals(file, output::scale_factor, {level}, metadata);
  file.fill_value(scale, none);
  const cf::Axes axes = cf::axes(file, times.size(), cells, metadata);
  std::vector<int> field_ids, scalar_ids;
  const auto add = [&](const Description& about, const std::vector<int>& dimensions) {
    const int id = cf::reals(file, about, dimensions, metadata);
    file.fill_value(id, none);
    file.attribute(id, "coordinates", "name scale");
    return id;
  };
  for (const FieldVariable* field : fields) field_ids.push_back(add(field->about, {level, axes.time, axes.x}));
  for (const output::Scalar& scalar : output::scalars()) scalar_ids.push_back(add(scalar.about, {level, axes.time}));
  file.end_definitions();

  cf::write_axes(file, axes, times, metadata.x_edges);
  std::vector<double> scales;
  for (const ComparedLevel& l : levels) scales.push_back(l.scale.value_or(none));
  if (!levels.empty()) {  // a dimension of size 0 is an unlimited one
    file.write_all(name, labels.text);
    file.write(scale, scales);
    for (std::size_t i = 0; i < fields.size(); ++i) file.write_all(field_ids[i], over_time_and_x(levels, *fields[i]));
    for (std::size_t i = 0; i < scalar_ids.size(); ++i)
      file.write_all(scalar_ids[i], over_time(levels, output::scalars()[i]));
  }
}

}  // namespace

void write_comparison(const std::string& path, const PulseMetadata& metadata, const std::vector<double>& times,
                      const Levels& levels, bool finished) {
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
  write_netcdf(path, 0, [&](Writer& file) { fill(file, metadata, times, levels, finished, fields); });
}

}  // namespace slipfront::record
