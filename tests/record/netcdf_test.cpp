// A finished file has all that was written to it.

#include "runs/record/netcdf/netcdf.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "slipfront/error.hpp"

namespace {

using slipfront::record::netcdf::Piece;
using slipfront::record::netcdf::Reader;
using slipfront::record::netcdf::Writer;

/// A file with values 1, 2 and `last`, a group with the text `name`, and attributes.
std::string file_with(double last, const std::string& name, const std::string& title) {
  Writer file("file");
  file.attribute(Writer::global, "title", title);
  const int x = file.reals("x", {file.dimension("size", 3)});
  Writer group(file, "group");
  const int names = group.strings("names", {group.dimension("one", 1)});
  group.attribute(names, "count", std::int64_t{7});
  file.end_definitions();
  file.write(x, std::vector{1.0, 2.0, last});
  group.write_all(names, std::vector{name});
  const auto image = file.finish();
  return std::string(image.bytes());
}

std::uint64_t sum(const std::string& image, const Piece& piece) { return Reader("file", image, 1000).sum_of(piece); }

TEST(Netcdf, DistinguishesEveryPieceOfAFileByItsSum) {
  const std::string title(100000, 'a');  // an attribute of variable length
  const std::string file = file_with(3, "a", title);
  const Piece values{.group = "/", .variable = "x", .attribute = {}, .start = {0}, .size = {3}};
  const Piece head{.group = "/", .variable = "x", .attribute = {}, .start = {0}, .size = {2}};
  const Piece names{.group = "/group", .variable = "names", .attribute = {}, .start = {0}, .size = {1}};
  const Piece count{.group = "/group", .variable = "names", .attribute = "count", .start = {}, .size = {}};
  const Piece text{.group = "/", .variable = {}, .attribute = "title", .start = {}, .size = {}};
  EXPECT_NE(sum(file, values), sum(file_with(4, "a", title), values));
  EXPECT_EQ(sum(file, head), sum(file_with(4, "a", title), head));
  EXPECT_NE(sum(file, names), sum(file_with(3, "b", title), names));
  EXPECT_NE(sum(file, text), sum(file_with(3, "a", "short"), text));
  EXPECT_EQ(sum(file, count), sum(file_with(4, "b", "short"), count));
}

TEST(Netcdf, RejectsAFileWithoutAPiece) {
  const std::string file = file_with(3, "a", "title");
  const Piece other{.group = "/", .variable = "y", .attribute = {}, .start = {0}, .size = {3}};
  const Piece longer{.group = "/", .variable = "x", .attribute = {}, .start = {0}, .size = {4}};
  const Piece unit{.group = "/", .variable = "x", .attribute = "units", .start = {}, .size = {}};
  for (const Piece& piece : {other, longer, unit}) EXPECT_THROW(sum(file, piece), slipfront::FileError);
}

}  // namespace
