#include "slipfront/events/catalogue/measured.hpp"

#include <cstddef>
#include <string>

#include "bindings.hpp"
#include "slipfront/error.hpp"

slipfront::medium::Dimension dimension_named(const std::string& name) {
  using slipfront::medium::Dimension;
  if (name == "velocity") return Dimension::velocity;
  if (name == "pressure") return Dimension::pressure;
  if (name == "density") return Dimension::density;
  if (name == "length") return Dimension::length;
  if (name == "time") return Dimension::time;
  return Dimension::ratio;
}

namespace {

using namespace slipfront;
using catalogue::MeasuredValue;

/// Position of a text, for its error: file, line (0 if there is none) and column.
struct Position {
  std::string file;
  std::size_t line;
  std::string column;
};

[[noreturn]] void throw_at(const Position& position, Complaint complaint) {
  complaint.file = position.file;
  complaint.line = position.line;
  complaint.key = position.column;
  throw InputError(complaint);
}

MeasuredValue parse(const std::string& text, const std::string& dimension, const std::string& unit,
                    const std::string& file, std::size_t line, const std::string& column) {
  const Position position{file, line, column};
  MeasuredValue measured;
  try {
    measured = catalogue::parse_measured(text, dimension_named(dimension), unit);
  } catch (const InputError& error) {
    throw_at(position, error.complaint());
  }
  if (!(measured.low > 0)) throw_at(position, {.value = text, .problem = "not positive", .allowed = "> 0"});
  return measured;
}

/// A single number in SI units of a text such as "30 GPa". `name` is that of the parameter, for the error.
double quantity(const std::string& name, const std::string& text, const std::string& dimension) {
  const medium::Dimension kind = dimension_named(dimension);
  try {
    const medium::Span span = medium::parse_quantity(text, kind, medium::si_unit(kind));
    if (span.low == span.high) return span.low;
  } catch (const InputError& error) {
    throw_at({"", 0, name}, error.complaint());
  }
  throw_at({"", 0, name}, {.value = text, .problem = "a range", .allowed = "one number with its unit"});
}

[[noreturn]] void refuse(const std::string& file, std::size_t line, const std::string& column, const std::string& value,
                         const std::string& problem, const std::string& allowed) {
  throw InputError({.file = file, .line = line, .key = column, .value = value, .problem = problem, .allowed = allowed});
}

}  // namespace

void bind_measured(py::module_& m) {
  py::class_<MeasuredValue>(m, "Measured")
      .def_property_readonly("is_lognormal",
                             [](const MeasuredValue& self) { return self.shape == MeasuredValue::Shape::lognormal; })
      .def_property_readonly("middle", &MeasuredValue::middle)
      .def_property_readonly("is_exact", &MeasuredValue::is_exact)
      .def_property_readonly("is_range", &MeasuredValue::is_range)
      .def_readonly_static("least_even_share", &MeasuredValue::least_even_share)
      .def("quantile", py::vectorize(&MeasuredValue::quantile))
      .def("share_below", py::vectorize(&MeasuredValue::share_below))
      .def("likelihood", py::vectorize(&MeasuredValue::likelihood));
  m.def("parse_measured", parse);
  m.def("quantity", quantity);
  m.def("refuse", refuse);
}
