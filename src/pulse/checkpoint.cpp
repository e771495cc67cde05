#include "pulse/checkpoint.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "slipfront/error.hpp"

namespace slipfront::pulse::checkpoint {
namespace {

constexpr std::uint64_t format = 8;

/// The names of the state variables of friction, in their order.
std::string state_name(const friction::Friction& friction) {
  std::string names = "state:";
  for (const friction::StateVariable& variable : friction.definition().state) names += " " + std::string(variable.name);
  return names;
}

/// Calls number(name, member) or array(name, member) for each member of the cells but the number of steps, in the order
/// of a checkpoint.
template <class SomeCells, class Number, class Array>
void for_each_member(SomeCells& cells, const friction::Friction& friction, const Number& number, const Array& array) {
  number("time", cells.time);
  number("step", cells.step);
  array("charge", cells.charge);
  array("tanh_psi", cells.s);
  array("face_momentum", cells.face_momentum);
  number("entered_left", cells.entered_left);
  number("entered_right", cells.entered_right);
  number("crossing_time", cells.crossing_time);
  number("crossing_position", cells.crossing_position);
  array(state_name(friction), cells.state);
  array("widths, momenta, totals", cells.unknowns);
}

std::vector<double> get_array(bytes::Reader& reader, std::string_view name) {
  if (reader.text() != name) refuse();
  return reader.vector();
}

}  // namespace

void refuse() {
  throw InputError({.key = "resume",
                    .problem = "the saved state is of another version or scenario",
                    .allowed = "a file of this version and scenario"});
}

void put_number(bytes::Writer& writer, std::string_view name, double value) {
  writer.put_text(name);
  writer.put(std::vector<double>{value});
}

double get_number(bytes::Reader& reader, std::string_view name) {
  const std::vector<double> values = get_array(reader, name);
  if (values.size() != 1) refuse();
  return values[0];
}

void put(bytes::Writer& writer, const Cells& cells, const friction::Friction& friction) {
  writer.put(format);
  put_number(writer, "steps", static_cast<double>(cells.steps));
  for_each_member(
      cells, friction, [&](std::string_view name, double value) { put_number(writer, name, value); },
      [&](std::string_view name, const std::vector<double>& values) {
        writer.put_text(name);
        writer.put(values);
      });
}

Cells get_cells(bytes::Reader& reader, const friction::Friction& friction) {
  if (reader.get<std::uint64_t>() != format) refuse();
  Cells cells;
  const double steps = get_number(reader, "steps");
  if (!(steps >= 0 && steps < 9e15)) refuse();
  cells.steps = static_cast<long>(steps);
  for_each_member(
      cells, friction, [&](std::string_view name, double& value) { value = get_number(reader, name); },
      [&](std::string_view name, std::vector<double>& values) { values = get_array(reader, name); });
  if (cells.unknowns.size() != Values::size(cells.size())) refuse();
  return cells;
}

}  // namespace slipfront::pulse::checkpoint
