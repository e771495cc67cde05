#pragma once
/// \file
/// A scenario file after reading and checks: the initial stress, friction, forcing and loading, the domain, the end
/// time, numerical settings and the output.

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/lattice/chain/problem.hpp"
#include "slipfront/lattice/plane/problem.hpp"
#include "slipfront/theory/medium/constants.hpp"
#include "slipfront/theory/medium/si_units.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::scenario {

/// The smallest stress above 0 and the largest stress that a scenario may have.
using train::smallest_stress;
inline constexpr double largest_stress = 1e6;

/// The largest |x| that is accepted. Differences of positions then neither overflow nor lose the cells between them.
inline constexpr double farthest = 1e9;

/// The solvers of a scenario, on a line and on a plane. The chain and `plane_direct` follow every dislocation.
enum class SolverKind { pulse, chain, plane, plane_direct };

enum class ProfileKind { step, tanh, formula, table, radial, grid };

/// [initial]: stress along x at t = 0. The interface is at rest.
struct Initial {
  ProfileKind profile = ProfileKind::step;
  double stress_left = 0;   ///< for step and tanh; >= 0
  double stress_right = 0;  ///< for step and tanh; 0 is the empty interface
  double width = 1;         ///< for tanh, > 0: right + (left - right)(1 - tanh(x / width))/2
  bool even_ends = true;    ///< far from x = 0 the stress is uniform: stress_left and stress_right
  bool jumps = true;        ///< the stress jumps at x = 0
  double reach = 0;         ///< distance from x = 0 up to which a smooth profile counts as changing
  std::string formula;      ///< stress as a formula of x
  bool hold = false;        ///< a static load balances the initial stress, so that it stays at rest
  std::string file;         ///< CSV or NetCDF with x and stress (radial: r and slip), relative to the scenario file
};

/// [domain]. The solver chooses an end that is not given.
struct Domain {
  std::optional<double> left, right;
};

/// [pulse]
struct PulseOptions {
  int cells = 400;          ///< >= 4
  double tolerance = 1e-6;  ///< tolerance of the adaptive time steps, which serve a stiff source
  double threshold = 1e-3;  ///< slip velocity at an observed front, as a fraction of the peak slip velocity
  pulse::End left = pulse::End::continued, right = pulse::End::continued;
  bool periodic = false;     ///< a ring; `left` and `right` are ignored
  bool many_trains = false;  ///< as many trains at one position as overtake each other, instead of one with shocks
};

/// [chain]
struct ChainOptions {
  std::optional<double> scale;    ///< > 0: x and t are multiplied by it, friction is divided by it; 1 if absent
  std::optional<double> spacing;  ///< spacing of the grid or lattice, > 0, in the scaled x of the chain
  chain::Model model = chain::Model::sine_gordon;
  chain::End left = chain::End::fixed, right = chain::End::fixed;
  bool periodic = false;           ///< a ring; `left` and `right` are ignored
  bool implicit = false;           ///< implicit steps of any length; [loading] always uses them
  double tolerance = 5e-5;         ///< tolerance of implicit steps, 1e-12 to 0.1
  bool phases_of_32_bits = false;  ///< single precision: chain::Problem::phases_of_32_bits
  std::optional<double> window;    ///< averaging window at x = 0, > 0, in the x of the scenario
};

/// [plane], and the initial slip and the formulas of x and y that go with it.
struct Plane {
  plane::Problem problem;  ///< its y is that of the scenario over `wave_speed_ratio`
  int cells = 200;         ///< cells along x of the results, and of the averaged solver on a grid
  bool on_grid = false;    ///< whether the averaged solver follows the mean slip on a grid
  int loops = 120;         ///< cells of the averaged solver across the dislocation lines
  int angles = 128;        ///< directions of the averaged solver
  double wave_speed_ratio = 1;
  std::vector<plane::Point> probes;  ///< in the coordinates of the problem
  bool lines = false;                ///< [output] lines: whether the file has the dislocation lines
};

/// [output]: either a list of times or an interval. The end is always written.
struct Output {
  std::vector<double> times;
  std::optional<double> every;
  int per_event = 0;                   ///< further outputs of each slip event
  std::vector<std::string> variables;  ///< all if empty
  int fronts = 0;                      ///< positions at which a loaded chain records the arrival of slip events
  bool displacement = false;           ///< whether the file of a chain has u at every site
  bool dislocations = false;           ///< whether it has every dislocation
};

struct Scenario {
  std::string title;  ///< followed by the overrides, if any
  std::string file;   ///< as the user gave it
  std::string text;   ///< the TOML of this scenario: as read, or with the overrides applied
  Initial initial;
  friction::Friction friction;
  std::string forcing;  ///< formula F(x, t); no forcing if empty
  chain::Loading loading = {};
  std::string contact;    ///< formula a(x); 1 if empty
  bool substrate = true;  ///< false if [interface] contact is 0: only friction, forces and springs act
  Domain domain;
  double end = 2 * std::numbers::pi;
  std::optional<Plane> plane;  ///< only on a plane; `stress` is then null
  PulseOptions pulse;
  ChainOptions chain;
  medium::Constants medium;                   ///< [medium]
  bool in_si = false;                         ///< a value of another table is in SI units
  std::optional<medium::SiUnits> results_in;  ///< units of results, which run::choose_units sets; absent: of the model
  Output output;
  std::vector<std::string> overrides;  ///< "table.key=value", as given
  std::vector<std::string> warnings;   ///< warnings for the user before the run, one line each

  /// A number of the model in the units of the results, such as "0.1 m"; in the units of the model without a unit.
  std::string in_results(double value, std::string_view unit) const;

  // The following functions are made from the members above. They were checked over the domain, but a call may still
  // throw InputError if a formula fails or a table does not extend to x. Two threads must not call a formula at once.
  std::function<double(double)> stress;                  ///< initial stress at x: 0, or smallest to largest_stress
  std::function<double(double x, double t)> forcing_at;  ///< finite; null if there is no forcing
  bool steady_forcing = true;                            ///< forcing_at, if any, does not depend on t
  std::function<double(double)> contact_at;              ///< a(x) at t = 0; finite, > 0; null if it is 1 everywhere
};

/// Returns the rows of a table file that a scenario names, with the numbers of these columns. The module record
/// implements it, so that this module does not depend on file formats.
using TableReader =
    std::function<std::vector<std::vector<double>>(const std::string& path, const std::vector<std::string>& columns)>;

/// Reads a scenario and applies `overrides` ("table.key=value", in order). A value that is not valid TOML counts as
/// text. Unknown keys, tables and values are errors that name the nearest known one. An [event] table is ignored.
/// Exceptions of `tables` pass through. \throws InputError that names file ("--set" for an override), line, key, value
/// and what is allowed.
Scenario read_scenario(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const TableReader& tables);

/// Returns the first key ("table.key") that two scenario texts do not share, or whose values differ. A title, time.end
/// and the output times may differ. Returns an empty text if there is no such key. \throws InputError for text that is
/// not TOML.
std::string differing_key(std::string_view one, std::string_view other);

/// The command that runs the scenario, quoted for a shell, for the history attribute of a file: "slipfront pulse a.toml
/// --set friction.coefficient=0.5". `scales` are those of the `compare` command.
std::string command_line(const Scenario& scenario, std::string_view command, const std::vector<double>& scales = {});

/// The paths of the files from which a run of this scenario reads: its own, and its tables.
std::vector<std::string> files_of(const Scenario& scenario);

}  // namespace slipfront::scenario
