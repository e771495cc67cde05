#pragma once

/// \file
/// The functions of one argument that a formula may call.

#include <cmath>
#include <string_view>

namespace slipfront::scenario {

struct FormulaFunction {
  std::string_view name;
  double (*call)(double);
};

/// All our own: the parser's min, max and sign turn NaN into a number, and so would hide a formula that fails.
inline constexpr FormulaFunction functions_of_one[] = {
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

}  // namespace slipfront::scenario
