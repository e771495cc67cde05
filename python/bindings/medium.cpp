#include "slipfront/theory/medium/medium.hpp"

#include <pybind11/stl.h>

#include <array>
#include <string>

#include "bindings.hpp"
#include "slipfront/theory/medium/si_units.hpp"

namespace {

using namespace slipfront::medium;

py::dict units_of(double shear_modulus, double speed, double contact_ratio, double asperity_spacing) {
  using namespace pybind11::literals;
  const Units u = units(shear_modulus, speed, contact_ratio, asperity_spacing);
  return py::dict("slip"_a = u.slip, "length"_a = u.length, "time"_a = u.time, "strain"_a = u.strain,
                  "stress"_a = u.stress, "slip_velocity"_a = u.slip_velocity, "velocity"_a = u.velocity);
}

/// Returns (value, name, whether it is of slip between the faces). `values` has those of mu, nu, A, b and c.
py::tuple unit_in_si(const std::string& unit, const std::array<double, 5>& values) {
  const auto [mu, nu, A, b, c] = values;
  const UnitInSi in_si = slipfront::medium::in_si(unit, {.mu = mu, .nu = nu, .A = A, .b = b, .c = c});
  return py::make_tuple(in_si.value, in_si.name, in_si.between_faces);
}

}  // namespace

void bind_medium(py::module_& m) {
  m.def("speed_from_p_wave", py::vectorize(speed_from_p_wave));
  m.def("speed_from_s_wave", py::vectorize(speed_from_s_wave));
  m.def("speed_from_shear_modulus", py::vectorize(speed_from_shear_modulus));
  m.def("poisson_ratio", py::vectorize(poisson_ratio));
  m.def("plastic_contact_ratio", py::vectorize(plastic_contact_ratio));
  m.def("stress_unit", py::vectorize(stress_unit));
  m.def("slip_velocity_unit", py::vectorize(slip_velocity_unit));
  m.def("traction_unit", py::vectorize(traction_unit));
  m.def("printed_traction_unit", py::vectorize(printed_traction_unit));
  m.def("units", units_of);
  m.def("unit_in_si", unit_in_si);
  m.def("unit_symbols", symbols_of);
}
