#pragma once
/// \file
/// Writes a kinematic source in the Standard Rupture Format, version 2.0 (Graves 2014).

#include <string>

#include "finite_fault/source/source.hpp"

namespace slipfront::record {

/// The text of the file. Its comments hold `history` and the notes of the source.
std::string srf_text(const finite_fault::FiniteSource& source, const std::string& history);

/// Writes it completely or not at all. \throws FileError with path and reason.
void write_srf(const std::string& path, const finite_fault::FiniteSource& source, const std::string& history);

}  // namespace slipfront::record
