#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront {

/// How a text is divided into records.
struct RecordOptions {
  char separator = ',';
  /// Returns true for a line to skip. It is asked between records only, never inside quotes. If it is null, no line is
  /// skipped.
  std::function<bool(std::string_view text, std::size_t line)> skip = {};
};

/// Calls `take` with the fields of each record and the line on which it starts (RFC 4180: quotes, doubled quotes, line
/// breaks in quotes; blank lines skipped). Returns the line of a quote that is never closed, or 0.
std::size_t for_each_record(std::string_view text,
                            const std::function<void(std::vector<std::string>&&, std::size_t line)>& take,
                            const RecordOptions& options = {});

}  // namespace slipfront
