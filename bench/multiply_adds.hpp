#pragma once

#include <cstddef>

/// 32 multiply-adds per value, in four independent sequences: what the arithmetic units can do at most.
void multiply_adds(double* v, std::size_t n, double a, double b);
