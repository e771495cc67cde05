// The reader refuses files that are not valid pulse files, with a message of one line that gives the reason. Damage
// does not produce files with a valid seal and wrong content. We make such files with the library's own parts.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "pulse_sample.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "runs/record/run_file.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"
#include "temporary_folder.hpp"

namespace {

using slipfront::FileError;
using slipfront::record::netcdf::Writer;

std::string refusal(const std::string& path) {
  return message_of<FileError>([&] { slipfront::record::read_checkpoint(path); });
}

/// The reason in the message, after the path with which every message begins.
std::string refusal_of(const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.nc";
  write_bytes(path, bytes);
  const std::string message = refusal(path);
  EXPECT_EQ(message.substr(0, path.size() + 2), path + ": ");
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message.substr(std::min(message.size(), path.size() + 2));
}

std::string good_file() {
  const TemporaryFolder folder;
  write_pulse(folder / "a.nc", sample_metadata(), sample_snapshots(2, 3), sample_state(), false);
  return read_bytes(folder / "a.nc");
}

TEST(PulseDamage, RejectsMissingFilesFoldersAndDevices) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "none.nc").find("cannot be opened: No such file"), std::string::npos);
  EXPECT_NE(refusal(folder.path().string()).find("is a directory"), std::string::npos);
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is not a regular file");
}

TEST(PulseDamage, RejectsOtherFiles) {
  EXPECT_EQ(refusal_of(""), "the file is empty");
  EXPECT_EQ(refusal_of("title = \"a\"\n"), "not a NetCDF-4 file");
  EXPECT_EQ(refusal_of(std::string(5000, '\0')), "not a NetCDF-4 file");
  EXPECT_NE(refusal_of(std::string("\x89HDF\r\n\x1a\n")).find("has no seal"), std::string::npos);
  Writer other("other");
  other.dimension("y", 3);
  other.end_definitions();
  const auto image = other.finish();
  EXPECT_NE(refusal_of(std::string(image.bytes())).find("has no seal"), std::string::npos);
}

TEST(PulseDamage, RejectsTruncatedFiles) {
  const std::string file = good_file();
  for (std::size_t size = 0; size < file.size(); size += 1 + file.size() / 50)
    EXPECT_NE(refusal_of(file.substr(0, size)), "");
  EXPECT_NE(refusal_of(file.substr(0, file.size() - 1)).find("has no seal"), std::string::npos);
  EXPECT_NE(refusal_of(file + "x").find("has no seal"), std::string::npos);
}

TEST(PulseDamage, DetectsEveryChangedByte) {
  const std::string file = good_file();
  for (std::size_t at = 0; at < file.size(); at += 1 + file.size() / 300) {
    std::string damaged = file;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_NE(refusal_of(damaged), "") << at;
  }
}

/// The description of a file that is correct except for one change.
struct Form {
  std::string format = slipfront::record::pulse_format;
  int finished = 1;
  std::size_t times = 2, cells = 3;
  std::vector<double> time = {0, 1};
  std::function<bool(const std::string&)> left_out = [](const std::string&) { return false; };
  std::string wrong_shape = {}, wrong_type = {};
  std::size_t far_row = 0;  ///< row of the last field; everything before it is a hole that needs no disk space
};

std::string made(const Form& form) {
  Writer file("made");
  const auto text = [&](const std::string& name, const std::string& value) {
    if (!form.left_out(name)) file.attribute(Writer::global, name, value);
  };
  text("slipfront_format", form.format);
  text("scenario", "s");
  text("version", "1");
  if (!form.left_out("finished")) file.attribute(Writer::global, "finished", form.finished);
  const int time = file.dimension("time", form.times), x = file.dimension("x", form.cells);
  const int bytes = file.dimension("bytes", 4);
  int times = -1;
  const auto add = [&](const std::string& name, const std::vector<int>& dimensions) {
    if (form.left_out(name)) return -1;
    std::vector<int> shape = dimensions;
    if (name == form.wrong_shape) shape.push_back(bytes);
    return (name == "checkpoint") != (name == form.wrong_type) ? file.bytes(name, shape) : file.reals(name, shape);
  };
  times = add("time", {time});
  add("x", {x});
  int field_id = -1;
  for (const auto& field : slipfront::record::field_variables())
    field_id = add(std::string(field.about.name), {time, x});
  for (const auto& scalar : slipfront::output::scalars()) add(std::string(scalar.about.name), {time});
  add("checkpoint", {bytes});
  file.end_definitions();
  if (times >= 0 && form.wrong_shape != "time" && form.wrong_type != "time") file.write(times, form.time);
  if (form.far_row > 0) file.write_row(field_id, form.far_row, std::vector<double>(form.cells));
  const auto image = file.finish();
  return std::string(image.bytes()) + slipfront::record::seal(image.bytes());
}

std::string refusal_of(const Form& form) { return refusal_of(made(form)); }

TEST(PulseDamage, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.nc", made(Form{}));
  EXPECT_EQ(refusal(folder / "a.nc"), "");
  for (const char* name : {"slipfront_format", "scenario", "version", "finished", "time", "x", "checkpoint",
                           "trailing_front", "energy_kinetic", "peak_position"}) {
    Form form;
    form.left_out = [=](const std::string& candidate) { return candidate == name; };
    EXPECT_NE(refusal_of(form).find(name), std::string::npos) << name;
  }
}

TEST(PulseDamage, NamesWrongShapesAndTypes) {
  for (const char* name : {"time", "x", "k", "U", "W", "slip", "checkpoint", "stress_at_origin"}) {
    Form form;
    form.wrong_shape = name;
    EXPECT_NE(refusal_of(form).find(std::string(name) + " has the wrong"), std::string::npos) << name;
    form.wrong_shape = {};
    form.wrong_type = name;
    EXPECT_NE(refusal_of(form).find(std::string(name) + " has the wrong"), std::string::npos) << name;
  }
}

TEST(PulseDamage, RejectsWrongValues) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& times : {std::vector<double>{0, nan}, {nan, 1}, {1, 1}, {1, 0}}) {
    Form form;
    form.time = times;
    EXPECT_NE(refusal_of(form).find("times do not ascend"), std::string::npos);
  }
  Form form;
  form.finished = 2;
  EXPECT_NE(refusal_of(form).find("finished is neither 0 nor 1"), std::string::npos);
  form = {};
  form.format = "chain 1";
  EXPECT_NE(refusal_of(form).find("its slipfront_format is 'chain 1'"), std::string::npos);
}

TEST(PulseDamage, RejectsSizesThatCannotBeAllocated) {
  Form form;
  form.times = 0;  // unlimited
  form.time = {};
  form.far_row = std::size_t{1} << 40;
  const std::string file = made(form);
  EXPECT_LT(file.size(), 1u << 20);
  EXPECT_NE(refusal_of(file).find("time: more data than the limit of"), std::string::npos);
}

}  // namespace
