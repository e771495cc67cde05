#pragma once

#include <vector>

namespace slipfront::inference {

/// Shape k of the generalised Pareto distribution of the min(n / 5, 3 sqrt n) largest of n importance weights. It is
/// the diagnostic of Pareto-smoothed importance sampling (Vehtari, Simpson, Gelman, Yao & Gabry 2024, J. Mach. Learn.
/// Res. 25(72)), fitted with the method of Zhang & Stephens (2009, Technometrics 51, 316). It is 0 if these weights
/// differ by less than a factor of two, and infinite for fewer than 25 weights.
double pareto_k(std::vector<double> weights);

/// The largest k at which a mean over `samples` weights is reliable (Eq. 13 of Vehtari et al.).
double most_pareto_k(double samples);

}  // namespace slipfront::inference
