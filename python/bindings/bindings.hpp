#pragma once
/// \file
/// The compiled part of the Python package, with one bind_ function for each module of the library. Only the Python
/// part of the package calls it: that part checks the shapes of arrays and builds the Datasets.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>

#include "slipfront/description.hpp"
#include "slipfront/text/quantity.hpp"

namespace py = pybind11;

/// Array of doubles, contiguous. The Python part passes arrays of one dimension.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

void bind_errors(py::module_& m);
void bind_relations(py::module_& m);
void bind_train(py::module_& m);
void bind_friction_ratio(py::module_& m);
void bind_medium(py::module_& m);
void bind_measured(py::module_& m);
void bind_runs(py::module_& m);
void bind_compare(py::module_& m);
void bind_event(py::module_& m);
void bind_observations(py::module_& m);
void bind_sweep(py::module_& m);
void bind_keys(py::module_& m);
void bind_files(py::module_& m);

/// The dimension of this name: "length", "velocity", "pressure" or "density", and otherwise a ratio.
slipfront::medium::Dimension dimension_named(const std::string& name);

/// The tuple (name, long_name, dimensional_unit, reference).
inline py::tuple described(const slipfront::Description& about) {
  return py::make_tuple(py::str(about.name.data(), about.name.size()),
                        py::str(about.long_name.data(), about.long_name.size()),
                        py::str(about.dimensional_unit.data(), about.dimensional_unit.size()),
                        py::str(about.reference.data(), about.reference.size()));
}
