#include "scenario/formula.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "text/characters.hpp"

namespace slipfront::scenario {

/// One step of a stack machine: pushes a number, or slope times a variable plus a number; or replaces the last value,
/// or the last two or three.
struct FormulaStep {
  enum class Kind { number, linear, one, two, choose } kind;
  double number = 0, slope = 0;
  std::size_t variable = 0;  ///< 0: x, 1: y, 2: t
  double (*one)(double) = nullptr;
  double (*two)(double, double) = nullptr;
};

namespace {

using OfOne = double (*)(double);
using OfTwo = double (*)(double, double);

struct FormulaFunction {
  std::string_view name;
  OfOne call;
};
constexpr FormulaFunction functions_of_one[] = {
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

double negative(double v) { return -v; }
/// These powers of a variable are products, which are faster than std::pow.
double square(double v) { return v * v; }
double cube(double v) { return v * v * v; }
double fourth(double v) { return v * v * v * v; }
double least(double a, double b) { return b < a || std::isnan(b) ? b : a; }
double greatest(double a, double b) { return b > a || std::isnan(b) ? b : a; }

struct Operator {
  std::string_view sign;
  int rank;  ///< precedence: higher binds first
  OfTwo apply;
};
constexpr int highest_rank = 6;
constexpr Operator operators[] = {
    {"||", 1, [](double a, double b) { return a != 0 || b != 0 ? 1.0 : 0.0; }},
    {"&&", 2, [](double a, double b) { return a != 0 && b != 0 ? 1.0 : 0.0; }},
    {"<=", 4, [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
    {">=", 4, [](double a, double b) { return a >= b ? 1.0 : 0.0; }},
    {"==", 4, [](double a, double b) { return a == b ? 1.0 : 0.0; }},
    {"!=", 4, [](double a, double b) { return a != b ? 1.0 : 0.0; }},
    {"<", 4, [](double a, double b) { return a < b ? 1.0 : 0.0; }},
    {">", 4, [](double a, double b) { return a > b ? 1.0 : 0.0; }},
    {"+", 5, [](double a, double b) { return a + b; }},
    {"-", 5, [](double a, double b) { return a - b; }},
    {"*", 6, [](double a, double b) { return a * b; }},
    {"/", 6, [](double a, double b) { return a / b; }},
};

using Step = FormulaStep;
using Kind = Step::Kind;

/// Reads a formula by recursive descent. scan_formula has found all errors but those of grammar.
class FormulaReader {
 public:
  FormulaReader(const std::string& text, const std::vector<std::string_view>& variables)
      : text_(text), variables_(variables) {
    choice();
    if (skip() < text_.size()) refuse();
  }

  std::vector<Step> steps;
  std::vector<std::string> used;  ///< variables

 private:
  [[noreturn]] void refuse() {
    const bool ends = skip() >= text_.size();
    const std::string token(1, ends ? ' ' : text_[at_]);
    throw InputError(
        {.problem = ends ? "ends too early" : "'" + token + "' is not allowed at character " + std::to_string(at_ + 1),
         .allowed = "a formula such as max(0, 1 - x^2)"});
  }
  std::size_t skip() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    return at_;
  }
  bool take(std::string_view sign) {
    if (std::string_view(text_).substr(skip()).substr(0, sign.size()) != sign) return false;
    at_ += sign.size();
    return true;
  }
  void need(std::string_view sign) {
    if (!take(sign)) refuse();
  }
  void push(double number) { steps.push_back({.kind = Kind::number, .number = number}); }
  bool are_numbers(std::size_t count) const {
    return std::all_of(steps.end() - static_cast<std::ptrdiff_t>(count), steps.end(),
                       [](const Step& s) { return s.kind == Kind::number; });
  }
  void apply(OfOne call) {
    if (are_numbers(1))
      steps.back().number = call(steps.back().number);
    else
      steps.push_back({.kind = Kind::one, .one = call});
  }
  static bool is_variable(const Step& step) { return step.kind == Kind::linear && step.slope == 1 && step.number == 0; }
  /// Makes a linear function of one variable a single step. Returns false if the operator does not give one.
  bool fold(std::string_view sign) {
    Step& a = steps[steps.size() - 2];
    const Step b = steps.back();
    if (a.kind > Kind::linear || b.kind > Kind::linear || are_numbers(2)) return false;
    const bool has_number = a.kind == Kind::number || b.kind == Kind::number;
    if (!has_number && a.variable != b.variable) return false;
    if (sign == "+" || sign == "-") {
      const double times = sign == "+" ? 1 : -1;
      a.number += times * b.number;
      a.slope += times * b.slope;
    } else if (sign == "*" && has_number) {
      a.slope = a.slope * b.number + a.number * b.slope;
      a.number *= b.number;
    } else if (sign == "/" && b.kind == Kind::number && b.number != 0 && !is_variable(a)) {
      a.slope /= b.number;
      a.number /= b.number;
    } else {
      return false;
    }
    a.kind = Kind::linear;
    a.variable = std::max(a.variable, b.variable);
    steps.pop_back();
    return true;
  }
  void apply(OfTwo call) {
    if (!are_numbers(2)) {
      steps.push_back({.kind = Kind::two, .two = call});
      return;
    }
    const double second = steps.back().number;
    steps.pop_back();
    steps.back().number = call(steps.back().number, second);
  }

  void choice() {
    binary(1);
    if (!take("?")) return;
    choice();
    need(":");
    choice();
    steps.push_back({.kind = Kind::choose});
  }
  void binary(int rank) {
    if (rank > highest_rank) return signed_power();
    binary(rank + 1);
    while (true) {
      const auto found = std::find_if(std::begin(operators), std::end(operators),
                                      [&](const Operator& o) { return o.rank == rank && take(o.sign); });
      if (found == std::end(operators)) return;
      binary(rank + 1);
      if (!fold(found->sign)) apply(found->apply);
    }
  }
  void signed_power() {
    if (take("-")) {
      signed_power();
      return apply(negative);
    }
    if (take("+")) return signed_power();
    atom();
    if (!take("^")) return;
    signed_power();
    const bool is_of_variable = are_numbers(1) && is_variable(steps[steps.size() - 2]);
    const double power = is_of_variable ? steps.back().number : 0;
    const OfOne product = power == 2 ? square : power == 3 ? cube : power == 4 ? fourth : nullptr;
    if (product == nullptr) return apply([](double base, double exponent) { return std::pow(base, exponent); });
    steps.pop_back();
    apply(product);
  }
  void atom() {
    if (take("(")) {
      choice();
      return need(")");
    }
    skip();
    if (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) return number();
    std::size_t end = at_;
    while (end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    if (end == at_) refuse();
    const std::string name = text_.substr(at_, end - at_);
    const std::size_t begin = std::exchange(at_, end);
    for (const std::string_view variable : variables_)
      if (name == variable) return variable_named(name);
    if (name == "pi") return push(std::numbers::pi);
    if (name == "e") return push(std::numbers::e);
    if (name == "min" || name == "max") return extreme(name == "min" ? least : greatest);
    for (const FormulaFunction& f : functions_of_one)
      if (name == f.name) {
        need("(");
        choice();
        need(")");
        return apply(f.call);
      }
    at_ = begin;
    refuse();
  }
  void number() {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{}) refuse();
    at_ = static_cast<std::size_t>(end - text_.data());
    push(value);
  }
  /// The variable of a curve, such as w, is x.
  void variable_named(const std::string& name) {
    used.push_back(name);
    steps.push_back({.kind = Kind::linear, .slope = 1, .variable = name == "t" ? 2u : name == "y" ? 1u : 0u});
  }
  void extreme(OfTwo call) {
    need("(");
    choice();
    while (take(",")) {
      choice();
      apply(call);
    }
    need(")");
  }

  const std::string& text_;
  const std::vector<std::string_view>& variables_;
  std::size_t at_ = 0;
};

}  // namespace

struct Formula::Compiled {
  std::vector<FormulaStep> steps;
  std::vector<std::string> used;
  std::size_t most = 0;  ///< largest number of values on the stack

  double value(const std::array<double, 3>& variables, double* top) const {
    for (const FormulaStep& step : steps) switch (step.kind) {
        case Kind::number:
          *top++ = step.number;
          break;
        case Kind::linear:
          *top++ = step.slope * variables[step.variable] + step.number;
          break;
        case Kind::one:
          top[-1] = step.one(top[-1]);
          break;
        case Kind::two:
          --top;
          top[-1] = step.two(top[-1], top[0]);
          break;
        case Kind::choose:
          top -= 2;
          top[-1] = top[-1] != 0 ? top[0] : top[1];
          break;
      }
    return top[-1];
  }
};

Formula::Formula(const std::string& text, const std::vector<std::string_view>& variables) {
  scan_formula(text, variables);
  FormulaReader reader(text, variables);
  std::size_t size = 0, most = 0;
  for (const Step& step : reader.steps) {
    if (step.kind <= Kind::linear) most = std::max(most, ++size);
    if (step.kind == Kind::two) size -= 1;
    if (step.kind == Kind::choose) size -= 2;
  }
  compiled_ = std::make_shared<const Compiled>(Compiled{std::move(reader.steps), std::move(reader.used), most});
}

double Formula::operator()(double x, double t) const { return (*this)(x, 0, t); }

double Formula::operator()(double x, double y, double t) const {
  std::array<double, 32> few;
  if (compiled_->most <= few.size()) return compiled_->value({x, y, t}, few.data());
  return compiled_->value({x, y, t}, std::vector<double>(compiled_->most).data());
}

bool Formula::has(std::string_view variable) const {
  return std::find(compiled_->used.begin(), compiled_->used.end(), variable) != compiled_->used.end();
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

namespace {

constexpr std::size_t longest = 4096;
constexpr int deepest = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

InputError refusal(const std::string& problem, std::size_t at, std::string allowed) {
  return InputError({.problem = problem + " at character " + std::to_string(at + 1), .allowed = std::move(allowed)});
}

/// Returns the end of the number that begins at `at`. "2e" is the number 2 and the name e.
std::size_t past_number(const std::string& text, std::size_t at) {
  const auto digits = [&](std::size_t i) {
    while (i < text.size() && is_digit(text[i])) ++i;
    return i;
  };
  std::size_t end = digits(at);
  if (end < text.size() && text[end] == '.') end = digits(end + 1);
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t power = end + 1;
    if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
    if (digits(power) > power) end = digits(power);
  }
  return end;
}

/// Rejects a '=' that is not part of a comparison, because the parser would assign to x.
void check_equals(const std::string& text, std::size_t at) {
  const char before = at > 0 ? text[at - 1] : ' ';
  const char after = at + 1 < text.size() ? text[at + 1] : ' ';
  const bool second = before == '=' || before == '<' || before == '>' || before == '!';
  if (!second && after != '=') throw refusal("'='", at, "a formula without assignment; == compares");
}

/// Counts parentheses, and rejects a comma that separates values instead of the arguments of a function.
void check_structure(const std::string& text, std::size_t at, int& depth) {
  if (text[at] == '(') ++depth;
  if (text[at] == ')') --depth;
  if (depth < 0) throw refusal("')' without '('", at, "as many '(' as ')'");
  if (depth > deepest) throw refusal("parentheses too deep", at, std::to_string(deepest) + " levels");
  if (text[at] == ',' && depth == 0) throw refusal("a comma outside parentheses", at, "one value; decimals with '.'");
}

}  // namespace

void scan_formula(const std::string& text, const std::vector<std::string_view>& variables) {
  constexpr std::string_view signs = "+-*/^(),<>=!&|?: \t\r\n";
  if (text.size() > longest)
    throw InputError({.problem = "a formula too long", .allowed = std::to_string(longest) + " characters"});
  std::vector<std::string_view> names = variables;
  names.insert(names.end(), {"pi", "e"});
  names.insert(names.end(), formula_functions().begin(), formula_functions().end());
  int depth = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t at = i;
    if (is_digit(text[i]) || text[i] == '.') {
      i = past_number(text, i);
      if (!medium::number(text.substr(at, i - at)))
        throw refusal("not a finite number", at, "numbers that a double can hold");
    } else if (is_letter(text[i])) {
      while (i < text.size() && (is_letter(text[i]) || is_digit(text[i]))) ++i;
      const std::string name = text.substr(at, i - at);
      bool known = false;
      for (const std::string_view candidate : names) known = known || candidate == name;
      if (!known) throw refusal("unknown name '" + name.substr(0, 40) + "'", at, nearest_or_all(name, names));
    } else {
      if (signs.find(text[i]) == std::string_view::npos)
        throw refusal("a character that is not allowed", at, "names, numbers and + - * / ^ ( ) , < > = ! & | ? :");
      if (text[i] == '=') check_equals(text, i);
      check_structure(text, i, depth);
      ++i;
    }
  }
  if (depth > 0) throw refusal("')' is missing", text.size(), "as many '(' as ')'");
}

}  // namespace slipfront::scenario
