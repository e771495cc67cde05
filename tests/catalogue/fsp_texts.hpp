#pragma once

// Invented finite-fault models, tests/data/fsp_*.fsp, and edits of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "folders.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"

namespace slipfront::catalogue {

inline constexpr const char* all_files[] = {"fsp_srcmod_single", "fsp_srcmod_segments", "fsp_usgs_single",
                                            "fsp_usgs_segments", "fsp_dirty"};

inline std::string text_of(const std::string& name) {
  std::ifstream file(std::string(data_folder) + "/" + name + ".fsp", std::ios::binary);
  EXPECT_TRUE(file) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Replaces `from`, which must occur exactly once. An edit that finds nothing would test nothing.
inline std::string edited(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return text;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline std::string single(std::string_view from, std::string_view to) {
  return edited(text_of("fsp_srcmod_single"), from, to);
}

inline Observation read(const std::string& text) { return read_fsp(text, "m.fsp"); }

/// The complaint about a text that the reader must refuse.
inline Complaint refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos);
    EXPECT_EQ(error.complaint().file, "m.fsp");
    return error.complaint();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

inline bool is_refused(std::string_view text) {
  try {
    read_fsp(text, "m.fsp");
  } catch (const InputError&) {
    return true;
  }
  return false;
}

inline std::size_t warnings_with(const Observation& o, std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      o.warnings.begin(), o.warnings.end(), [&](const std::string& w) { return w.find(text) != std::string::npos; }));
}

inline void expect_value(const std::optional<MeasuredValue>& measured, double value) {
  ASSERT_TRUE(measured);
  EXPECT_DOUBLE_EQ(measured->low, value);
  EXPECT_EQ(measured->low, measured->high);
}

inline void expect_value(const std::optional<double>& found, double value) {
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(*found, value);
}

inline void expect_no_elastic_constants(const Observation& o) {
  EXPECT_FALSE(o.p_wave_speed || o.s_wave_speed || o.density || o.poisson_ratio || o.shear_modulus);
}

/// Positions in the text: the beginning of the last row, and the end of its last number.
struct LastRow {
  std::size_t begin, end;
};

inline LastRow last_row(const std::string& text) {
  LastRow last{0, 0};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t first = text.find_first_not_of(" \t", at);
    if (first < end && text[first] != '%') last = {at, text.find_last_not_of(" \t\r\n", end) + 1};
    at = end + 1;
  }
  return last;
}

}  // namespace slipfront::catalogue
