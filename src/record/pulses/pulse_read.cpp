#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "record/files/seal.hpp"
#include "record/files/text_file.hpp"
#include "record/netcdf/netcdf.hpp"
#include "record/pulses/pulse_file.hpp"
#include "record/pulses/pulse_layout.hpp"
#include "record/pulses/pulse_variables.hpp"
#include "slipfront/error.hpp"

namespace slipfront::record {
namespace {

using netcdf::Reader;
using netcdf::Variable;
using Kind = Variable::Kind;
using Shape = std::vector<std::size_t>;
using output::Snapshot;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw FileError(path + ": not a pulse file to resume from: " + reason);
}

/// Reads a sealed file. The seal shows that slipfront wrote it, but not in which format and whether it holds a pulse.
class PulseReader {
 public:
  PulseReader(const std::string& path, const Reader& file) : path_(path), file_(file) {
    if (const std::string format = text("slipfront_format"); format != pulse_format)
      fail(path_, "its slipfront_format is '" + format.substr(0, 40) + "'; this version reads '" + pulse_format + "'");
    times_ = require_rank("time", 1).shape[0];
    cells_ = require_rank("x", 1).shape[0];
  }

  Checkpoint read() {
    Checkpoint run{scenario(), text("version"), bytes(require(layout::solver_state)), times(), finished()};
    for (const output::Scalar& scalar : output::scalars()) read_scalar(scalar, run.snapshots);
    const std::vector<const FieldVariable*> written = fields();
    for (const auto values : profile_fields())
      if (const FieldVariable* field = holder(written, values)) read_field(*field, run.snapshots);
    if (text("checksum") != layout::checksum(run.scenario_text, run.solver_state, run.finished, run.snapshots, written))
      fail(path_, "the checksum of its content does not match");
    return run;
  }

 private:
  std::string text(const char* attribute) const {
    auto value = file_.text(attribute);
    if (!value) fail(path_, "attribute " + std::string(attribute) + " is missing");
    return *std::move(value);
  }

  std::string scenario() const {
    const auto variable = file_.find(layout::scenario_bytes);
    return variable ? bytes(*variable) : text("scenario");
  }

  bool finished() const {
    const auto value = file_.number("finished");
    if (!value || (*value != 0 && *value != 1)) fail(path_, "attribute finished is neither 0 nor 1");
    return *value == 1;
  }

  Variable require(const std::string& name) const {
    auto variable = file_.find(name);
    if (!variable) fail(path_, "variable " + name + " is missing");
    return *std::move(variable);
  }

  Variable require_rank(const std::string& name, std::size_t rank) const {
    Variable variable = require(name);
    if (variable.kind != Kind::real || variable.shape.size() != rank)
      fail(path_, name + " has the wrong type or shape");
    return variable;
  }

  Variable require_shape(std::string_view name, const Shape& shape) const {
    Variable variable = require_rank(std::string(name), shape.size());
    if (variable.shape != shape) fail(path_, variable.name + " has the wrong size");
    return variable;
  }

  std::string bytes(const Variable& variable) const {
    if (variable.kind != Kind::byte || variable.shape.size() != 1)
      fail(path_, variable.name + " has the wrong type or shape");
    return file_.bytes(variable);
  }

  /// Returns snapshots in which only the times are set.
  std::vector<Snapshot> times() const {
    const std::vector<double> times = file_.reals(require_shape("time", {times_}));
    std::vector<Snapshot> snapshots(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1])) fail(path_, "its times do not ascend");
      snapshots[i].time = times[i];
    }
    return snapshots;
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

  void read_field(const FieldVariable& field, std::vector<Snapshot>& snapshots) const {
    const Variable variable = require_shape(field.about.name, {times_, cells_});
    file_.require_reals(variable);
    for (std::size_t i = 0; i < times_; ++i) {
      auto& values = snapshots[i].profile.*field.values;
      values.resize(cells_);
      file_.read_row(variable, i, values);
    }
  }

  const std::string& path_;
  const Reader& file_;
  std::size_t times_ = 0, cells_ = 0;
};

}  // namespace

Checkpoint read_checkpoint(const std::string& path) {
  const std::string file = read_regular(path);
  const std::string_view image = sealed_content(file, path);
  return PulseReader(path, Reader(path, image, image.size())).read();
}

Checkpoint read_checkpoint_of(const std::string& path, const std::string& version) {
  Checkpoint saved = read_checkpoint(path);
  if (saved.version != version)
    throw InputError(
        {.file = path, .key = "resume", .problem = "was written by another version", .allowed = "version " + version});
  return saved;
}

}  // namespace slipfront::record
