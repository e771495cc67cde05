#pragma once
/// \file
/// The numbers of a finished run as rows: what `--json` and the table on the terminal print, and Python attaches to a
/// result.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/lattice/chain/run.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "slipfront/theory/medium/si_units.hpp"

namespace slipfront::run {

using output::Value;

/// A number, a text, or one number for each of some positions.
struct Row {
  Row(const Description& description, Value a_value);

  Description about;
  Value value;
  std::vector<double> errors = {};  ///< one for each number; empty or NaN where it is not known
  std::string unit;            ///< the unit of the model, or the SI unit as UDUNITS reads it; empty for a pure number
  bool between_faces = false;  ///< it is in SI units, and measures slip between the two faces
  std::string group = {};      ///< the JSON object that holds the row, under its name without the prefix

  /// The name in its group.
  std::string_view key() const;
  std::string meaning() const;
  /// Why it has no value. Empty if it has one.
  std::string_view reason() const;
  std::span<const double> reals() const;  ///< the number or those of the list; empty if it has none with a fraction
  double number() const;                  ///< NaN for a text or a list
};

/// (all ranks) The numbers of a run that has reached its end.
std::vector<Row> rows_of(const pulse::Run& run, const output::Spent& spent);
std::vector<Row> rows_of(const chain::Run& run, const output::Spent& spent);
std::vector<Row> rows_of(const plane::Run& run, const output::Spent& spent);

/// A number that a run of "pulse" or "chain" has. A sweep returns the results by default, but not its time and machine.
struct NumberOfRun {
  Description about;
  bool is_result;
};
std::vector<NumberOfRun> numbers_of(std::string_view command);

/// Converts values and errors to SI units.
void convert(std::vector<Row>& rows, const medium::SiUnits& units);

}  // namespace slipfront::run
