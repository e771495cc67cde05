#pragma once

#include <string>
#include <string_view>

#include "foundation/bytes.hpp"
#include "pulse/grid/cells.hpp"
#include "slipfront/friction/friction.hpp"

/// The state of a run as bytes: each array under its name.
namespace slipfront::pulse::checkpoint {

[[noreturn]] void refuse();

void put_number(bytes::Writer& writer, std::string_view name, double value);
double get_number(bytes::Reader& reader, std::string_view name);

void put(bytes::Writer& writer, const Cells& cells, const friction::Friction& friction);
/// \throws InputError if the bytes are not those of cells with this friction.
Cells get_cells(bytes::Reader& reader, const friction::Friction& friction);

}  // namespace slipfront::pulse::checkpoint
