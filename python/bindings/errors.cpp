#include "bindings.hpp"
#include "slipfront/error.hpp"

void bind_errors(py::module_& m) {
  py::register_exception<slipfront::InputError>(m, "InputError", PyExc_ValueError).attr("__doc__") =
      "Bad usage or input; one line says what, its value and what is allowed.";
  py::register_exception<slipfront::FileError>(m, "FileError", PyExc_OSError).attr("__doc__") =
      "A file could not be read or written.";
  py::register_exception<slipfront::NumericsError>(m, "NumericsError", PyExc_RuntimeError).attr("__doc__") =
      "The numerics gave up; one line says what, where and at what time.";
}
