#pragma once

#include <cstdio>
#include <string>

namespace slipfront::friction_ratio {

/// Opens NAME.csv in the current folder, or ends the program with the reason.
std::FILE* table_file(const std::string& name);

/// Writes the tables of ratios. Returns the exit code.
int make();

/// Writes the tables of observed fronts and stress drops. Returns the exit code.
int make_front();

/// Compares the table with the solver at random points. Returns the exit code: 1 if an error exceeds the stated one.
int check(long points);
int check_front(long points);

}  // namespace slipfront::friction_ratio
