#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront::scenario {

/// A formula of x, or of x and t, as a scenario writes it: + - * / ^ ( ) < <= > >= == != && || and ?: with the
/// constants pi and e and the functions of formula_functions(). Not to be called from two threads at once.
class Formula {
 public:
  /// \throws InputError (problem and allowed only) that names the position of what is wrong.
  Formula(const std::string& text, const std::vector<std::string_view>& variables);
  /// May be NaN or infinite: what that means is for the caller to say.
  double operator()(double x, double t = 0) const;
  /// Whether its value depends on the variable.
  bool has(std::string_view variable) const;

 private:
  struct Compiled;
  std::shared_ptr<Compiled> compiled_;  ///< shared: copying a parser would parse again
};

const std::vector<std::string_view>& formula_functions();

/// Refuses what the parser would accept in another sense (assignment, strings, several values), crash on (length,
/// depth) or report less clearly (unknown names, numbers beyond a double). \throws InputError like Formula.
void scan_formula(const std::string& text, const std::vector<std::string_view>& variables);

}  // namespace slipfront::scenario
