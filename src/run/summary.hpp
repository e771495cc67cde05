#pragma once
/// \file
/// The summary of a finished run: the keys that `--json` prints and that Python attaches to a result.

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::run {

/// A value of a summary. A double that is not finite means that the value is absent.
using Value = std::variant<double, long, std::string>;

/// A key, the function that computes its value from a finished run, and its meaning.
template <class End>
struct SummaryItem {
  std::string key;
  std::function<Value(const End&)> get;
  std::string meaning;
  std::string (*reason)(const End&) = nullptr;  ///< why it has no value, or an empty text
};

/// A pulse that has reached its end.
struct FinishedPulse {
  const scenario::Scenario& scenario;
  const pulse::Run& run;
  double wall;  ///< seconds, including set-up and output
};
std::span<const SummaryItem<FinishedPulse>> pulse_summary();

/// A chain that has reached its end, and how it was run.
struct FinishedChain {
  const chain::Run& run;
  chain::Balance balance;    ///< result of run.balance(), in which all ranks take part
  chain::Averages averages;  ///< result of run.averages(), like `balance`
  double stepping, wall;     ///< seconds of the run only, and of everything
  long steps;                ///< steps in these seconds
  int ranks, threads;
};
std::span<const SummaryItem<FinishedChain>> chain_summary();

/// A row of a summary.
struct SummaryValue {
  std::string key;
  Value value;
  std::string meaning;
  std::string_view unit = {};  ///< its unit, if that depends on the run
  std::string reason = {};     ///< why it has no value; empty if it has one, or if no reason is known
};

/// The unit of a key of a summary in the units of the model, such as "b / A". It is empty for a pure number.
std::string_view unit_of(std::string_view key);
std::string_view unit_of(const SummaryValue& row);
/// The meaning of a key without the unit at its end.
std::string without_unit(std::string_view key, const std::string& meaning);

/// A row in SI units. The meaning ends with the SI unit. `error`, if any, is converted too.
SummaryValue in_si(const SummaryValue& row, const medium::SiUnits& units, double* error = nullptr);
template <class End>
std::vector<SummaryValue> summary(std::span<const SummaryItem<End>> items, const End& end) {
  std::vector<SummaryValue> values;
  values.reserve(items.size());
  for (const SummaryItem<End>& item : items) {
    values.push_back({item.key, item.get(end), item.meaning, {}, {}});
    const double* const number = std::get_if<double>(&values.back().value);
    if (number && !std::isfinite(*number) && item.reason) values.back().reason = item.reason(end);
  }
  return values;
}

}  // namespace slipfront::run
