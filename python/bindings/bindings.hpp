#pragma once
/// \file
/// The compiled half of the Python package: one bind_ function a room. What it takes and gives is for the pure-Python
/// half, which checks shapes and builds Datasets.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "slipfront/description.hpp"

namespace py = pybind11;

/// Contiguous doubles, one-dimensional.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

void bind_errors(py::module_& m);
void bind_relations(py::module_& m);
void bind_train(py::module_& m);
void bind_friction_ratio(py::module_& m);
void bind_medium(py::module_& m);
void bind_pulse(py::module_& m);
void bind_chain(py::module_& m);
void bind_compare(py::module_& m);
void bind_event(py::module_& m);
void bind_sweep(py::module_& m);
void bind_files(py::module_& m);

/// (name, long_name, dimensional_unit, reference)
inline py::tuple described(const slipfront::Description& about) {
  return py::make_tuple(py::str(about.name.data(), about.name.size()),
                        py::str(about.long_name.data(), about.long_name.size()),
                        py::str(about.dimensional_unit.data(), about.dimensional_unit.size()),
                        py::str(about.reference.data(), about.reference.size()));
}
