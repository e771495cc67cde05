#pragma once
/// \file
/// What a run finds wrong in its own results.

#include <cmath>
#include <string>
#include <vector>

namespace slipfront::output {

/// What a run finds wrong or doubtful in its own results: sentences for the user, and the worst violation among them.
struct Findings {
  static constexpr double worth_a_warning = 1e-3, wrong = 1e-2;  ///< relative sizes of a violation

  std::vector<std::string> sentences;
  std::string worst;
  double size = 0;

  void violation(double relative, const std::string& sentence) {
    if (relative <= worth_a_warning) return;  // NaN is a violation
    sentences.push_back(sentence);
    if (relative <= size) return;
    size = std::isnan(relative) ? HUGE_VAL : relative;
    worst = sentence;
  }
  bool wrong_results() const { return size > wrong; }
};

}  // namespace slipfront::output
