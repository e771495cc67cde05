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

Ray::Ray(const Loops& loops, double angle) : loops_(loops) {
  if (loops.angles == 1) return;
  const double turned = angle / loops.turn(), whole = std::floor(turned), f = turned - whole;
  const auto n = static_cast<std::ptrdiff_t>(loops.angles), first = static_cast<std::ptrdiff_t>(whole) - 1;
  for (std::ptrdiff_t j = 0; j < 4; ++j)
    column_.at(static_cast<std::size_t>(j)) = static_cast<std::size_t>(((first + j) % n + n) % n);
  weight_ = {-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
             (f + 1) * f * (f - 1) / 6};
}

double Ray::of(const double* row) const {
  double sum = 0;
  for (std::size_t j = 0; j < 4; ++j) sum += weight_[j] * row[column_[j]];
  return sum;
}

std::size_t Ray::first_face_inside(double r) const {
  std::size_t outside = 0, inside = loops_.rows;
  while (inside - outside > 1) {
    const std::size_t middle = (outside + inside) / 2;
    (r > face(middle) ? inside : outside) = middle;
  }
  return inside;
}

double Ray::loops_outside(double r) const {
  if (r >= face(0)) return 0;
  if (r <= face(loops_.rows)) return loops_.label.back();
  const std::size_t j = first_face_inside(r), first = std::min(j >= 2 ? j - 2 : 0, loops_.rows - 3);
  std::array<double, 4> faces{};
  for (std::size_t i = 0; i < 4; ++i) faces[i] = face(first + i);
  const double q = lagrange(4, faces.data(), &loops_.label[first], r);
  return std::clamp(q, loops_.label[j - 1], loops_.label[j]);
}

double Ray::at(const std::vector<double>& values, double r) const {
  if (r > face(0) || r <= face(loops_.rows)) return 0;
  const std::size_t inner = first_face_inside(r), row = inner - 1;
  const auto centre = [&](std::size_t i) { return (face(i) + face(i + 1)) / 2; };
  const std::size_t next = r > centre(row) ? (row > 0 ? row - 1 : row) : std::min(row + 1, loops_.rows - 1);
  if (next == row) return cell(values, row);
  const double here = centre(row), there = centre(next);
  return cell(values, row) + (cell(values, next) - cell(values, row)) * (r - here) / (there - here);
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
