#include "plane/averaged/observe.hpp"

#include <algorithm>
#include <array>

#include "foundation/math/lagrange.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::plane {

using std::numbers::pi;

std::vector<double> slip_velocities(const Loops& loops, const LoopEquations& equations) {
  std::vector<double> w(loops.cells());
  for (std::size_t i = 0; i < w.size(); ++i)
    w[i] = 2 * pi * equations.velocity()[i] / equations.spacing()[i];  // U_t = 2 pi r_t / l
  return w;
}

namespace {

/// The four angles around a direction, and the weights of the cubic through them.
struct AngleWeights {
  std::array<std::size_t, 4> column{};
  std::array<double, 4> weight{0, 1, 0, 0};

  AngleWeights(const Loops& loops, double angle) {
    if (loops.angles == 1) return;
    const double turned = angle / loops.turn(), whole = std::floor(turned), f = turned - whole;
    const auto n = static_cast<std::ptrdiff_t>(loops.angles), first = static_cast<std::ptrdiff_t>(whole) - 1;
    for (std::ptrdiff_t j = 0; j < 4; ++j)
      column.at(static_cast<std::size_t>(j)) = static_cast<std::size_t>(((first + j) % n + n) % n);
    weight = {-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
              (f + 1) * f * (f - 1) / 6};
  }
  double of(const double* row) const {
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j) sum += weight.at(j) * row[column.at(j)];
    return sum;
  }
};

}  // namespace

std::vector<double> along_ray(const Loops& loops, const std::vector<double>& values, double angle) {
  const AngleWeights at(loops, angle);
  std::vector<double> ray(values.size() / loops.angles);
  for (std::size_t row = 0; row < ray.size(); ++row) ray[row] = at.of(&values[row * loops.angles]);
  return ray;
}

double loops_outside(const Loops& loops, const std::vector<double>& faces, double r) {
  if (r >= faces.front()) return 0;
  if (r <= faces.back()) return loops.label.back();
  const auto after = std::upper_bound(faces.begin(), faces.end(), r, std::greater<>());  // first face inside r
  const auto j = static_cast<std::size_t>(after - faces.begin());
  const std::size_t first = std::min(j >= 2 ? j - 2 : 0, faces.size() - 4);
  const double q = pulse::lagrange(4, &faces[first], &loops.label[first], r);
  return std::clamp(q, loops.label[j - 1], loops.label[j]);
}

double volume(const Loops& loops) {
  const auto area = [&](std::size_t face) {
    double sum = 0;
    for (std::size_t k = 0; k < loops.angles; ++k) {
      const double r = loops.r[face * loops.angles + k];
      sum += r * r / 2 * loops.turn();
    }
    return sum;
  };
  double sum = 0;
  for (std::size_t row = 0; row < loops.rows; ++row) sum += loops.charge(row) * (area(row) + area(row + 1)) / 2;
  return 2 * pi * sum;
}

LoopEnergy energy(const Loops& loops, const LoopEquations& equations) {
  LoopEnergy total{0, 0};
  for (std::size_t i = 0; i < loops.cells(); ++i) {
    const std::size_t inner = i + loops.angles;
    const double a = equations.contact(i);
    const double area = (loops.r[i] - loops.r[inner]) * (loops.r[i] + loops.r[inner]) / 2 * loops.turn();
    const State train{equations.phi()[i], equations.psi()[i]};
    const train::Averages now = train::averages(train, a);
    const double k = now.k;  // the gradient of the slip
    const double at_rest =
        k / a >= train::smallest_stress ? train::averages(train::at_rest(k / a), a).H : 8 * a * k / (2 * pi);
    total.elastic += at_rest * area;
    total.kinetic += (now.H - at_rest) * area;
  }
  return total;
}

}  // namespace slipfront::plane
