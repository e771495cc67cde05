// libFuzzer target: no change of a saved state may crash a run that resumes from it. The first byte selects the run.
// Every three of the other bytes describe one change of the saved state: two give the offset, the third the new value.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "events/results/columns.hpp"
#include "events/results/evaluate.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/events/catalogue/read.hpp"
#include "slipfront/lattice/chain/run.hpp"

using namespace slipfront;

namespace {

const output::Schedule schedule{.times = {0, 1}, .x_edges = {-1, -0.5, 0, 0.5}, .threshold = 1e-3};

double stress(double x) { return x < 0 ? 0.855 : 0.0; }

template <class Run>
void go(Run& run, int steps) {
  run.go([&steps] { return --steps <= 0; });
}

pulse::Problem pulse_problem() {
  pulse::Problem p;
  p.stress = stress;
  p.left = -1;
  p.right = 0.5;
  p.cells = 8;
  return p;
}

chain::ScaledProblem chain_problem() {
  chain::ScaledProblem small;
  small.stress = stress;
  small.left = -1;
  small.right = 0.5;
  small.scale = 60;
  return small;
}

std::string saved_pulse() {
  pulse::Run run(pulse_problem(), schedule);
  go(run, 2);
  return run.saved();
}

/// A chain with ageing contacts and dilating pores, whose state is also saved.
chain::ScaledProblem contacts_problem(bool implicit) {
  chain::ScaledProblem small = chain_problem();
  for (const friction::Definition* law : friction::laws())
    if (law->name == "rate-and-state")
      small.friction = {*law, {0.05, 0.01, 0.015, 0.05, 0.05, 0, 0, 0.1, 0.2, 0.02, 1, 0.1}};
  small.contact = [friction = small.friction](double x) { return friction.contact_at_start(x); };
  small.implicit = implicit;
  return small;
}

std::string saved(const chain::ScaledProblem& problem) {
  chain::Run run(problem, schedule, chain::Execution{});
  go(run, 1);
  return run.saved();
}

std::vector<catalogue::Entry> entries() {
  std::vector<catalogue::Entry> all;
  catalogue::read_events(
      "name,rupture_velocity,slip_velocity,contact_ratio\n"
      "known,3.0 +- 0.2 km/s,0.5 m/s,0.01 +- 0.002\ntrades off,3.0 +- 0.2 km/s,0.5 m/s,\nfast,9 km/s,,\n",
      "a.csv", [&](catalogue::Entry&& entry) { all.push_back(std::move(entry)); });
  return all;
}

constexpr results::EvaluationOptions plan{.sampling = {.samples = 20}};

std::string saved_events() {
  std::vector<results::EventResult> results;
  for (catalogue::Entry& entry : entries()) results.push_back(results::evaluate(std::move(entry), {}, plan));
  return results::serialize(results);
}

/// Evaluates events from saved results, and reads all columns that a file would contain.
void go_on_with_events(const std::string& state) {
  std::vector<results::SavedResult> found = results::deserialize(state);
  for (catalogue::Entry& entry : entries()) {
    if (found.empty()) return;
    const results::EventResult result = results::evaluate(std::move(entry), {}, plan, std::move(found.back()));
    found.pop_back();
    for (const auto& column : results::number_columns({.pulse = true, .draws = 5})) {
      std::vector<double> out(column.count);
      column.get(result, out.data());
    }
    for (const auto& column : results::text_columns(true)) column.get(result);
  }
}

std::string changed(std::string state, const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t i = 0; i + 2 < size; i += 3) {
    const std::size_t where = bytes[i] + 256u * bytes[i + 1];
    if (where < state.size())
      state[where] = static_cast<char>(bytes[i + 2]);
    else
      state.resize(state.size() - std::min(state.size(), where % 64));
  }
  return state;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const std::string pulse_state = saved_pulse(), event_state = saved_events();
  static const chain::ScaledProblem chains[] = {chain_problem(), contacts_problem(false), contacts_problem(true)};
  static const std::string chain_states[] = {saved(chains[0]), saved(chains[1]), saved(chains[2])};
  if (size == 0) return 0;
  try {
    const std::size_t which = bytes[0] % 5;
    if (which == 4) {
      go_on_with_events(changed(event_state, bytes + 1, size - 1));
    } else if (which == 3) {
      pulse::Run run(pulse_problem(), schedule, changed(pulse_state, bytes + 1, size - 1), {});
      go(run, 3);
    } else {
      chain::Run run(chains[which], schedule, chain::Execution{}, changed(chain_states[which], bytes + 1, size - 1),
                     {});
      go(run, 1);
    }
  } catch (const InputError&) {
  } catch (const NumericsError&) {
  }
  return 0;
}
