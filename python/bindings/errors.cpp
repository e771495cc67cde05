#include <exception>
#include <string_view>
#include <utility>

#include "bindings.hpp"
#include "slipfront/error.hpp"

namespace {

template <class Error>
void bind(py::module_& m, const char* name, PyObject* base, const char* meaning) {
  auto& type = py::register_exception<Error>(m, name, base);
  type.attr("__doc__") = meaning;
  type.attr("__module__") = "slipfront";  // the package from which users import it
}

}  // namespace

void bind_errors(py::module_& m) {
  bind<slipfront::InputError>(
      m, "InputError", PyExc_ValueError,
      "An argument or the input is wrong. The message names it, its value and what is allowed.");
  bind<slipfront::FileError>(m, "FileError", PyExc_OSError, "A file could not be read or written.");
  bind<slipfront::NumericsError>(m, "NumericsError", PyExc_RuntimeError,
                                 "The computation failed. The message states what failed, where and at what time.");
  // These bindings return only values that can be converted to Python, unless memory runs out. pybind11 then throws
  // cast_error, a RuntimeError in Python. We raise MemoryError instead.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const py::cast_error& error) {
      if (!std::string_view(error.what()).starts_with("Unable to convert call argument")) throw;
      PyErr_NoMemory();
    }
  });
}
