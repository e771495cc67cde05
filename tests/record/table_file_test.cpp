#include "runs/record/netcdf/table_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "runs/record/netcdf/netcdf.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"
#include "temporary_folder.hpp"

namespace {

using slipfront::FileError;
using slipfront::InputError;
using slipfront::record::read_table;
using slipfront::record::netcdf::Writer;
using Table = std::vector<std::vector<double>>;

Table read(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  write_bytes(folder / name, content);
  return read_table(folder / name, {"x", "stress"});
}

slipfront::Complaint complaint(const std::string& name, const std::string& content) {
  try {
    read(name, content);
  } catch (const InputError& error) {
    EXPECT_NE(error.complaint().file, "");
    EXPECT_NE(error.complaint().allowed, "");
    return error.complaint();
  }
  ADD_FAILURE() << "not refused: " << content;
  return {};
}

/// A NetCDF file of two variables; the attribute goes to `stress` if it has a name.
std::string netcdf(const std::vector<double>& x, const std::vector<double>& stress, const std::string& attribute = {}) {
  Writer file("table");
  const int ids[] = {file.reals("x", {file.dimension("x", x.size())}),
                     file.reals("stress", {file.dimension("y", stress.size())})};
  if (attribute == "_FillValue") file.attribute(ids[1], attribute, 0.5);
  if (attribute == "scale_factor") file.attribute(ids[1], attribute, 2);
  file.end_definitions();
  file.write(ids[0], x);
  file.write(ids[1], stress);
  const auto image = file.finish();
  return std::string(image.bytes());
}

const Table expected = {{-1, 0.855}, {0, 0.5}, {0.1, 0}};

TEST(TableFile, ReadsCsv) {
  EXPECT_EQ(read("a.csv", "x,stress\n-1,0.855\n0,0.5\n1e-1,0\n"), expected);
  EXPECT_EQ(read("a.csv", "\xEF\xBB\xBF\"stress\" , note, x\r\n0.855,\"a, b\",-1\r\n\r\n 0.5 ,,\"0\"\r\n0,c,0.1"),
            expected);
}

TEST(TableFile, NamesLineColumnAndValueOfBadCsv) {
  auto c = complaint("a.csv", "x,stress\n0,1\n\n1,1.2.3\n");
  EXPECT_EQ(c.line, 4u);
  EXPECT_EQ(c.key, "stress");
  EXPECT_EQ(c.value, "1.2.3");
  EXPECT_EQ(complaint("a.csv", "x,stress\nnan,1\n").key, "x");
  EXPECT_EQ(complaint("a.csv", "x,stress\n0,inf\n").key, "stress");
  EXPECT_EQ(complaint("a.csv", "x,stress\n0,1e400\n").key, "stress");
  EXPECT_EQ(complaint("a.csv", "x,stress\n0,\n").problem, "no value");
  c = complaint("a.csv", "x,sress\n0,1\n");
  EXPECT_EQ(c.line, 1u);
  EXPECT_EQ(c.key, "stress");
  EXPECT_EQ(c.problem, "column is missing");
  EXPECT_EQ(complaint("a.csv", "x,stress,x\n0,1,2\n").problem, "column given twice");
  EXPECT_EQ(complaint("a.csv", "x,stress\n0,1\n0\n").line, 3u);
  EXPECT_EQ(complaint("a.csv", "x,stress\n0,\"1\n").line, 2u);
  EXPECT_EQ(complaint("a.csv", "x,stress\n").problem, "a header and no rows");
  EXPECT_EQ(complaint("a.csv", "").problem, "the file is empty");
}

TEST(TableFile, ReadsNetcdf) { EXPECT_EQ(read("a.nc", netcdf({-1, 0, 0.1}, {0.855, 0.5, 0})), expected); }

/// A NetCDF file with slip over y and x.
std::string grid(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& slip) {
  Writer file("grid");
  const int nx = file.dimension("x", x.size()), ny = file.dimension("y", y.size());
  const int ids[] = {file.reals("x", {nx}), file.reals("y", {ny}), file.reals("slip", {ny, nx})};
  file.end_definitions();
  file.write(ids[0], x);
  file.write(ids[1], y);
  file.write_all(ids[2], slip);
  const auto image = file.finish();
  return std::string(image.bytes());
}

/// HDF5 must not see a damaged file, which can crash it.
TEST(TableFile, RejectsADamagedFileOfSlipfrontByItsChecksum) {
  const std::string image = netcdf({-1, 0, 0.1}, {0.855, 0.5, 0}), sealed = image + slipfront::record::seal(image);
  EXPECT_EQ(read("a.nc", sealed), expected);
  for (std::size_t at = 0; at < image.size(); at += 1 + image.size() / 50) {
    std::string damaged = sealed;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
    const std::string message = message_of<FileError>([&] { read("a.nc", damaged); });
    EXPECT_NE(message.find(at < 8 ? "not a NetCDF-4 file" : "the checksum does not match"), std::string::npos) << at;
  }
}

TEST(TableFile, ReadsAGridOfNetcdfRowByRow) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.nc", grid({-1, 1}, {0, 2, 4}, {1, 2, 3, 4, 5, 6}));
  const Table rows = {{-1, 0, 1}, {1, 0, 2}, {-1, 2, 3}, {1, 2, 4}, {-1, 4, 5}, {1, 4, 6}};
  EXPECT_EQ(read_table(folder / "a.nc", {"x", "y", "slip"}), rows);
  EXPECT_THROW(read_table(folder / "a.nc", {"y", "x", "slip"}), InputError);
  EXPECT_THROW(read_table(folder / "a.nc", {"x", "slip"}), InputError);
  write_bytes(folder / "b.csv", "slip,y,x\n1,0,-1\n2,0,1\n");
  EXPECT_EQ(read_table(folder / "b.csv", {"x", "y", "slip"}), (Table{{-1, 0, 1}, {1, 0, 2}}));
}

TEST(TableFile, NamesTheVariableOfBadNetcdf) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint("a.nc", netcdf({0, 1}, {0})).key, "stress");
  EXPECT_EQ(complaint("a.nc", netcdf({}, {})).key, "x");
  EXPECT_EQ(complaint("a.nc", netcdf({0, 1}, {0, nan})).problem, "value 2 of 2 is not finite");
  EXPECT_EQ(complaint("a.nc", netcdf({0, 1}, {0, 0.5}, "_FillValue")).problem, "value 2 of 2 is missing");
  EXPECT_EQ(complaint("a.nc", netcdf({0, 1}, {0, 1}, "scale_factor")).problem, "is packed (scale_factor, add_offset)");
  Writer file("none");
  const int x = file.dimension("n", 2);
  file.reals("x", {x, x});
  file.end_definitions();
  const auto image = file.finish();
  EXPECT_EQ(complaint("a.nc", std::string(image.bytes())).problem, "has 2 dimensions");
}

TEST(TableFile, ReportsUnreadableFilesAsFileErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_table(folder / "none.csv", {"x", "stress"}), FileError);
  EXPECT_THROW(read_table(folder / "none.nc", {"x", "stress"}), FileError);
  EXPECT_THROW(read("a.nc", ""), FileError);
  EXPECT_THROW(read("a.nc", "x,stress\n0,1\n"), FileError);
  const std::string good = netcdf({0, 1}, {0, 1});
  EXPECT_THROW(read("a.nc", good.substr(0, 1000)), FileError);
  EXPECT_EQ(complaint("a.txt", "x,stress\n0,1\n").problem, "unknown ending '.txt'");
}

}  // namespace
