#pragma once
/// \file
/// A scenario file, read and checked: what is on the interface at t = 0, what acts on it, where, how long, and what to
/// write.

#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/chain/problem.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/medium/constants.hpp"
#include "slipfront/pulse/problem.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::scenario {

/// The least stress above 0 and the greatest that are accepted.
using train::smallest_stress;
inline constexpr double largest_stress = 1e6;

/// The largest |x| that is accepted. Differences of positions then neither overflow nor lose the cells between them.
inline constexpr double farthest = 1e9;

enum class ProfileKind { step, tanh, formula, table };

/// [initial]: stress along x at t = 0, everything at rest.
struct Initial {
  ProfileKind profile = ProfileKind::step;
  double stress_left = 0;   ///< of step and tanh; >= 0
  double stress_right = 0;  ///< 0 is the empty interface
  double width = 1;         ///< of tanh, > 0: right + (left - right)(1 - tanh(x / width))/2
  bool even_ends = true;    ///< goes on beyond the change around x = 0 at stress_left and stress_right
  bool jumps = true;        ///< at x = 0
  double reach = 0;         ///< how far from x = 0 a smooth change is felt
  std::string formula;      ///< of x
  bool hold = false;        ///< a static load keeps at rest what is not in equilibrium
  std::string file;         ///< CSV or NetCDF with columns / variables x and stress, relative to the scenario file
};

/// [domain]; either end may be left to the solver.
struct Domain {
  std::optional<double> left, right;
};

/// [pulse]
struct PulseOptions {
  int cells = 400;          ///< >= 4
  double tolerance = 1e-6;  ///< of the adaptive time steps, where the source is stiff
  double threshold = 1e-3;  ///< of the observer who sees fronts, in units of the peak slip velocity
  pulse::End left = pulse::End::continued, right = pulse::End::continued;
  bool periodic = false;  ///< a ring: `left` and `right` do not count
};

/// [chain]
struct ChainOptions {
  std::optional<double> scale;    ///< > 0: x and t stretched by it, friction divided by it; 1 where none is asked for
  std::optional<double> spacing;  ///< of the grid or lattice, > 0, in the chain's own (stretched) x
  chain::Model model = chain::Model::sine_gordon;
  chain::End left = chain::End::fixed, right = chain::End::fixed;
  bool periodic = false;         ///< a ring: `left` and `right` do not count
  bool implicit = false;         ///< steps of any length; with [loading] they always are
  double tolerance = 5e-5;       ///< of implicit steps, 1e-12 to 0.1
  std::optional<double> window;  ///< of averages at x = 0, > 0, in the scenario's x
};

/// [output]: either a list of times or an interval; the end is always written.
struct Output {
  std::vector<double> times;
  std::optional<double> every;
  std::vector<std::string> variables;  ///< empty: all
};

struct Scenario {
  std::string title;  ///< with overrides, goes on to name them
  std::string file;   ///< as named by the user
  std::string text;   ///< the TOML that was read; with overrides, the TOML they make of it. Reads back as this scenario
  Initial initial;
  friction::Friction friction;
  std::string forcing;  ///< formula F(x, t); empty: none
  chain::Loading loading = {};
  std::string contact;    ///< formula a(x); empty: 1
  bool substrate = true;  ///< false where [interface] contact is 0: nothing but friction, forces and springs
  Domain domain;
  double end = 2 * std::numbers::pi;
  PulseOptions pulse;
  ChainOptions chain;
  medium::Constants medium;  ///< [medium]
  Output output;
  std::vector<std::string> overrides;  ///< "table.key=value", as given
  std::vector<std::string> warnings;   ///< what the user should know before the run, one line each

  // Made from the above, checked, ready to call (not from two threads at once where they are formulas). They were tried
  // over the domain, but a call may still throw InputError where a formula fails or a table does not reach.
  std::function<double(double)> stress;                  ///< initial stress at x: 0, or smallest to largest_stress
  std::function<double(double x, double t)> forcing_at;  ///< finite; null: no forcing
  bool steady_forcing = true;                            ///< forcing_at, if any, does not depend on t
  std::function<double(double)> contact_at;              ///< at t = 0; finite, > 0; null: 1 everywhere
};

/// Gives two columns of a table file named in a scenario (record/ knows files; this room does not).
using TableReader = std::function<std::vector<std::pair<double, double>>(const std::string& path, const std::string& x,
                                                                         const std::string& y)>;

/// Reads a scenario and applies `overrides` ("table.key=value", in order; a value that is no TOML is taken as a text).
/// Unknown keys, tables and values are errors that name the nearest known one. An [event] table is not looked at.
/// \throws InputError with file ("--set" for an override), line, key, value and what is allowed; what `tables` throws.
Scenario read_scenario(std::string_view text, const std::string& file, const std::vector<std::string>& overrides,
                       const TableReader& tables);

/// The command that runs the scenario, for a file's history, in words that a shell reads back: "slipfront pulse a.toml
/// --set friction.coefficient=0.5". `scales` are those asked of compare.
std::string command_line(const Scenario& scenario, std::string_view command, const std::vector<double>& scales = {});

}  // namespace slipfront::scenario
