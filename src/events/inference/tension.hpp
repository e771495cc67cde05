#pragma once

#include <vector>

#include "slipfront/events/inference/posterior.hpp"

namespace slipfront::inference {

/// Leaves out each observation in turn and predicts it from the others. Returns those at 2 or more standard deviations,
/// the largest first.
std::vector<Tension> tensions(const catalogue::Observation& observation, const medium::Defaults& defaults,
                              const Sampling& sampling);

/// Least misfit, in standard deviations squared, at which we look for tensions.
inline constexpr double suspicious_misfit = 4;

}  // namespace slipfront::inference
