#pragma once
/// \file
/// Readers of the tables of a scenario.

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "scenario/section.hpp"
#include "slipfront/friction/law.hpp"
#include "slipfront/scenario/scenario.hpp"

namespace slipfront::scenario {

// Each function reads and checks its table. Missing keys retain their defaults. \throws InputError.

void read_friction(const Document& document, const TableReader& tables, Scenario& scenario);
void read_medium(const Document& document, medium::Constants& medium);
/// Stiffness of the springs in the unit of the model, and that unit, which depends on the sites that they pull.
std::optional<double> stiffness_of(const Section& section);
ModelUnit unit_of_stiffness(const Section& section);

/// Parameters of friction as a laboratory gives them, in the model's units (docs/friction.md, "In SI units"): a text
/// with a unit, or, where [friction] has a `normal_stress`, forces as friction coefficients.
class FrictionUnits {
 public:
  explicit FrictionUnits(const Section& friction) : friction_(friction) {}

  /// The value of a parameter, or its default, which counts as a friction coefficient where the others do. \throws
  /// InputError that names the key, or the constant of [medium] that it needs.
  double in_model(const friction::Parameter& parameter);
  /// The unit of a parameter; none for a number, a share of the normal stress, and so on.
  static ModelUnit unit_of(const friction::Parameter& parameter);

 private:
  double si_of(const friction::Parameter& parameter);
  double normal_stress_in_si();

  const Section& friction_;
};

/// Whether the scenario is on a plane: it has the table [plane].
bool is_plane(const Document& document);

/// On a plane, the coefficient of viscous friction may be a formula of x and y. Takes that formula from the document,
/// where the number 1 replaces it, and returns it; empty if there is none. \throws InputError for a formula of another
/// law.
std::string take_coefficient(Document& document);

/// Reads [plane] and all formulas of x and y, and tries them over the plane. \throws InputError.
void read_plane(const Document& document, const TableReader& tables, const std::string& coefficient,
                Scenario& scenario);

/// Reads the keys of [output] about a plane. \throws InputError for a probe outside the plane.
void read_plane_output(const Document& document, Plane& plane);

/// The initial stress as the user gave it, before any check.
struct RawStress {
  std::function<double(double)> at;
  Complaint where;                                       ///< the key that defines it, for error messages
  std::optional<std::pair<double, double>> covers = {};  ///< for a table: the range in which it defines the stress
};

/// Reads the profile of [initial], `hold` and `file`, and checks which keys the profile has.
void read_profile(const Section& section, bool on_plane, Initial& initial);

/// Reads [initial] on a line. \throws InputError for keys that do not fit the profile; what `tables` throws.
RawStress read_initial(const Document& document, const TableReader& tables, Initial& initial);

/// Fills scenario.stress, forcing_at and contact_at with functions that check what they return, tries them over the
/// domain, and warns of stress too small to be held. \throws InputError for a sample that is not allowed.
void make_functions(const Document& document, const RawStress& raw, Scenario& scenario);

}  // namespace slipfront::scenario
