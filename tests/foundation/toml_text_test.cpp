#include <gtest/gtest.h>

#include <string>

#include "text/toml.hpp"

namespace {

using slipfront::parse_toml;
using slipfront::toml_text;

TEST(TomlText, ReadsBackAsTheSameTable) {
  const std::string text = R"(a = -0.1
b = [1, 1e300, -inf, true]
c = { "d e" = "quote \" and \u0007", f = 2011-03-11T05:46:23.5+09:30 }
g = 1979-05-27
h = 07:32:00.000000001
i = 1979-05-27T07:32:00Z
j = 1979-05-27T00:32:00-07:00
k = 12.0
l = -9223372036854775807
)";
  const toml::table table = parse_toml(text, "a.toml");
  const toml::table again = parse_toml("all = " + toml_text(table), "again");
  EXPECT_EQ(*again["all"].as_table(), table);
}

TEST(TomlText, WritesTheShortestForm) {
  const auto written = [](const char* value) {
    return toml_text(*parse_toml(std::string("x = ") + value, "a.toml").get("x"));
  };
  EXPECT_EQ(written("0.1"), "0.1");
  EXPECT_EQ(written("12.0"), "12.0");
  EXPECT_EQ(written("-3"), "-3");
  EXPECT_EQ(written("2011-03-11T05:46:23.50+09:00"), "2011-03-11T05:46:23.5+09:00");
  EXPECT_EQ(written("2011-03-11T05:46:23Z"), "2011-03-11T05:46:23Z");
}

}  // namespace
