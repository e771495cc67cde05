#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::scenario {

/// A formula of x, or of x, y and t, in a scenario. It may contain + - * / ^ ( ) < <= > >= == != && || and ?:, the
/// constants pi and e, and the functions of formula_functions().
class Formula {
 public:
  /// \throws InputError (problem and allowed only) that gives the position of the error.
  Formula(const std::string& text, const std::vector<std::string_view>& variables);
  /// The value may be NaN or infinite; the caller must check it.
  double operator()(double x, double t = 0) const;
  double operator()(double x, double y, double t) const;
  /// Whether its value depends on the variable.
  bool has(std::string_view variable) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

const std::vector<std::string_view>& formula_functions();

/// Rejects text that the parser would accept with another meaning (assignment, strings, several values). Also rejects
/// text on which it would crash (length, depth), or that it would report less clearly (unknown names, numbers outside
/// the range of a double). \throws InputError like Formula.
void scan_formula(const std::string& text, const std::vector<std::string_view>& variables);

}  // namespace slipfront::scenario
