#pragma once
/// \file
/// What a finished run is summed up by: the keys that `--json` prints and that Python attaches to a result.

#include <string>
#include <variant>
#include <vector>

#include "slipfront/chain/run.hpp"
#include "slipfront/pulse/run.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::setup {

struct SummaryValue {
  const char* key;
  std::variant<double, long, std::string> value;  ///< a double that is not finite: there is none
  const char* meaning;
};

/// Of a pulse run that has reached its end; `wall` in seconds, set-up and output included.
std::vector<SummaryValue> pulse_summary(const scenario::Scenario& scenario, const pulse::Run& run, double wall);

/// How a chain was run.
struct ChainWork {
  double stepping, wall;  ///< seconds: of the run alone, of everything
  long steps;             ///< of these seconds
  int ranks, threads;
};
/// Of a chain run that has reached its end. `balance` is run.balance(), which all ranks take part in.
std::vector<SummaryValue> chain_summary(const chain::Run& run, const chain::Run::Balance& balance,
                                        const ChainWork& work);

}  // namespace slipfront::setup
