#pragma once

namespace slipfront::friction_ratio {

/// Prints src/friction_ratio/coefficients.cpp. Returns the exit code.
int make();

/// Prints src/friction_ratio/front_coefficients.cpp. Returns the exit code.
int make_front();

/// Compares the table with the solver at random points. Returns the exit code: 1 if an error exceeds the stated one.
int check(long points);
int check_front(long points);

}  // namespace slipfront::friction_ratio
