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
  type.attr("__module__") = "slipfront";  // where users find it
}

}  // namespace

void bind_errors(py::module_& m) {
  bind<slipfront::InputError>(m, "InputError", PyExc_ValueError,
                              "Bad usage or input; one line says what, its value and what is allowed.");
  bind<slipfront::FileError>(m, "FileError", PyExc_OSError, "A file could not be read or written.");
  bind<slipfront::NumericsError>(m, "NumericsError", PyExc_RuntimeError,
                                 "The numerics gave up; one line says what, where and at what time.");
  // What these bindings give to Python can be converted, but where memory ends: pybind11 says RuntimeError there.
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(std::move(thrown));
    } catch (const py::cast_error& error) {
      if (!std::string_view(error.what()).starts_with("Unable to convert call argument")) throw;
      PyErr_NoMemory();
    }
  });
}
