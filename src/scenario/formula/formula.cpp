#include "scenario/formula/formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <system_error>

#include "scenario/formula/formula_functions.hpp"
#include "slipfront/error.hpp"

namespace slipfront::scenario {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double least(const double* values, int count) {
  double result = count > 0 ? values[0] : not_a_number;
  for (int i = 1; i < count; ++i) result = values[i] < result || std::isnan(values[i]) ? values[i] : result;
  return result;
}

double greatest(const double* values, int count) {
  double result = count > 0 ? values[0] : not_a_number;
  for (int i = 1; i < count; ++i) result = values[i] > result || std::isnan(values[i]) ? values[i] : result;
  return result;
}

/// Reads the number that `text` begins with. muParser's own way is a stream, which without memory calls a good number
/// none.
int take_number(const char* text, int* position, double* value) {
  if (*text != '.' && (*text < '0' || *text > '9')) return 0;
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), *value);
  if (error != std::errc{}) return 0;
  *position += static_cast<int>(end - text);
  return 1;
}

InputError refusal(const mu::Parser::exception_type& error) {
  const std::string token = error.GetToken().substr(0, 40);
  const std::string at = " at character " + std::to_string(std::max(0, error.GetPos()) + 1);
  std::string problem = token.empty() ? "cannot be read" + at : "'" + token + "' is not allowed" + at;
  if (error.GetCode() == mu::ecUNEXPECTED_EOF) problem = "ends too early";
  if (error.GetCode() == mu::ecEMPTY_EXPRESSION) problem = "empty";
  if (error.GetCode() == mu::ecTOO_MANY_PARAMS) problem = "too many arguments of " + token + at;
  if (error.GetCode() == mu::ecTOO_FEW_PARAMS) problem = "too few arguments of " + token + at;
  for (char& c : problem)
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  return InputError({.problem = problem, .allowed = "a formula such as max(0, 1 - x^2)"});
}

}  // namespace

struct Formula::Compiled {
  mu::Parser parser;
  double x = 0, y = 0, t = 0;

  /// The number to which the parser binds a variable. The variable of a curve, such as w, is x.
  double* of(std::string_view variable) { return variable == "t" ? &t : variable == "y" ? &y : &x; }
};

Formula::Formula(const std::string& text, const std::vector<std::string_view>& variables)
    : compiled_(std::make_shared<Compiled>()) {
  scan_formula(text, variables);
  mu::Parser& parser = compiled_->parser;
  try {
    parser.AddValIdent(take_number);
    parser.ClearFun();
    parser.ClearConst();
    for (const FormulaFunction& function : functions_of_one)
      parser.DefineFun(std::string(function.name), function.call);
    parser.DefineFun("min", least);
    parser.DefineFun("max", greatest);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (const std::string_view variable : variables) parser.DefineVar(std::string(variable), compiled_->of(variable));
    parser.SetExpr(text);
    int results = 0;
    parser.Eval(results);  // parses; from now on only the values change
    if (results != 1) throw InputError({.problem = "more than one value", .allowed = "one value"});
  } catch (const mu::Parser::exception_type& error) {
    throw refusal(error);
  }
}

double Formula::operator()(double x, double t) const { return (*this)(x, 0, t); }

double Formula::operator()(double x, double y, double t) const {
  compiled_->x = x;
  compiled_->y = y;
  compiled_->t = t;
  try {
    return compiled_->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    return not_a_number;
  }
}

bool Formula::has(std::string_view variable) const {
  return compiled_->parser.GetUsedVar().count(std::string(variable)) > 0;
}

const std::vector<std::string_view>& formula_functions() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const FormulaFunction& function : functions_of_one) all.push_back(function.name);
    all.insert(all.end(), {"min", "max"});
    return all;
  }();
  return names;
}

}  // namespace slipfront::scenario
