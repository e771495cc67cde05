#pragma once
/// \file
/// Functions that a scenario gives: formulas, and smooth curves through the points of a table.

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenario/formula.hpp"
#include "scenario/section.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// An error in a value that was found later: `where` has file, line and key.
InputError refused_at(Complaint where, std::string problem, std::string allowed);

/// \throws InputError that names the key, if the text is no formula of these variables.
Formula compiled(const Section& section, std::string_view key, const std::string& text,
                 const std::vector<std::string_view>& variables);

/// A formula of x, y and t that a key gives, in the units of the model. Its values must keep limits.
class CheckedFormula {
 public:
  /// `name` names the quantity, such as "the slip". `ratio` is y of the scenario over y of the problem.
  CheckedFormula(const Section& section, std::string_view key, const std::string& text,
                 std::vector<std::string_view> variables, std::string name, const Limits& limits, ModelUnit unit,
                 double ratio);
  /// \throws InputError that names file, line, key and position, if the value is not finite or out of its limits.
  double operator()(double x, double y, double t = 0) const;
  bool has(std::string_view variable) const { return formula_.has(variable); }

 private:
  Formula formula_;
  std::vector<std::string_view> variables_;
  Complaint where_;
  std::string name_;
  Limits limits_;
  double length_, time_, unit_;  ///< units of the model in those of the formula
  double ratio_;
};

/// The forcing F, and the contact ratio a, of which these variables are known.
CheckedFormula read_forcing(const Section& section, std::vector<std::string_view> variables, double ratio);
CheckedFormula read_contact(const Section& section, std::vector<std::string_view> variables, double ratio);

/// A smooth curve through points (x strictly increasing, at least two) that never leaves the range of the two points
/// around x: stress interpolated with it is never negative.
class MonotoneCurve {
 public:
  explicit MonotoneCurve(std::vector<std::pair<double, double>> points);
  double first() const { return points_.front().first; }
  double last() const { return points_.back().first; }
  double operator()(double x) const;  ///< first() <= x <= last()

 private:
  std::vector<std::pair<double, double>> points_;
  std::vector<double> slopes_;
};

/// A column of a table file, and what its numbers may be.
struct Column {
  std::string name;
  Limits limits;    ///< in the unit of the model
  double unit = 1;  ///< the unit of the model in the unit of the file
};

/// A table file that a key of a section names, relative to the scenario.
struct TableFile {
  /// The file that the key "file" names.
  TableFile(const Section& of, const TableReader& reader)
      : section(of), tables(reader), key("file"), name(*of.text("file")) {}
  TableFile(const Section& of, const TableReader& reader, std::string_view named_by, std::string file)
      : section(of), tables(reader), key(named_by), name(std::move(file)) {}

  InputError refuse(const std::string& problem, const std::string& allowed) const {
    return section.refuse(key, problem, allowed);
  }
  /// The rows in units of the model. \throws InputError for a number out of its limits; what `tables` throws.
  std::vector<std::vector<double>> columns(const std::vector<Column>& columns) const;
  /// The rows of two columns: two or more, x strictly increasing. \throws InputError; what `tables` throws.
  std::vector<std::pair<double, double>> rows(const Column& x, const Column& y) const;

  const Section& section;
  const TableReader& tables;
  std::string_view key;
  std::string name;
};

/// A rectangle of x and y of the scenario; a line has the height 0.
struct Extent {
  double left = 0, right = 0, bottom = 0, top = 0;
};

/// The values of a column at points (x, y), one row for each pair of an x and a y. Between the points they are monotone
/// along x and y (Fritsch and Carlson), so that they never leave the range of the points around.
/// \throws InputError if the points do not cover the extent; what TableFile throws.
std::function<double(double x, double y)> read_grid(const TableFile& file, const Column& value, const Extent& extent);

}  // namespace slipfront::scenario
