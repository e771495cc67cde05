#pragma once

#include <cstddef>

#include "friction/train_means/asinh_average.hpp"

/// The force f = a asinh(w G) at many positions, as vector code chosen at run time.
namespace slipfront::friction {

/// f at each speed. Returns whether all were in the range of the vector code; others are those that are not
/// within_exponents.
bool forces(const AsinhForce& law, std::size_t size, const double* speed, const double* theta, double* force);

bool within_exponents(const AsinhForce& law, double theta);

/// Solves v + weight f(v) = free for each of at most 64 positions; returns whether all are done. Positions with
/// done = 0 are left to others: their G exceeds the range of a double.
bool speeds_after(const AsinhForce& law, std::size_t size, const double* free, double weight, const double* theta,
                  double* speed, double* done);

}  // namespace slipfront::friction
