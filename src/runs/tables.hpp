#pragma once
/// \file
/// Reads the files that a scenario names: tables and finite-fault models.

#include <string>
#include <vector>

namespace slipfront::run {

/// Whether a file is a finite-fault model, by its content.
bool is_fault_model(const std::string& path);

/// Rows of some columns, as record::read_table. A finite-fault model has the columns x and y, in m from the
/// hypocentre, and slip, in m: the mean slip from which a rupture makes the slip of the model
/// (finite_fault::slip_to_come). \throws FileError, InputError.
std::vector<std::vector<double>> read_table(const std::string& path, const std::vector<std::string>& columns);

}  // namespace slipfront::run
