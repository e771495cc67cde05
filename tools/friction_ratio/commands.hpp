#pragma once

namespace slipfront::friction_ratio {

/// Prints src/friction_ratio/coefficients.cpp. Returns the exit code.
int make();

/// Compares the table with the solver at random points. Returns the exit code: 1 if an error exceeds the stated one.
int check(long points);

}  // namespace slipfront::friction_ratio
