// Reader of finite-fault models: what it refuses, and with which words.

#include "fsp_texts.hpp"

namespace slipfront::catalogue {
namespace {

TEST(Fsp, RejectsOtherFiles) {
  for (const std::string text :
       {"", "\n", "hello", "name,slip\na,1\n", "% Event : A 01/02/1903 [B]\n", "{}", "\xff\xfe\x00"}) {
    EXPECT_NE(refusal(text).allowed.find(".fsp"), std::string::npos) << text;
  }
  EXPECT_EQ(refusal("").problem, "empty");
  const std::string nameless = edited(single("Northern   Nowhere (Calif.) ", ""), "s1901NOWHERnobo", "");
  EXPECT_EQ(refusal(nameless).key, "Event");
  EXPECT_EQ(refusal(nameless).line, 3U);
  const std::string text = text_of("fsp_srcmod_single");
  EXPECT_EQ(refusal(text + text).line, 51U);
}

TEST(Fsp, SurvivesACutAtEveryLine) {
  for (const char* name : all_files) {
    const std::string text = text_of(name);
    const LastRow last = last_row(text);
    for (std::size_t at = 0; at != std::string::npos; at = text.find('\n', at + 1)) {
      EXPECT_EQ(is_refused(std::string_view(text).substr(0, at)), at < last.end) << name << " cut at byte " << at;
    }
  }
}

TEST(Fsp, SurvivesACutAtEveryByte) {
  for (const char* name : all_files) {
    const std::string text = text_of(name);
    const LastRow last = last_row(text);
    const std::size_t last_number = text.find_last_of(" \t", last.end - 1) + 1;
    for (std::size_t at = 0; at <= last_number; ++at) {
      EXPECT_TRUE(is_refused(std::string_view(text).substr(0, at))) << name << " cut at byte " << at;
    }
    EXPECT_FALSE(is_refused(std::string_view(text).substr(0, last.end))) << name;
  }
}

TEST(Fsp, NamesWhatACutFileLacks) {
  std::string text = text_of("fsp_srcmod_segments");
  text.resize(text.find("% SEGMENT #   3"));
  const Complaint segments = refusal(text);
  EXPECT_EQ(segments.key, "Nsg");
  EXPECT_EQ(segments.value, "3");
  text = edited(text_of("fsp_srcmod_segments"),
                "   42.9600    139.0800    -9.5428    23.6686    5.0000    4.000    2.000\n", "");
  const Complaint rows = refusal(text);
  EXPECT_EQ(rows.key, "Nsbfs");
  EXPECT_EQ(rows.value, "4");
  EXPECT_NE(rows.problem.find("segment 1 has 3"), std::string::npos);
}

TEST(Fsp, RejectsMoreSegmentsThanAnnounced) {
  const Observation o = read(edited(text_of("fsp_usgs_segments"), "Nsg = 2", "Nsg = 1"));
  expect_value(o.slip, 1.25);
  EXPECT_EQ(warnings_with(o, "Nsg = 1"), 1U);
}

TEST(Fsp, RejectsBadRows) {
  const std::string row = "    34.990  -119.990    -2.000    -2.000     0.500     1.500   180.000";
  for (const std::string bad : {"1e400", "-1e400", "1e-400", "inf", "-inf"}) {
    const Complaint c = refusal(single(row, "    34.990  -119.990    -2.000    -2.000     0.500 " + bad + "  180.000"));
    EXPECT_EQ(c.line, 45U) << bad;
    EXPECT_EQ(c.value, bad);
    EXPECT_EQ(c.allowed, "finite numbers");
  }
  for (const std::string bad :
       {"34.990 -119.990 -2 -2 0.5 1.5", "34.990 -119.990 -2 -2 0.5 1.5 180 7", "34.990 -119.990 -2 -2 0.5 x 180",
        "34.990-119.990 -2 -2 0.5 1.5 180", "1 2 3 4 5 ++6 7", "1 2 3 4 5 +-6 7"}) {
    const Complaint c = refusal(single(row, bad));
    EXPECT_EQ(c.line, 45U) << bad;
    EXPECT_NE(c.allowed.find("7, one for each name of line 41"), std::string::npos) << c.allowed;
  }
}

TEST(Fsp, RejectsSumsThatOverflow) {
  EXPECT_EQ(refusal(edited(single("0.500     1.500", "0.500     1e308"), "0.500     1.000", "0.500     1e308")).key,
            "SLIP");
  const Observation o = read(edited(single("0.500     1.500", "0.500     1e300"), "avTr = 2.0", "avTr = 1e-300"));
  EXPECT_FALSE(o.slip_velocity_m_s);
  EXPECT_EQ(warnings_with(o, "out of range"), 1U);
}

TEST(Fsp, RejectsHeaderNumbersOutsideDouble) {
  EXPECT_EQ(refusal(single("avVr = 2.5", "avVr = 1e400")).key, "avVr");
  EXPECT_EQ(refusal(single("DEP = 7.00", "DEP = 1e400")).line, 6U);
  EXPECT_EQ(refusal(single("4.00       6.00", "4.00       1e400")).line, 27U);
}

TEST(Fsp, RejectsUnreadableHeadings) {
  EXPECT_EQ(refusal(single("SLIP      RAKE\n", "SLIP      SLIP\n")).key, "SLIP");
  EXPECT_TRUE(is_refused(single("SLIP      RAKE\n", "GLIDE     RAKE\n")));
  const std::string heading = "%   RISE      SLIP        LAT        LON          X==NS      Y==EW        Z \n";
  EXPECT_EQ(refusal(edited(text_of("fsp_srcmod_segments"), heading, "")).problem, "rows without column names");
  EXPECT_EQ(refusal(edited(text_of("fsp_srcmod_segments"), heading, "% SEGMENT # 4\n")).line, 55U);
}

}  // namespace
}  // namespace slipfront::catalogue
