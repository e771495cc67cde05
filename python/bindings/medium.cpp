#include "slipfront/medium/medium.hpp"

#include "bindings.hpp"

namespace {

using namespace slipfront::medium;

py::dict units_of(double shear_modulus, double speed, double contact_ratio, double asperity_spacing) {
  using namespace pybind11::literals;
  const Units u = units(shear_modulus, speed, contact_ratio, asperity_spacing);
  return py::dict("slip"_a = u.slip, "length"_a = u.length, "time"_a = u.time, "strain"_a = u.strain,
                  "stress"_a = u.stress, "slip_velocity"_a = u.slip_velocity, "velocity"_a = u.velocity);
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
}
