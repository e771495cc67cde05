/// \file
/// The functions of panel "Pulse" and of the figures of the paper. They run the modulation equations piece by piece, so
/// that the page can stop a run and show its results so far.

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <type_traits>
#include <variant>

#include "math/digits.hpp"
#include "scenario.hpp"
#include "slipfront/averages/pulse/run.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/problem.hpp"
#include "slipfront/text/output/quantities.hpp"
#include "system/machine.hpp"

namespace slipfront::explorer {
namespace {

struct Session {
  std::unique_ptr<pulse::Run> run;
  std::vector<std::string> warnings;  ///< warnings about the scenario
};

std::map<int, Session>& sessions() {
  static std::map<int, Session> all;
  return all;
}

Session& session(int handle) {
  const auto found = sessions().find(handle);
  if (found == sessions().end()) throw InputError({.key = "handle", .problem = "no such run"});
  return found->second;
}

constexpr int most_frames = 2000;

/// One number of each snapshot, beginning with number `first`.
template <class Get>
std::vector<double> series(const std::vector<output::Snapshot>& all, std::size_t first, const Get& get) {
  std::vector<double> values;
  for (std::size_t i = first; i < all.size(); ++i) values.push_back(get(all[i]));
  return values;
}

/// Puts a field of all snapshots, one after the other, beginning with number `first`.
void put_field(Object& object, const char* name, const std::vector<output::Snapshot>& all, std::size_t first,
               std::vector<double> output::Profile::*field) {
  std::vector<double> values;
  for (std::size_t i = first; i < all.size(); ++i)
    values.insert(values.end(), (all[i].profile.*field).begin(), (all[i].profile.*field).end());
  object.numbers(name, values);
}

void put_series(Object& object, const std::vector<output::Snapshot>& all, std::size_t first) {
  object.numbers("time", series(all, first, [](const output::Snapshot& s) { return s.time; }));
  for (const output::Scalar& number : output::scalars())
    object.numbers(number.about.name, series(all, first, number.get));
}

/// Puts the numbers and texts of a run.
void put_numbers(Object& object, const pulse::Run& run) {
  for (const auto& number : pulse::quantities())
    std::visit(
        [&](const auto& value) {
          if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::vector<double>>)
            object.put(number.about.name, value);
        },
        number.get({run, 0}));
}

}  // namespace

/// Starts a run with the number `handle`. If `frames` > 1, the run has that many evenly spaced snapshots instead of
/// those of the scenario. If `look` > 0, it has only snapshots at t = 0 and at that time, so that a slider gets an
/// answer at once. `closure` is 0 for that of the scenario, 1 for "consistent", 2 for "paper".
SLIPFRONT_EXPORT const char* pulse_begin(int handle, const char* toml, int frames, double look, int closure) {
  return answer([=] {
    const scenario::Scenario s = scenario_of(toml);
    pulse::Problem problem = scenario::pulse_problem(s);
    if (closure > 0)
      problem.friction = problem.friction.with(closure == 1 ? friction::Closure::consistent : friction::Closure::paper);
    if (!problem.friction.defined_by(problem.friction.closure()))
      throw InputError({.key = "friction.closure",
                        .value = "paper",
                        .problem = "the paper's closure is not defined for laws with state variables",
                        .allowed = "consistent"});
    output::Schedule schedule = scenario::pulse_schedule(s, problem);
    if (look > 0) {
      schedule.times = {0, std::min(look, s.end)};
    } else if (frames > 1) {
      schedule.times.clear();
      for (int i = 0; i < std::min(frames, most_frames); ++i) schedule.times.push_back(s.end * i / (frames - 1));
    }
    Object object;
    std::vector<double> x;
    for (std::size_t i = 0; i + 1 < schedule.x_edges.size(); ++i)
      x.push_back((schedule.x_edges[i] + schedule.x_edges[i + 1]) / 2);
    object.numbers("x", x).put("end", s.end).put("frames", static_cast<long>(schedule.times.size()));
    object.put("closure", name_of(problem.friction.closure())).put("warnings", s.warnings);
    sessions()[handle] = {std::make_unique<pulse::Run>(std::move(problem), std::move(schedule)), s.warnings};
    return object;
  });
}

/// Continues the run for about so many milliseconds. Returns the snapshots, beginning with number `first`. If the run
/// fails, the answer contains the error and the snapshots before it.
SLIPFRONT_EXPORT const char* pulse_go(int handle, double milliseconds, int first) {
  return answer([=] {
    Session& s = session(handle);
    const auto begun = Clock::now();
    std::string gave_up;
    try {
      if (!s.run->finished()) s.run->go([&] { return 1e3 * seconds_since(begun) > milliseconds; });
    } catch (const NumericsError& error) {
      gave_up = error.what();
    }
    Object object;
    object.put("finished", s.run->finished()).put("now", s.run->time());
    put_numbers(object, *s.run);
    if (!gave_up.empty()) object.put("gave_up", gave_up);
    const std::vector<output::Snapshot>& all = s.run->snapshots();
    const std::size_t from = std::min(all.size(), static_cast<std::size_t>(std::max(first, 0)));
    put_series(object, all, from);
    put_field(object, "W", all, from, &output::Profile::W);
    put_field(object, "Sigma", all, from, &output::Profile::k);
    put_field(object, "U", all, from, &output::Profile::U);
    put_field(object, "slip", all, from, &output::Profile::slip);
    if (s.run->finished()) {
      std::vector<std::string> warnings = s.warnings;
      for (const std::string& w : s.run->warnings()) warnings.push_back(w);
      object.put("warnings", warnings);
    }
    return object;
  });
}

SLIPFRONT_EXPORT const char* pulse_end(int handle) {
  return answer([=] {
    sessions().erase(handle);
    return Object();
  });
}

}  // namespace slipfront::explorer
