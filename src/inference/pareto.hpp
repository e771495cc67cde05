#pragma once

#include <vector>

namespace slipfront::inference {

/// Shape k of the generalised Pareto distribution of the largest importance weights, of which min(n / 5, 3 sqrt n) are
/// taken: the diagnosis of Pareto-smoothed importance sampling (Vehtari, Simpson, Gelman, Yao & Gabry 2024, J. Mach.
/// Learn. Res. 25(72)), fitted as by Zhang & Stephens (2009, Technometrics 51, 316). 0 where those weights
/// are alike within a factor of two, infinite for fewer than 25 weights.
double pareto_k(std::vector<double> weights);

/// Above this k a mean over `samples` weights is not to be trusted (their Eq. 13).
double most_pareto_k(double samples);

}  // namespace slipfront::inference
