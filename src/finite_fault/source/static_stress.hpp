#pragma once
/// \file
/// Static stress drop on a planar segment from its slip.

#include <vector>

#include "finite_fault/source/source.hpp"

namespace slipfront::finite_fault {

/// Stress drop in Pa at the centre of each subfault, in the direction of its rake, in the order of the points. Negative
/// values are increases of stress.
///
/// The medium is a homogeneous full space with the shear modulus `shear_modulus_of(segment)`. Each subfault slips
/// uniformly. In wave numbers the change of the shear stress i by slip D_j is (Andrews 1980)
///
///     -(mu / 2) (k delta_ij + nu / (1 - nu) k_i k_j / k) D_j
///
/// We sum its exact integral over every rectangle instead of a Fourier series, so nothing is periodic. The free surface
/// and other segments are left out.
std::vector<double> static_stress_drop(const SourceSegment& segment, double poisson_ratio);

/// Mean shear modulus of a segment in Pa, weighted by slip. If nothing slips, all subfaults count equally.
double shear_modulus_of(const SourceSegment& segment);

}  // namespace slipfront::finite_fault
