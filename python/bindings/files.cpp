#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "runs/record/netcdf/netcdf.hpp"
#include "system/files/whole_file.hpp"
#include "system/machine.hpp"
#include "text/characters.hpp"

namespace {

using namespace slipfront;

/// A variable of a NetCDF file: name, dimensions, values and attributes. The values are an array of float64, int64 or
/// int8, or a list of texts.
using Variable = std::tuple<std::string, std::vector<std::string>, py::object, record::Attributes>;

template <class T>
std::vector<T> numbers(const py::object& values) {
  const auto array = py::array_t<T, py::array::c_style>::ensure(values);
  if (!array) throw py::error_already_set();
  return {array.data(), array.data() + array.size()};
}

record::DatasetVariable variable_of(const Variable& given) {
  const auto& [name, dimensions, values, attributes] = given;
  record::DatasetVariable variable{name, dimensions, {}, attributes};
  if (!py::isinstance<py::array>(values))
    variable.values = values.cast<std::vector<std::string>>();
  else if (py::isinstance<py::array_t<double>>(values))
    variable.values = numbers<double>(values);
  else if (py::isinstance<py::array_t<std::int64_t>>(values))
    variable.values = numbers<std::int64_t>(values);
  else
    variable.values = numbers<std::int8_t>(values);
  return variable;
}

void write_dataset(const std::string& path, std::vector<std::pair<std::string, std::size_t>> dimensions,
                   const std::vector<Variable>& variables, const record::Attributes& attributes) {
  record::Dataset dataset{std::move(dimensions), {}, attributes};
  for (const Variable& variable : variables) dataset.variables.push_back(variable_of(variable));
  const py::gil_scoped_release others_may_run;
  record::write_dataset(path, dataset);
}

/// Context manager for Python code that calls the NetCDF library. It waits for the lock without the GIL, because the
/// thread that holds the lock may need the GIL.
class NetcdfLock {
 public:
  void enter() {
    const py::gil_scoped_release others_may_run;
    lock_ = record::netcdf::lock_netcdf();
  }
  void leave(const py::args&) { lock_.unlock(); }

 private:
  std::unique_lock<std::recursive_mutex> lock_;
};

}  // namespace

void bind_files(py::module_& m) {
  m.def("printable", [](const std::string& text) { return printable(text); });
  m.def("usable_memory", usable_memory);
  m.def("sensible_threads", sensible_threads);
  m.def("read_text", record::read_text);
  m.def("write_file", record::write_text, py::call_guard<py::gil_scoped_release>());
  m.def("require_other_file", record::require_other_file);
  m.def("write_dataset", write_dataset);
  py::class_<NetcdfLock>(m, "NetcdfLock")
      .def(py::init<>())
      .def("__enter__", &NetcdfLock::enter)
      .def("__exit__", &NetcdfLock::leave);
  m.def("require_unbroken_seal", record::require_unbroken_seal, py::call_guard<py::gil_scoped_release>());
}
