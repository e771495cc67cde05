#pragma once

#include <functional>

namespace slipfront::pulse {

/// y' = f(t, y).
using Rates = std::function<void(double t, const double* y, double* dy)>;

}  // namespace slipfront::pulse
