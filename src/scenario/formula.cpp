#include "formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slipfront/error.hpp"

namespace slipfront::scenario {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Function {
  std::string_view name;
  double (*call)(double);
};

/// All our own: the parser's min, max and sign turn NaN into a number, and so would hide a formula that fails.
constexpr Function functions[] = {
    {"sin", [](double v) { return std::sin(v); }},     {"cos", [](double v) { return std::cos(v); }},
    {"tan", [](double v) { return std::tan(v); }},     {"asin", [](double v) { return std::asin(v); }},
    {"acos", [](double v) { return std::acos(v); }},   {"atan", [](double v) { return std::atan(v); }},
    {"sinh", [](double v) { return std::sinh(v); }},   {"cosh", [](double v) { return std::cosh(v); }},
    {"tanh", [](double v) { return std::tanh(v); }},   {"asinh", [](double v) { return std::asinh(v); }},
    {"acosh", [](double v) { return std::acosh(v); }}, {"atanh", [](double v) { return std::atanh(v); }},
    {"exp", [](double v) { return std::exp(v); }},     {"log", [](double v) { return std::log(v); }},
    {"ln", [](double v) { return std::log(v); }},      {"log10", [](double v) { return std::log10(v); }},
    {"log2", [](double v) { return std::log2(v); }},   {"sqrt", [](double v) { return std::sqrt(v); }},
    {"abs", [](double v) { return std::fabs(v); }},    {"sign", [](double v) { return v > 0 ? 1 : v < 0 ? -1 : v; }},
};

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

InputError refusal(const mu::Parser::exception_type& error) {
  const std::string token = error.GetToken().substr(0, 40);
  const std::string at = " at character " + std::to_string(std::max(0, error.GetPos()) + 1);
  std::string problem = token.empty() ? "cannot be read" + at : "'" + token + "' cannot stand" + at;
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
  double x = 0;
  double t = 0;
};

Formula::Formula(const std::string& text, const std::vector<std::string_view>& variables)
    : compiled_(std::make_shared<Compiled>()) {
  scan_formula(text, variables);
  mu::Parser& parser = compiled_->parser;
  try {
    parser.ClearFun();
    parser.ClearConst();
    for (const Function& function : functions) parser.DefineFun(std::string(function.name), function.call);
    parser.DefineFun("min", least);
    parser.DefineFun("max", greatest);
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (const std::string_view variable : variables)
      parser.DefineVar(std::string(variable), variable == "t" ? &compiled_->t : &compiled_->x);
    parser.SetExpr(text);
    int results = 0;
    parser.Eval(results);  // parses; from now on only the values change
    if (results != 1) throw InputError({.problem = "more than one value", .allowed = "one value"});
  } catch (const mu::Parser::exception_type& error) {
    throw refusal(error);
  }
}

double Formula::operator()(double x, double t) const {
  compiled_->x = x;
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
    for (const Function& function : functions) all.push_back(function.name);
    all.insert(all.end(), {"min", "max"});
    return all;
  }();
  return names;
}

}  // namespace slipfront::scenario
