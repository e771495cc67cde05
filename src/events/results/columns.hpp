#pragma once
/// \file
/// The columns of event results, each defined once, for files and for other languages (docs/events.md): quantities of
/// the state of a fault, other numbers of an event, and the quantities of a population.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "events/catalogue/population.hpp"
#include "events/results/evaluate.hpp"
#include "slipfront/description.hpp"
#include "slipfront/events/inference/quantities.hpp"

namespace slipfront::results {

/// One number of an event, declared once for all outputs.
struct EventNumber {
  Description about;
  bool in_population;  ///< whether population statistics include it
  std::optional<double> (*get)(const EventResult&);
};
/// The numbers in the order of output, in which they precede the quantities of the state.
std::span<const EventNumber> event_numbers();

/// The value of a quantity in the result of an event. It is absent if the quantity has none.
std::optional<inference::Inferred> answer_of(const EventResult& result, const inference::Quantity& quantity);

/// The quantities of population statistics: observed and inferred quantities, in the order of output.
std::vector<Description> population_quantities();
/// The values of these quantities for one event. They are absent for an event without a rupture velocity.
std::optional<catalogue::Member> member_of(const EventResult& result);

/// The axis along which the numbers of an event lie in a column.
enum class Axis {
  none,      ///< one number
  bound,     ///< 5 %, 95 %
  quantile,  ///< 5 %, 50 %, 95 %
  draw,      ///< states of the posterior, with equal weights
};

/// A column of numbers for each event. Unknown numbers are NaN.
struct NumberColumn {
  std::string name, long_name;
  std::string_view unit;              ///< SI unit; "1" for a pure number
  std::string_view dimensional_unit;  ///< unit of a dimensionless value; may be empty
  std::string_view reference;         ///< section or equation of the paper; may be empty
  Axis axis;
  std::size_t count;                                         ///< how many numbers an event has
  std::function<void(const EventResult&, double* out)> get;  ///< writes `count` numbers
};

/// The optional columns, in addition to those of every catalogue.
struct ColumnChoice {
  bool pulse = false;     ///< columns of a pulse along each finite-fault model
  std::size_t draws = 0;  ///< number of draws of the posterior
};

/// A column with a text for each event. A text may be empty.
struct TextColumn {
  std::string_view name, long_name;
  std::string (*get)(const EventResult&);
};

/// The columns in the order of output.
std::vector<NumberColumn> number_columns(const ColumnChoice& choice);
std::vector<TextColumn> text_columns(bool with_pulse);

/// The attribute `units` of a quantity: "1" for a pure number.
std::string_view unit_of(const Description& about);

/// The observations in tension, such as "stress_drop 3.2; slip -2.9".
std::string tension_text(const EventResult& result);

/// Joins several texts with "; ".
std::string joined(const std::vector<std::string>& parts);

}  // namespace slipfront::results
