#include "runs/record/run_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "math/constants.hpp"
#include "runs/record/arrays.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "system/files/whole_file.hpp"

namespace slipfront::record {
namespace {

using output::Profile;
using output::Snapshot;

constexpr std::vector<double> Profile::*every_field[] = {&Profile::k, &Profile::U,    &Profile::W,
                                                         &Profile::H, &Profile::slip, &Profile::trains};

constexpr FieldVariable every_variable[] = {
    {{"k", "dislocation density (2 pi times dislocations per length)", "A / b", "Eqs. 4-5"}, &Profile::k},
    {{"Sigma", "shear stress, averaged over a period of the train (equal to k)", "mu A / pi", "Eq. 5"}, &Profile::k},
    {{"U", "velocity of the dislocations", "c", "Eq. 4"}, &Profile::U},
    {{"W", "slip velocity, averaged over a period of the train", "c A / pi", "Eq. 5"}, &Profile::W},
    {{"H", "energy density", "mu A^2 b / (2 pi^2 (1 - nu))", "Eq. 6"}, &Profile::H},
    {{"slip", "slip since time 0", "b / (2 pi)", "Eq. 4"}, &Profile::slip},
    {{"stress_drop", "Sigma at the first time less Sigma", "mu A / pi", "Eq. 5"}, &Profile::k, true},
    {{"trains", "number of trains of dislocations at the same position", "", "docs/theory/9_trains.md"},
     &Profile::trains,
     false,
     true},
};

}  // namespace

std::vector<double> FieldVariable::of(const Snapshot& snapshot, const Snapshot& first) const {
  std::vector<double> row = snapshot.profile.*values;
  for (std::size_t i = 0; drop && i < row.size(); ++i) row[i] = (first.profile.*values)[i] - row[i];
  return row;
}

std::span<const FieldVariable> field_variables() { return every_variable; }

std::span<std::vector<double> Profile::*const> profile_fields() { return every_field; }

std::vector<const FieldVariable*> chosen_fields(const std::vector<std::string>& names) {
  std::string known;
  for (const FieldVariable& field : every_variable)
    known += (known.empty() ? "" : ", ") + std::string(field.about.name);
  for (const std::string& name : names)
    if (std::none_of(std::begin(every_variable), std::end(every_variable),
                     [&](const auto& field) { return field.about.name == name; }))
      throw InputError({.key = "output.variables", .value = name, .problem = "unknown variable", .allowed = known});

  const auto named = [&](std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  const bool drop_alone = named("stress_drop") && !named("k") && !named("Sigma");
  std::vector<const FieldVariable*> chosen;
  for (const FieldVariable& field : every_variable)
    if ((names.empty() && !field.on_request) || named(field.about.name) || (drop_alone && field.about.name == "Sigma"))
      chosen.push_back(&field);
  return chosen;
}

const FieldVariable* holder(const std::vector<const FieldVariable*>& written, std::vector<double> Profile::*values) {
  for (const FieldVariable* field : written)
    if (field->values == values && !field->drop) return field;
  return nullptr;
}

void write_run(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
               const std::string& state, bool finished) {
  const std::string& scenario = metadata.scenario_text;
  const Attributes by = {{"references", "slipfront, src/runs/record"}};
  Dataset file = dataset_of(arrays, metadata, finished);
  file.add_opaque(layout::solver_state, "state of the run, to resume it", state, by);
  if (clean_text(scenario, netcdf::longest_text) != scenario)  // else its attribute has every byte
    file.add_opaque(layout::scenario_bytes, "the scenario, byte by byte", scenario, by);
  write_dataset(path, file);
}

std::vector<std::string> pulse_variables() {
  std::vector<std::string> names;
  for (const FieldVariable& field : field_variables()) names.emplace_back(field.about.name);
  return names;
}

void write_comparison(const std::string& path, const RunMetadata& metadata, const std::vector<Array>& arrays,
                      const std::vector<Level>& levels, bool finished) {
  Dataset file = dataset_of(arrays, metadata, finished);
  for (DatasetVariable& variable : file.variables)
    if (variable.dimensions.front() == "level" && variable.dimensions.size() > 1)
      variable.attributes.emplace_back("coordinates", "name scale");
  std::vector<std::string> names;
  names.reserve(levels.size());
  for (const Level& level : levels) names.push_back(level.name);
  file.variables.push_back({"name", {"level"}, names, {{"long_name", "level of theory"}}});
  write_dataset(path, file);
}

namespace {

using netcdf::Reader;
using netcdf::Variable;
using Kind = Variable::Kind;
using Shape = std::vector<std::size_t>;
using output::Snapshot;

/// Gives each snapshot its lines.
void add_lines(const plane::LinePoints& points, std::vector<plane::Field>& snapshots) {
  const std::size_t size = points.x.size();
  std::size_t i = 0;
  for (plane::Field& snapshot : snapshots)
    while (i < size && points.time[i] == snapshot.time) {
      plane::Line line{.number = static_cast<int>(points.number[i]), .points = {}};
      for (; i < size && !std::isnan(points.x[i]); ++i) line.points.push_back({points.x[i], points.y[i]});
      ++i;
      snapshot.lines.push_back(std::move(line));
    }
}

/// Reads a sealed file. The seal shows that slipfront wrote it, but not in which format and of which kind of run.
class CheckpointReader {
 public:
  CheckpointReader(const std::string& path, const Reader& file, const std::string& format)
      : path_(path), file_(file), kind_(format == pulse_format ? "a pulse file" : "a file of a plane") {
    if (const std::string found = text("slipfront_format"); found != format)
      fail("its slipfront_format is '" + found.substr(0, 40) + "'; this version reads '" + format + "'");
    times_ = require_rank("time", 1).shape[0];
    cells_ = require_rank("x", 1).shape[0];
  }

  Checkpoint read_pulse() const {
    Checkpoint run = read();
    for (const double time : times()) run.snapshots.emplace_back().time = time;
    for (const output::Scalar& scalar : output::scalars()) read_scalar(scalar, run.snapshots);
    const std::vector<const FieldVariable*> written = fields();
    for (const auto values : profile_fields())
      if (const FieldVariable* field = holder(written, values))
        read_rows(
            field->about.name,
            {times_, cells_}, [&](std::size_t i) -> auto& { return run.snapshots[i].profile.*field->values; });
    read_displacement(run.snapshots);
    read_dislocations(run.snapshots);
    return run;
  }

  Checkpoint read_plane() const {
    Checkpoint run = read();
    const std::size_t rows = require_rank("y", 1).shape[0];
    for (const double time : times())
      run.fields.push_back(
          {.time = time, .nx = static_cast<int>(cells_), .ny = static_cast<int>(rows), .slip = {}, .velocity = {}});
    for (const MemberArray<plane::Field>& field : plane::field_arrays())
      read_rows(
          field.about.name,
          {times_, rows, cells_}, [&](std::size_t i) -> auto& { return run.fields[i].*field.values; });
    add_lines(points_of_lines(), run.fields);
    return run;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw FileError(path_ + ": not " + kind_ + " to resume from: " + reason);
  }

  /// Everything but the snapshots.
  Checkpoint read() const {
    return {.scenario_text = scenario(),
            .version = text("version"),
            .solver_state = bytes(require(layout::solver_state)),
            .finished = finished()};
  }

  std::string text(const char* attribute) const {
    auto value = file_.text(attribute);
    if (!value) fail("attribute " + std::string(attribute) + " is missing");
    return *std::move(value);
  }

  std::string scenario() const {
    const auto variable = file_.find(layout::scenario_bytes);
    return variable ? bytes(*variable) : text("scenario");
  }

  bool finished() const {
    const auto value = file_.number("finished");
    if (!value || (*value != 0 && *value != 1)) fail("attribute finished is neither 0 nor 1");
    return *value == 1;
  }

  Variable require(const std::string& name) const {
    auto variable = file_.find(name);
    if (!variable) fail("variable " + name + " is missing");
    return *std::move(variable);
  }

  Variable require_rank(const std::string& name, std::size_t rank) const {
    Variable variable = require(name);
    if (variable.kind != Kind::real || variable.shape.size() != rank) fail(name + " has the wrong type or shape");
    return variable;
  }

  Variable require_shape(std::string_view name, const Shape& shape) const {
    Variable variable = require_rank(std::string(name), shape.size());
    if (variable.shape != shape) fail(variable.name + " has the wrong size");
    return variable;
  }

  std::string bytes(const Variable& variable) const {
    if (variable.kind != Kind::byte || variable.shape.size() != 1) fail(variable.name + " has the wrong type or shape");
    return file_.bytes(variable);
  }

  std::vector<double> times() const {
    std::vector<double> times = file_.reals(require_shape("time", {times_}));
    for (std::size_t i = 0; i < times.size(); ++i)
      if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) fail("its times do not ascend");
    return times;
  }

  void read_scalar(const output::Scalar& scalar, std::vector<Snapshot>& snapshots) const {
    const std::vector<double> values = file_.reals(require_shape(scalar.about.name, {times_}));
    for (std::size_t i = 0; i < times_; ++i) scalar.set(snapshots[i], values[i]);
  }

  std::vector<const FieldVariable*> fields() const {
    std::vector<const FieldVariable*> found;
    for (const FieldVariable& field : field_variables())
      if (file_.find(std::string(field.about.name))) found.push_back(&field);
    return found;
  }

  /// Reads a variable over time and other dimensions. `row(i)` is the vector for the i-th time.
  template <class Row>
  void read_rows(std::string_view name, const Shape& shape, const Row& row) const {
    const Variable variable = require_shape(name, shape);
    file_.require_reals(variable);
    const std::size_t size = std::accumulate(shape.begin() + 1, shape.end(), std::size_t{1}, std::multiplies<>());
    for (std::size_t i = 0; i < times_; ++i) {
      row(i).resize(size);
      file_.read_row(variable, i, row(i));
    }
  }

  void read_displacement(std::vector<Snapshot>& snapshots) const {
    const auto sites = file_.find(std::string(layout::site.name));
    if (!sites) return;
    read_rows(
        layout::displacement.name, {times_, require_rank(sites->name, 1).shape[0]}, [&](std::size_t i) -> auto& {
          return snapshots[i].displacement;
        });
  }

  void read_dislocations(std::vector<Snapshot>& snapshots) const {
    const auto numbers = file_.find(std::string(layout::dislocation.name));
    if (!numbers) return;
    const std::size_t count = require_rank(numbers->name, 1).shape[0];
    const std::vector<double> signs = file_.reals(require_shape(layout::dislocation_sign.name, {count}));
    std::vector<std::vector<double>> x(times_), level(times_);
    read_rows(
        layout::dislocation_position.name, {times_, count}, [&](std::size_t i) -> auto& { return x[i]; });
    read_rows(
        layout::dislocation_level.name, {times_, count}, [&](std::size_t i) -> auto& { return level[i]; });
    for (std::size_t i = 0; i < times_; ++i) {
      for (std::size_t j = 0; j < count; ++j)
        if (!std::isnan(x[i][j]))
          snapshots[i].dislocations.push_back({x[i][j], signs[j] > 0 ? 1 : -1, std::lround(level[i][j])});
      output::sort(snapshots[i].dislocations);
    }
  }

  plane::LinePoints points_of_lines() const {
    plane::LinePoints points;
    for (const MemberArray<plane::LinePoints>& line : plane::line_arrays())
      if (const auto variable = file_.find(std::string(line.about.name))) points.*line.values = file_.reals(*variable);
    for (const MemberArray<plane::LinePoints>& line : plane::line_arrays())
      if ((points.*line.values).size() != points.x.size()) fail("the points of lines have different sizes");
    return points;
  }

  const std::string& path_;
  const Reader& file_;
  const char* kind_;
  std::size_t times_ = 0, cells_ = 0;
};

}  // namespace

Checkpoint read_checkpoint(const std::string& path, const std::string& format) {
  const std::string file = read_regular(path);
  const std::string_view image = sealed_content(file, path);
  const Reader netcdf(path, image, image.size());
  const CheckpointReader reader(path, netcdf, format);
  return format == pulse_format ? reader.read_pulse() : reader.read_plane();
}

}  // namespace slipfront::record
