#pragma once
/// \file
/// Readers of the tables of a scenario.

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "scenario/functions.hpp"
#include "scenario/section.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

/// The initial stress as the user gave it, before any check.
struct RawStress {
  std::function<double(double)> at;
  Complaint where;                                       ///< the key that defines it, for error messages
  std::optional<std::pair<double, double>> covers = {};  ///< for a table: the range in which it defines the stress
};

/// The range of x in which to try functions: the domain, or an estimate of the domain that a solver will choose from
/// the reach of the initial state, or from what its table covers.
std::pair<double, double> trial_range(const Domain& domain, double reach,
                                      const std::optional<std::pair<double, double>>& covers);

// Each function reads and checks its table. Missing keys retain their defaults. \throws InputError.

void read_friction(const Document& document, const TableReader& tables, const RawStress& raw, Scenario& scenario);
void read_medium(const Document& document, medium::Constants& medium);
void read_loading(const Document& document, const TableReader& tables, Scenario& scenario);
/// Unit of the stiffness of springs, which depends on the sites that they pull.
ModelUnit unit_of_stiffness(const Section& loading);

/// The line or plane on which friction acts, in x and y of the scenario.
struct Interface {
  Extent extent;
  bool plane = false;
  double ratio = 1;      ///< y of the scenario over y of the problem
  bool is_known = true;  ///< otherwise a solver may choose a larger one
};
/// `range` is that of a line, trial_range.
Interface interface_of(const Document& document, const Domain& domain, const std::pair<double, double>& range);

/// Reads numbers of a table that vary along the interface: by a formula of x (and y on a plane), or by a column of a
/// table file.
class AlongReader {
 public:
  using At = std::function<double(double, double)>;
  AlongReader(const Section& section, const TableReader& tables, const Interface& interface)
      : section_(section), tables_(tables), interface_(interface) {}

  /// The values of a key that varies, in the unit of the model. They keep `limits`.
  At read(std::string_view key, const Value& value, ModelUnit unit, const Limits& limits) const;
  /// With its range on a grid of positions, so that a formula which fails does so before the run. A value that is the
  /// same there and on a finer grid does not vary: `at` is null.
  friction::AlongInterface in_range(At at) const;

 private:
  const Section& section_;
  const TableReader& tables_;
  Interface interface_;
};

/// The key "stiffness" or "velocity" of [loading] in the unit of the model. `at` is null unless it varies.
/// \throws InputError if it is missing or not allowed; it names the position if it varies.
friction::AlongInterface read_springs(const Section& loading, const AlongReader& reader, std::string_view key);

/// Parameters of friction as a laboratory gives them, in the model's units (docs/friction.md, "In SI units"): a text
/// with a unit, or, where [friction] has a `normal_stress`, forces as friction coefficients. A parameter and the normal
/// stress may vary: by a formula of x (and y on a plane), or by a column of a table.
class FrictionUnits {
 public:
  FrictionUnits(const Section& friction, const TableReader& tables, const Interface& interface);

  /// The value of a parameter, or its default, which counts as a friction coefficient where the others do. `at` is null
  /// unless it varies. \throws InputError that names the key, the position if it varies, or the constant of [medium]
  /// that it needs.
  friction::AlongInterface in_model(const friction::Parameter& parameter) const;
  /// The normal stress over its largest value, if it varies.
  const std::optional<friction::AlongInterface>& share_of_normal_stress() const { return share_; }
  /// Whether any key is a formula or a column.
  bool vary() const { return vary_; }
  /// The unit of a parameter; none for a number, a share of the normal stress, and so on.
  static ModelUnit unit_of(const friction::Parameter& parameter);

 private:
  double si_of(const friction::Parameter& parameter) const;
  double uniform(const friction::Parameter& parameter) const;
  bool has_curve() const { return friction_.has("formula") || friction_.has("file"); }
  double normal_stress_in_si() const;

  const Section& friction_;
  AlongReader along_;
  bool vary_ = false;
  double largest_normal_stress_ = 0;  ///< in Pa, if it is a formula or a column
  std::optional<friction::AlongInterface> share_;
};

/// Whether the scenario is on a plane: it has the table [plane].
bool is_plane(const Document& document);

/// Reads [plane] and all formulas of x and y, and tries them over the plane. \throws InputError.
void read_plane(const Document& document, const TableReader& tables, Scenario& scenario);

/// Reads the keys of [output] about a plane. \throws InputError for a probe outside the plane.
void read_plane_output(const Document& document, Plane& plane);

/// Reads the profile of [initial], `hold` and `file`, and checks which keys the profile has.
void read_profile(const Section& section, bool on_plane, Initial& initial);

/// Reads [initial] on a line. \throws InputError for keys that do not fit the profile; what `tables` throws.
RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial);

/// Fills scenario.stress, forcing_at and contact_at with functions that check what they return, tries them over the
/// domain, and warns of stress too small to be held. \throws InputError for a sample that is not allowed.
void make_functions(const Document& document, const RawStress& raw, Scenario& scenario);

}  // namespace slipfront::scenario
