#include "slipfront/chain/initial.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "slipfront/elliptic/jacobi.hpp"
#include "slipfront/error.hpp"
#include "slipfront/rupture/inverse.hpp"

namespace slipfront::chain {
namespace {

using std::numbers::pi;
using Stress = std::function<double(double)>;

double checked(const Stress& stress, double x) {
  const double k = stress(x);
  if (!(k >= 0) || !std::isfinite(k))
    throw InputError({.key = "initial stress at x = " + std::to_string(x),
                      .value = std::to_string(k),
                      .problem = "not a stress",
                      .allowed = "0 or greater, finite"});
  return k;
}

/// Integral of the stress over [a, b]: Gauss-Legendre with three points, halved where the stress jumps or bends.
double integral(const Stress& stress, double a, double b, int depth = 0) {
  const double middle = (a + b) / 2, half = (b - a) / 2, node = std::sqrt(0.6) * half;
  const double f0 = checked(stress, middle - node), f1 = checked(stress, middle), f2 = checked(stress, middle + node);
  if (depth < 40 && std::fabs(f0 - 2 * f1 + f2) > 1e-3 * (f0 + f2))
    return integral(stress, a, middle, depth + 1) + integral(stress, middle, b, depth + 1);
  return half * (5 * f0 + 8 * f1 + 5 * f2) / 9;
}

/// u of the train with stress k where the phase (2 pi a dislocation, 0 at its centre) is theta: Eq. 4 with
/// beta x = K theta / pi.
class LocalTrain {
 public:
  double operator()(double k, double theta) {
    if (k != stress_) {
      at_ = elliptic::at_psi(rupture::psi_of_stress(k));
      stress_ = k;
    }
    const double turn = std::nearbyint(theta / (2 * pi));  // the period by itself: exact whatever the phase
    return 2 * elliptic::jacobi(at_.K * (theta / pi - 2 * turn), at_).coamplitude - 2 * pi * turn;
  }

 private:
  double stress_ = -1;
  elliptic::AtPsi at_{};
};

}  // namespace

Motion static_train(const Stress& stress, const Grid& grid, bool whole) {
  const std::size_t n = grid.sites;
  std::vector<double> k(n), charge(n, 0.0);  // charge: dislocations left of the site
  double lost = 0;                           // compensated: 1e8 sites
  for (std::size_t j = 0; j < n; ++j) {
    k[j] = checked(stress, grid.x(j));
    if (j == 0) continue;
    const double more = integral(stress, grid.x(j - 1), grid.x(j)) / (2 * pi) - lost;
    charge[j] = charge[j - 1] + more;
    lost = (charge[j] - charge[j - 1]) - more;
  }
  // Around a periodic chain there is one more interval, from the last site to the first.
  const double all = whole ? charge[n - 1] + integral(stress, grid.x(n - 1), grid.x(n)) / (2 * pi) : charge[n - 1];
  Motion motion;
  motion.u.assign(n, 0.0);
  LocalTrain train;
  double wells = 0;  // dislocations right of what is being filled: u = 2 pi wells there
  std::size_t end = n;
  while (end > 0) {  // stretch by stretch, from the right
    const bool empty = k[end - 1] == 0;
    std::size_t begin = end;
    while (begin > 0 && (k[begin - 1] == 0) == empty) --begin;
    if (empty) {
      for (std::size_t j = begin; j < end; ++j) motion.u[j] = 2 * pi * wells;
    } else {
      const double from = begin > 0 ? charge[begin - 1] : charge[0], to = end < n ? charge[end] : all;
      const bool closed = (begin > 0 && end < n) || whole;
      const double count = closed ? std::nearbyint(to - from) : to - from, stretch = closed ? count / (to - from) : 1;
      // Half a spacing between the last dislocation and the right edge; from the left edge where that alone is empty.
      const bool from_left = begin > 0 && end == n && !whole;
      for (std::size_t j = begin; j < end; ++j) {
        if (closed && count == 0) {
          motion.u[j] = 2 * pi * wells;
          continue;
        }
        const double turns = from_left ? charge[j] - from - 0.5 : (charge[j] - to) * stretch + 0.5;
        const double right = from_left ? wells + std::nearbyint(count) - 1 : wells;
        motion.u[j] = train(k[j] * stretch, 2 * pi * turns) + 2 * pi * right;
      }
      wells += std::nearbyint(to - from);
    }
    end = begin;
  }
  return motion;
}

}  // namespace slipfront::chain
