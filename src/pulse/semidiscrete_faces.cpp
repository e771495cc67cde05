// What is at the faces: by WENO on the Riemann invariants.

#include <algorithm>
#include <cmath>

#include "kernels.hpp"
#include "semidiscrete.hpp"
#include "weno.hpp"

namespace slipfront::pulse {

void Semidiscrete::find_faces() {
  if (collides_) std::fill(shocked_.begin(), shocked_.end(), 0.0);
  collides_ = false;
  for (const Stretch& r : stretches_) {
    cell_means(r.end - r.begin, at_.phi.data() + r.begin, phi_mean_.data() + r.begin);
    cell_means(r.end - r.begin, at_.psi.data() + r.begin, psi_mean_.data() + r.begin);
  }
  for (const Stretch& r : stretches_) find_faces(r);
}

/// A train that has left a wall ends in a free edge.
void Semidiscrete::find_edges(const double* y) {
  const std::size_t n = size();
  const ConstValues values(y, n);
  if (setup_.left == Edge::wall)
    stretches_.front().left = edge_at_wall(values.left_edge(), setup_.left_wall, values.width(0));
  if (setup_.right != Edge::wall) return;
  double x = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) x += values.width(i);
  stretches_.back().right = edge_at_wall(x, setup_.right_wall, values.width(size() - 1));
}

/// What lies beyond the ends of a stretch, for the faces near them: beyond a free edge psi = 0, and the edge moves at
/// the invariant that reaches it; a wall is a mirror, which changes the sign of phi.
void Semidiscrete::fill_ghosts(const Stretch& stretch, double* plus, double* minus) const {
  const auto n = static_cast<std::ptrdiff_t>(stretch.end - stretch.begin);
  for (std::ptrdiff_t g = 1; g <= static_cast<std::ptrdiff_t>(ghosts); ++g) {
    const std::ptrdiff_t inside = std::min(g, n) - 1;
    switch (stretch.left) {
      case Edge::free:
      case Edge::continued:
        plus[-g] = stretch.left == Edge::free ? minus[0] : plus[0];
        minus[-g] = minus[0];
        break;
      case Edge::wall:
        plus[-g] = -minus[inside];
        minus[-g] = -plus[inside];
        break;
      case Edge::ring:
        plus[-g] = plus[n - 1 - inside];
        minus[-g] = minus[n - 1 - inside];
    }
    switch (stretch.right) {
      case Edge::free:
      case Edge::continued:
        plus[n - 1 + g] = plus[n - 1];
        minus[n - 1 + g] = stretch.right == Edge::free ? plus[n - 1] : minus[n - 1];
        break;
      case Edge::wall:
        plus[n - 1 + g] = -minus[n - 1 - inside];
        minus[n - 1 + g] = -plus[n - 1 - inside];
        break;
      case Edge::ring:
        plus[n - 1 + g] = plus[inside];
        minus[n - 1 + g] = minus[inside];
    }
  }
}

void Semidiscrete::find_faces(const Stretch& stretch) {
  const std::size_t n = stretch.end - stretch.begin;
  double* plus = invariant_plus_.data() + ghosts;
  double* minus = invariant_minus_.data() + ghosts;
  const double scale = invariants(n, phi_mean_.data() + stretch.begin, psi_mean_.data() + stretch.begin, plus, minus);
  fill_ghosts(stretch, plus, minus);
  double* face_phi = face_phi_.data() + stretch.begin;
  double* face_psi = face_psi_.data() + stretch.begin;
  weno_faces(n + 1, plus, minus, scale, face_phi, face_psi);
  flatten_shocks(stretch, plus, minus, scale);
  // At a free edge psi = 0; phi + psi (or phi - psi) is the invariant that reaches it. A train that moves away from a
  // wall leaves it.
  if (stretch.left == Edge::free || stretch.left == Edge::wall) {
    const double away = weno5(minus[2], minus[1], minus[0], minus[-1], minus[-2]) * scale;
    if (stretch.left == Edge::free || away > 0) {
      face_phi[0] = away;
      face_psi[0] = 0;
    } else {
      face_phi[0] = 0;
    }
  }
  if (stretch.right == Edge::free || stretch.right == Edge::wall) {
    const double* p = plus + n;
    const double away = weno5(p[-3], p[-2], p[-1], p[0], p[1]) * scale;
    if (stretch.right == Edge::free || away < 0) {
      face_phi[n] = away;
      face_psi[n] = 0;
    } else {
      face_phi[n] = 0;
    }
  }
  if (stretch.left == Edge::ring) {  // one face
    face_phi[n] = face_phi[0];
    face_psi[n] = face_psi[0];
  }
}

