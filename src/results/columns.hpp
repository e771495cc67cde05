#pragma once
/// \file
/// Results of events as columns, said once for files and other languages: docs/events.md.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/evaluate.hpp"

namespace slipfront::results {

/// What an event's numbers in a column lie along.
enum class Axis {
  none,      ///< one number
  bound,     ///< 5 %, 95 %
  quantile,  ///< 5 %, 50 %, 95 %
  draw,      ///< states of the posterior, alike in weight
};

/// Numbers of each event; NaN where not known.
struct NumberColumn {
  std::string name, long_name;
  std::string_view unit;              ///< SI, "1" for a pure number
  std::string_view dimensional_unit;  ///< of a dimensionless value; may be empty
  std::string_view reference;         ///< where in the paper; may be empty
  Axis axis;
  std::size_t count;                                         ///< numbers of an event
  std::function<void(const EventResult&, double* out)> get;  ///< writes as many as `count` says
};

/// Which columns there are beside those of every catalogue.
struct ColumnChoice {
  bool pulse = false;     ///< of a pulse through each finite-fault model
  std::size_t draws = 0;  ///< of the posterior
};

/// A text of each event; may be empty.
struct TextColumn {
  std::string_view name, long_name;
  std::string (*get)(const EventResult&);
};

/// In the order of output.
std::vector<NumberColumn> number_columns(const ColumnChoice& choice);
std::vector<TextColumn> text_columns(bool with_pulse);

/// SI unit of a quantity, by what its name ends with (`_m_s`, `_pa`, `_pa_bound`); "1" where it is a pure number.
std::string_view unit_of(std::string_view name);

/// One text of several, "; " between them.
std::string joined(const std::vector<std::string>& parts);

}  // namespace slipfront::results
