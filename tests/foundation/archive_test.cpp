#include "system/archive.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace slipfront {
namespace {

struct Pair {
  double x = 0, y = 0;
};
struct Named {
  double x = 0;
  bool is_known = false;
};
static_assert(is_doubles<Pair> && !is_doubles<Named>);

struct Everything {
  double number = 0;
  long count = 0;
  bool flag = false;
  std::string text;
  std::vector<double> values;
  std::vector<Pair> pairs;
  std::vector<std::optional<double>> maybe;
  std::vector<std::string> texts;

  void archive(Archive& a) { a(number, count, flag, text, values, pairs, maybe, texts); }
};

Everything something() { return {1.5, -7, true, "text", {1, 2, 3}, {{4, 5}}, {std::nullopt, 6.0}, {"a", ""}}; }

TEST(Archive, RestoresWhatItSaved) {
  const std::string bytes = saved(something());
  Everything read;
  read.values = {9};
  restore(read, bytes);
  EXPECT_EQ(read.count, -7);
  EXPECT_TRUE(read.flag);
  EXPECT_EQ(read.values, something().values);
  EXPECT_EQ(read.pairs.at(0).y, 5);
  EXPECT_EQ(read.maybe, something().maybe);
  EXPECT_EQ(read.texts, something().texts);
  EXPECT_EQ(saved(read), bytes);
}

/// Bytes that are cut anywhere, that are too many, or that have another format.
TEST(Archive, RefusesDamagedBytes) {
  const std::string bytes = saved(something());
  Everything read;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(restore(read, bytes.substr(0, size)), InputError) << size;
  EXPECT_THROW(restore(read, bytes + "x"), InputError);
  std::string other = bytes;
  ++other[0];
  EXPECT_THROW(restore(read, other), InputError);
}

/// A size far above what there is ends with an error, not with the memory.
TEST(Archive, RefusesSizesThatDoNotFit) {
  std::vector<std::vector<double>> rows{{1, 2}};
  std::string bytes;
  Archive::to(bytes)(rows);
  for (const std::size_t at : {std::size_t{8}, std::size_t{16}}) {
    std::string wrong = bytes;
    wrong[at + 6] = 1;
    EXPECT_THROW(Archive::from(wrong)(rows), InputError) << at;
  }
  std::vector<double> two{1, 2}, three{1, 2, 3};
  Archive::to(bytes).fixed(two);
  EXPECT_NO_THROW(Archive::from(bytes).fixed(two));
  EXPECT_THROW(Archive::from(bytes).fixed(three), InputError);
}

/// The numbers of two sites of three, of two columns.
TEST(Archive, ReadsThePartOfARank) {
  std::vector<double> all{1, 2, 3, 4, 5, 6}, own(4), too_many(6);
  std::string bytes;
  Archive::to(bytes).parts(all, Ranks::single(), 0, 3, 3);
  Archive a = Archive::from(bytes);
  a.parts(own, Ranks::single(), 1, 2, 3);
  EXPECT_EQ(own, (std::vector<double>{3, 4, 5, 6}));
  EXPECT_TRUE(a.at_end());
  EXPECT_THROW(Archive::from(bytes).parts(too_many, Ranks::single(), 0, 2, 3), InputError);
}

}  // namespace
}  // namespace slipfront