/// Where trains collide so hard that a shock stands, high order rings behind it: there faces fall back on the plain
/// values of the cells, as in the PPM of Colella & Woodward (1984). `plus` and `minus` are the scaled invariants.
void Semidiscrete::flatten_shocks(const Stretch& stretch, const double* plus, const double* minus, double scale) {
  constexpr double weak = 0.5, strong = 1;  // fall of phi over two cells, beside the mean of psi
  constexpr std::ptrdiff_t reach = 5;
  if (!(hardest_collision(stretch.end - stretch.begin, plus, minus, weak) > 0)) return;
  const auto n = static_cast<std::ptrdiff_t>(stretch.end - stretch.begin);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double fall = plus[i - 1] + minus[i - 1] - plus[i + 1] - minus[i + 1];
    const double density = plus[i - 1] - minus[i - 1] + plus[i + 1] - minus[i + 1];
    if (!(fall > weak * density)) continue;
    collides_ = true;
    for (std::ptrdiff_t near = std::max<std::ptrdiff_t>(i - reach, 0); near <= std::min(i + reach, n - 1); ++near)
      shocked_[stretch.begin + static_cast<std::size_t>(near)] = 1;
    const double share = std::fmin((fall / density - weak) / (strong - weak), 1.0);
    for (std::ptrdiff_t f = std::max<std::ptrdiff_t>(i - reach + 1, 1); f <= std::min(i + reach, n - 1); ++f) {
      const std::size_t face = stretch.begin + static_cast<std::size_t>(f);
      const double a = plus[f - 1] * scale, b = minus[f] * scale;
      face_phi_[face] += share * ((a + b) / 2 - face_phi_[face]);
      face_psi_[face] += share * (std::fmax((a - b) / 2, 0.0) - face_psi_[face]);
    }
  }
}

/// Two cells over which phi falls by more than the psi of both are further apart in velocity than any wave between them
/// is fast. In a dilute train that alone is nothing yet. They have met where they are on the way to do so in less time
/// than has passed, and psi has risen to the size of the fall.
std::size_t Semidiscrete::crossing(double t, const double* y) const {
  constexpr double met = 0.1, faint = 0.05;
  const ConstValues values(y, size());
  if (!collides_) return size();
  double fastest = 0;
  for (const double phi : at_.phi) fastest = std::fmax(fastest, std::fabs(phi));
  std::size_t hardest = size();
  double most = faint * fastest;
  for (const Stretch& r : stretches_)
    for (std::size_t i = r.begin + 1; i + 1 < r.end; ++i) {
      const double fall = at_.phi[i - 1] - at_.phi[i + 1];
      const double highest = std::fmax(at_.psi[i], std::fmax(at_.psi[i - 1], at_.psi[i + 1]));
      if (!(fall > most && fall > at_.psi[i - 1] + at_.psi[i + 1] && highest > met * fall)) continue;
      const double apart = values.width(i) + (values.width(i - 1) + values.width(i + 1)) / 2;
      if (apart > t * (at_.velocity[i - 1] - at_.velocity[i + 1])) continue;
      most = fall;
      hardest = i;
    }
  return hardest;
}

}  // namespace slipfront::pulse
