#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

using Rows = std::vector<std::pair<double, double>>;
using Overrides = std::vector<std::string>;

inline const std::string step = "[initial]\nstress_left = 1\nstress_right = 0\n";

/// In SI units; it needs [medium].
inline const std::string si_step = "[initial]\nstress_left = \"1 MPa\"\nstress_right = 0\n";

inline Scenario read(const std::string& text, const Overrides& overrides = {}, const Rows& rows = {}) {
  return read_scenario(text, "dir/s.toml", overrides, [&](const std::string&, const std::vector<std::string>&) {
    std::vector<std::vector<double>> table;
    for (const auto& [x, y] : rows) table.push_back({x, y});
    return table;
  });
}

inline Complaint refused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.complaint();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

inline Complaint refused(const std::string& text, const Overrides& overrides = {}, const Rows& rows = {}) {
  SCOPED_TRACE(text);
  return refused([&] { read(text, overrides, rows); });
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace slipfront::scenario
