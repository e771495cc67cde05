/// \file
/// Replaces scenario/formula/formula.cpp, whose parser is a library of the system. It reads the same formulas by
/// recursive descent. scan_formula finds other errors before; this parser reports only errors of grammar.

#include "scenario/formula/formula.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "scenario/formula/formula_functions.hpp"
#include "slipfront/error.hpp"

namespace slipfront::scenario {
namespace {

struct Place {
  double x, y, t;
};
using Node = std::function<double(const Place&)>;

struct Operator {
  std::string_view sign;
  int rank;  ///< precedence: higher binds first
  double (*apply)(double, double);
};
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

class Reader {
 public:
  Reader(const std::string& text, const std::vector<std::string_view>& variables)
      : text_(text), variables_(variables) {}

  Node whole() {
    Node node = choice();
    if (skip() < text_.size()) refuse();
    return node;
  }
  bool reads_time() const { return reads_time_; }
  bool reads_place() const { return reads_place_; }

 private:
  [[noreturn]] void refuse() {
    const bool ends = skip() >= text_.size();
    const std::string token(1, ends ? ' ' : text_[at_]);
    throw InputError(
        {.problem = ends ? "ends too early" : "'" + token + "' is not allowed at character " + std::to_string(at_ + 1),
         .allowed = "a formula such as max(0, 1 - x^2)"});
  }
  std::size_t skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
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

  Node choice() {
    Node condition = binary(1);
    if (!take("?")) return condition;
    Node yes = choice();
    need(":");
    Node no = choice();
    return [=](const Place& p) { return condition(p) != 0 ? yes(p) : no(p); };
  }
  Node binary(int rank) {
    if (rank > 6) return signed_power();
    Node left = binary(rank + 1);
    while (true) {
      const Operator* found = nullptr;
      for (const Operator& o : operators)
        if (o.rank == rank && !found && take(o.sign)) found = &o;
      if (!found) return left;
      left = [a = left, b = binary(rank + 1), apply = found->apply](const Place& p) { return apply(a(p), b(p)); };
    }
  }
  Node signed_power() {
    if (take("-")) return [a = signed_power()](const Place& p) { return -a(p); };
    if (take("+")) return signed_power();
    Node base = atom();
    if (!take("^")) return base;
    return [base, power = signed_power()](const Place& p) { return std::pow(base(p), power(p)); };
  }
  Node atom() {
    if (take("(")) {
      Node inside = choice();
      need(")");
      return inside;
    }
    skip();
    if (at_ < text_.size() && (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.'))
      return number();
    std::size_t end = at_;
    while (end < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_')) ++end;
    if (end == at_) refuse();
    const std::string name = text_.substr(at_, end - at_);
    const std::size_t begin = std::exchange(at_, end);
    for (const std::string_view variable : variables_)
      if (name == variable) return variable_named(name);
    if (name == "pi") return [](const Place&) { return std::numbers::pi; };
    if (name == "e") return [](const Place&) { return std::numbers::e; };
    if (name == "min" || name == "max") return extreme(name == "min");
    for (const FormulaFunction& f : functions_of_one)
      if (name == f.name) {
        need("(");
        Node inside = choice();
        need(")");
        return [inside, call = f.call](const Place& p) { return call(inside(p)); };
      }
    at_ = begin;
    refuse();
  }
  Node number() {
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return [value](const Place&) { return value; };
  }
  Node variable_named(const std::string& name) {
    (name == "t" ? reads_time_ : reads_place_) = true;
    if (name == "t") return [](const Place& p) { return p.t; };
    if (name == "y") return [](const Place& p) { return p.y; };
    return [](const Place& p) { return p.x; };
  }
  Node extreme(bool least) {
    need("(");
    std::vector<Node> all = {choice()};
    while (take(",")) all.push_back(choice());
    need(")");
    return [all, least](const Place& p) {
      double result = all[0](p);
      for (std::size_t i = 1; i < all.size(); ++i) {
        const double value = all[i](p);
        if (std::isnan(value) || (least ? value < result : value > result)) result = value;
      }
      return result;
    };
  }

  const std::string& text_;
  const std::vector<std::string_view>& variables_;
  std::size_t at_ = 0;
  bool reads_time_ = false, reads_place_ = false;
};

}  // namespace

struct Formula::Compiled {
  Node value;
  bool reads_time = false, reads_place = false;
};

Formula::Formula(const std::string& text, const std::vector<std::string_view>& variables)
    : compiled_(std::make_shared<Compiled>()) {
  scan_formula(text, variables);
  Reader reader(text, variables);
  compiled_->value = reader.whole();
  compiled_->reads_time = reader.reads_time();
  compiled_->reads_place = reader.reads_place();
}

double Formula::operator()(double x, double t) const { return compiled_->value({x, 0, t}); }
double Formula::operator()(double x, double y, double t) const { return compiled_->value({x, y, t}); }
bool Formula::has(std::string_view variable) const {
  return variable == "t" ? compiled_->reads_time : compiled_->reads_place;
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
