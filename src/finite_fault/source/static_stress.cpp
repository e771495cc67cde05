#include "finite_fault/source/static_stress.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace slipfront::finite_fault {
namespace {

/// Stress at a distance (along strike, up dip) from the centre of a rectangle that slips by 1, over mu / (4 pi).
struct Kernel {
  double along, up;  ///< stress along strike by slip along strike, and up dip by slip up dip
  double cross;      ///< stress in one direction by slip in the other
};

/// Second derivatives of the integral of 1 / r over the rectangle. In space, 1 / k is 1 / (2 pi r) and k_i is -i d_i.
Kernel kernel(double x, double y, double length, double width, double poisson_ratio) {
  double xx = 0, yy = 0, xy = 0;
  for (const int i : {1, -1})
    for (const int j : {1, -1}) {
      const double a = x + i * length / 2, b = y + j * width / 2, r = std::hypot(a, b);
      xx -= i * j * b / (a * r);
      yy -= i * j * a / (b * r);
      xy += i * j / r;
    }
  const double mode_2 = 1 / (1 - poisson_ratio);
  return {mode_2 * xx + yy, xx + mode_2 * yy, (mode_2 - 1) * xy};
}

/// Components along strike and up dip, of slip or of stress.
struct InPlane {
  double along, up;
};
InPlane direction(const SourcePoint& p) {
  const double rake = p.rake * std::numbers::pi / 180;
  return {std::cos(rake), std::sin(rake)};
}

/// Sums the stress of all subfaults at subfault (column, row). Rows are counted downwards.
InPlane traction_at(const SourceSegment& s, const std::vector<Kernel>& kernels, const std::vector<InPlane>& slips,
                    std::size_t column, std::size_t row) {
  InPlane sum{0, 0};
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i) {
      const InPlane& slip = slips[j * s.along_strike + i];
      const std::size_t across = i > column ? i - column : column - i, down = j > row ? j - row : row - j;
      const Kernel& k = kernels[down * s.along_strike + across];
      const double sign = (i > column) == (j < row) ? 1 : -1;  // the cross term is odd in x and in y
      sum.along += k.along * slip.along + sign * k.cross * slip.up;
      sum.up += k.up * slip.up + sign * k.cross * slip.along;
    }
  return sum;
}

}  // namespace

double shear_modulus_of(const SourceSegment& segment) {
  double slip = 0, weighted = 0, plain = 0;
  for (const SourcePoint& p : segment.points) {
    slip += std::fabs(p.slip);
    weighted += std::fabs(p.slip) * p.shear_modulus();
    plain += p.shear_modulus() / static_cast<double>(segment.points.size());
  }
  return slip > 0 ? weighted / slip : plain;
}

std::vector<double> static_stress_drop(const SourceSegment& s, double poisson_ratio) {
  std::vector<Kernel> kernels;
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i)
      kernels.push_back(kernel(static_cast<double>(i) * s.cell_length, static_cast<double>(j) * s.cell_width,
                               s.cell_length, s.cell_width, poisson_ratio));
  std::vector<InPlane> slips;
  for (const SourcePoint& p : s.points) {
    const InPlane d = direction(p);
    slips.push_back({p.slip * d.along, p.slip * d.up});
  }
  const double unit = shear_modulus_of(s) / (4 * std::numbers::pi);
  std::vector<double> drops;
  for (std::size_t j = 0; j < s.down_dip; ++j)
    for (std::size_t i = 0; i < s.along_strike; ++i) {
      const InPlane t = traction_at(s, kernels, slips, i, j), d = direction(s.points[j * s.along_strike + i]);
      drops.push_back(-unit * (t.along * d.along + t.up * d.up));
    }
  return drops;
}

}  // namespace slipfront::finite_fault
