#include "slipfront/text/output/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "slipfront/text/output/run.hpp"
#include "slipfront/text/output/snapshot.hpp"
#include "system/archive.hpp"

namespace slipfront::output {
namespace {

template <auto... path>
double member(const Snapshot& snapshot) {
  return (snapshot.*....*path);
}

template <auto... path>
void set_member(Snapshot& snapshot, double value) {
  (snapshot.*....*path) = value;
}

template <auto... path>
constexpr Scalar scalar(Description about, MeasuredBy by = MeasuredBy::all, std::string_view heading = {}) {
  return {about, member<path...>, set_member<path...>, by, heading};
}

using S = Snapshot;
using By = MeasuredBy;
using Error = ErrorRule;

/// From docs/theory/1_chain.md: F_d b / (2 pi) an asperity, 1 / A asperities in the unit of x, a chain of width b.
constexpr std::string_view energy = "mu b^2 A / (2 pi^2 (1 - nu))";

constexpr std::string_view no_origin = "x = 0 is outside the domain";
constexpr std::string_view no_front = "there is no such front, or it has left the domain";
constexpr std::string_view not_observed = "no slip velocity exceeds the threshold, or the front has left the domain";

constexpr Scalar declared[] = {
    scalar<&S::slip_at_origin>(
        {"slip_at_origin", "slip at x = 0 since time 0", "b / (2 pi)", "Eq. 4", no_origin, Error::slip}, By::all,
        "slip(0)"),
    scalar<&S::slip_velocity_at_origin>(
        {"slip_velocity_at_origin", "slip velocity at x = 0", "c A / pi", "Eq. 5", no_origin, Error::slip_velocity},
        By::all, "W(0)"),
    scalar<&S::stress_at_origin>(
        {"stress_at_origin", "shear stress at x = 0", "mu A / pi", "Eq. 5", no_origin, Error::stress}),
    scalar<&S::peak_slip_velocity>(
        {"peak_slip_velocity", "greatest slip velocity", "c A / pi", "Eq. 5", {}, Error::peak}, By::all, "peak W"),
    scalar<&S::peak_position>({"peak_position", "position of the greatest slip velocity", "b / A", "Eq. 5",
                               "nothing slips in the domain", Error::peak_position}),
    scalar<&S::fronts, &Fronts::trailing>(
        {"trailing_front", "position of the fast front, the foot of the slip velocity on the stressed side", "b / A",
         "Eqs. 8-10", no_front, Error::front},
        By::pulse),
    scalar<&S::fronts, &Fronts::trailing_characteristic>(
        {"trailing_characteristic", "position of the fast front as a characteristic", "b / A", "Eqs. 8-10", no_front,
         Error::characteristic},
        By::pulse),
    scalar<&S::fronts, &Fronts::leading>({"leading_front", "position of the slow front, into the less stressed side",
                                          "b / A", "Eqs. 8-10", no_front, Error::front},
                                         By::all, "leading"),
    scalar<&S::fronts, &Fronts::trailing_observed>(
        {"trailing_front_observed", "where slip is first seen by an observer with a threshold, from the stressed side",
         "b / A", "Eqs. 8-10", not_observed, Error::observed_front},
        By::all, "trailing*"),
    scalar<&S::fronts, &Fronts::leading_observed>(
        {"leading_front_observed", "where slip is first seen by an observer with a threshold, from the other side",
         "b / A", "Eqs. 8-10", not_observed, Error::observed_front},
        By::all, "leading*"),
    scalar<&S::energy, &Energy::elastic>(
        {"energy_elastic", "energy of the state at rest with the same density", energy, "Eq. 6", {}, Error::change}),
    scalar<&S::energy, &Energy::kinetic>(
        {"energy_kinetic", "energy less the elastic energy", energy, "Eq. 6", {}, Error::change}),
    scalar<&S::energy, &Energy::dissipated>(
        {"energy_dissipated", "energy lost to friction since time 0", energy, "Eq. 7", {}, Error::change}),
    scalar<&S::energy, &Energy::supplied>(
        {"energy_supplied", "energy supplied by the forcing since time 0", energy, "Eq. 7", {}, Error::change}),
    scalar<&S::energy, &Energy::through_ends>(
        {"energy_through_ends", "energy that came in through the ends of the domain since time 0", energy, "Eq. 7",
         "only a pulse measures it", Error::change},
        By::pulse),
    scalar<&S::energy, &Energy::shocks>(
        {"energy_shocks", "energy lost where trains run into each other", energy, "Eq. 7",
         "no trains have run into each other, or pulse.trains = \"many\" lets them pass without loss", Error::change},
        By::pulse),
    scalar<&S::energy, &Energy::residual>(
        {"energy_residual", "rest of the balance of energy: what is lost where trains run into each other, and errors",
         energy, "Eq. 7", "only a pulse measures it", Error::change},
        By::pulse),
    scalar<&S::energy, &Energy::phonons>(
        {"energy_phonons", "energy of a chain less that of uniform trains with its averages", energy, "Eq. 6",
         "the surface is smooth (interface.contact = 0), and there are no trains without a substrate"},
        By::chain),
    scalar<&S::potency>(
        {"potency", "slip since time 0, integrated along the interface", "b^2 / (2 pi A)", "Eq. 4", {}, Error::change}),
    scalar<&S::energy, &Energy::loading>(
        {"energy_loading", "energy in the springs that load a chain", energy, "Eq. 1", {}, Error::change}),
    scalar<&S::loading_force>({"loading_force", "force F on a site, mean over a chain that springs load everywhere",
                               "mu A^2 / (pi (1 - nu))", "Eq. 1", "no springs load a chain everywhere", Error::change}),
    scalar<&S::loading_stress>({"loading_stress", "shear stress at the end that a spring pulls", "mu A / pi", "Eq. 1",
                                "no spring pulls an end of a chain", Error::change}),
    scalar<&S::energy, &Energy::contacts>({"energy_contacts",
                                           "energy that contacts supplied as their strength changed",
                                           energy,
                                           "docs/friction.md",
                                           {},
                                           Error::change}),
    scalar<&S::pore_pressure_at_origin>({"pore_pressure_at_origin",
                                         "pore pressure around x = 0, over the normal stress", "", "docs/friction.md",
                                         no_origin, Error::change}),
};

}  // namespace

std::span<const Scalar> scalars() { return declared; }

void complete(Snapshot& snapshot, const Schedule& schedule) {
  snapshot.potency = 0;
  const std::vector<double>&slip = snapshot.profile.slip, &x = schedule.x_edges;
  for (std::size_t i = 0; i < slip.size(); ++i) snapshot.potency += slip[i] * (x[i + 1] - x[i]);
}

void sort(std::vector<Dislocation>& dislocations) {
  std::sort(dislocations.begin(), dislocations.end(), [](const Dislocation& a, const Dislocation& b) {
    return std::tie(a.x, a.level, a.sign) < std::tie(b.x, b.level, b.sign);
  });
}

Observed observed_fronts(const std::vector<double>& x, const std::vector<double>& speed, double level, double left,
                         double right) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = x.size();
  std::size_t first = 0, last = n;
  while (first < n && !(speed[first] >= level)) ++first;
  if (!(level > 0) || first == n) return {none, none};
  while (!(speed[last - 1] >= level)) --last;
  const auto crossing = [&](std::size_t slow, std::size_t fast) {
    return std::lerp(x[slow], x[fast], (level - speed[slow]) / (speed[fast] - speed[slow]));
  };
  return {first > 0 ? crossing(first - 1, first) : left, last < n ? crossing(last, last - 1) : right};
}

std::string Run::saved() const { return slipfront::saved(*this); }

}  // namespace slipfront::output
