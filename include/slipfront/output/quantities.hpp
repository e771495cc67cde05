#pragma once
/// \file
/// Declarations of the numbers of a run along a line. Files, tables, JSON, Python and the explorer are loops over them.
///
/// To add a number of a snapshot, add a member to Snapshot, its line to quantities.cpp, and set it where a run is
/// observed (pulse/observe, chain/run_observer.cpp). If it follows from the rest of a snapshot at every level of
/// theory, set it in complete(). Numbers of a whole run are declared in pulse/quantities.cpp and chain/quantities.cpp.

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "slipfront/description.hpp"
#include "slipfront/output/snapshot.hpp"

namespace slipfront::output {

/// The solvers that measure a number. Others have no value.
enum class MeasuredBy { all, pulse, chain };

/// A number of a snapshot.
struct Scalar {
  Description about;
  double (*get)(const Snapshot&);
  void (*set)(Snapshot&, double);
  MeasuredBy by = MeasuredBy::all;
  std::string_view heading = {};  ///< heading of its column in a comparison of levels; empty: it is not compared
};
std::span<const Scalar> scalars();

/// A value of a run. A double that is not finite means that the value is absent.
using Value = std::variant<double, long, std::string, std::vector<double>>;

enum class Kind { result, text, of_machine };

/// A number of a whole run, or a text. One `of_machine` depends on the machine, and not only on the scenario.
template <class Run>
struct Quantity {
  Description about;
  Value (*get)(const Run&);
  Kind kind = Kind::result;
  std::string_view (*unit)(const Run&) = nullptr;  ///< its unit, if that depends on the run
};

/// The time and the machine that a run took.
struct Spent {
  double stepping = 0, wall = 0;  ///< seconds of the run only, and of everything
  long steps = 0;                 ///< steps in these seconds
  int ranks = 1, threads = 1;
};

/// Descriptions that several solvers share.
inline constexpr Description time_axis = {"time", "time", "b / (c A)", "Eq. 3"};
inline constexpr Description end_time = {"time", "end of the run", "b / (c A)", "Eq. 3"};
inline constexpr Description step_count = {"steps", "number of time steps", "", ""};
inline constexpr Description wall_time = {"wall_seconds", "seconds of the whole command", "", ""};
inline constexpr Description scale_factor = {
    "scale", "scale of a chain: x and t are stretched by it, friction is divided by it", "", "Eq. 3", "no chain"};
inline constexpr Description slip_window = {"window", "averaging window of the slip at x = 0, of a chain", "b / A",
                                            "Eq. 5", "no chain"};
inline constexpr Description velocity_window = {
    "smooth_window", "averaging window of velocities and stresses at x = 0, of a chain", "b / A", "Eq. 5", "no chain"};

/// Sets the numbers that follow from the rest of a snapshot.
void complete(Snapshot& snapshot, const Schedule& schedule);

}  // namespace slipfront::output
