// The states at the faces, by WENO on the Riemann invariants.

#include <algorithm>
#include <cmath>

#include "averages/pulse/space/kernels.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "math/weno.hpp"

namespace slipfront::pulse {

void Semidiscrete::find_faces() {
  if (reconstruction_.collides) std::fill(reconstruction_.shocked.begin(), reconstruction_.shocked.end(), 0.0);
  reconstruction_.collides = false;
  for (const Block& r : blocks_) {
    cell_means(r.end - r.begin, awake_in(r), centres_.train.phi.data() + r.begin, means_.phi.data() + r.begin);
    cell_means(r.end - r.begin, awake_in(r), centres_.train.psi.data() + r.begin, means_.psi.data() + r.begin);
  }
  for (const Block& r : blocks_) find_faces(r);
}

/// A train that has moved away from a wall ends in a free edge.
void Semidiscrete::find_edges(const double* y) {
  const std::size_t n = size();
  const ConstValues values(y, n);
  if (setup_.left == Edge::wall)
    blocks_.front().left = edge_at_wall(values.left_edge(), setup_.left_wall, values.width(0));
  if (setup_.right != Edge::wall) return;
  double x = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) x += values.width(i);
  blocks_.back().right = edge_at_wall(x, setup_.right_wall, values.width(size() - 1));
}

/// Fills the ghost cells outside the ends of a block. Outside a free edge psi = 0, and the edge moves at the invariant
/// that reaches it. A wall is a mirror, which changes the sign of phi.
void Semidiscrete::fill_ghosts(const Block& block, double* plus, double* minus) const {
  const auto n = static_cast<std::ptrdiff_t>(block.end - block.begin);
  for (std::ptrdiff_t g = 1; g <= static_cast<std::ptrdiff_t>(ghosts); ++g) {
    const std::ptrdiff_t inside = std::min(g, n) - 1;
    switch (block.left) {
      case Edge::free:
      case Edge::continued:
        plus[-g] = block.left == Edge::free ? minus[0] : plus[0];
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
    switch (block.right) {
      case Edge::free:
      case Edge::continued:
        plus[n - 1 + g] = plus[n - 1];
        minus[n - 1 + g] = block.right == Edge::free ? plus[n - 1] : minus[n - 1];
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

void Semidiscrete::find_faces(const Block& block) {
  const std::size_t n = block.end - block.begin;
  double* plus = reconstruction_.plus.data() + ghosts;
  double* minus = reconstruction_.minus.data() + ghosts;
  const double scale = invariants(n, means_.phi.data() + block.begin, means_.psi.data() + block.begin, plus, minus);
  fill_ghosts(block, plus, minus);
  double* face_phi = faces_.phi.data() + block.begin;
  double* face_psi = faces_.psi.data() + block.begin;
  const CellRange awake = awake_in(block);
  if (awake.empty()) return;
  weno_faces(awake.end - awake.begin + 1, plus + awake.begin, minus + awake.begin, scale, face_phi + awake.begin,
             face_psi + awake.begin);
  flatten_shocks(block, plus, minus, scale);
  // At a free edge psi = 0; phi + psi (or phi - psi) is the invariant that reaches it. A train that moves away from a
  // wall ends in a free edge.
  if (block.left == Edge::free || block.left == Edge::wall) {
    const double away = weno5(minus[2], minus[1], minus[0], minus[-1], minus[-2]) * scale;
    if (block.left == Edge::free || away > 0) {
      face_phi[0] = away;
      face_psi[0] = 0;
    } else {
      face_phi[0] = 0;
    }
  }
  if (block.right == Edge::free || block.right == Edge::wall) {
    const double* p = plus + n;
    const double away = weno5(p[-3], p[-2], p[-1], p[0], p[1]) * scale;
    if (block.right == Edge::free || away < 0) {
      face_phi[n] = away;
      face_psi[n] = 0;
    } else {
      face_phi[n] = 0;
    }
  }
  if (block.left == Edge::ring) {  // both ends are the same face
    face_phi[n] = face_phi[0];
    face_psi[n] = face_psi[0];
  }
}

/// Lowers the order near hard collisions of trains. There a shock forms, and behind it a scheme of high order
/// oscillates. Faces near it take the plain values of the cells, as in the PPM of Colella & Woodward (1984). `plus` and
/// `minus` are the scaled invariants.
void Semidiscrete::flatten_shocks(const Block& block, const double* plus, const double* minus, double scale) {
  constexpr double weak = 0.5, strong = 1;  // fall of phi over two cells, divided by the sum of psi
  constexpr std::ptrdiff_t reach = 5;
  if (!(hardest_collision(block.end - block.begin, plus, minus, weak) > 0)) return;
  const auto n = static_cast<std::ptrdiff_t>(block.end - block.begin);
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const double fall = plus[i - 1] + minus[i - 1] - plus[i + 1] - minus[i + 1];
    const double density = plus[i - 1] - minus[i - 1] + plus[i + 1] - minus[i + 1];
    if (!(fall > weak * density)) continue;
    reconstruction_.collides = true;
    for (std::ptrdiff_t near = std::max<std::ptrdiff_t>(i - reach, 0); near <= std::min(i + reach, n - 1); ++near)
      reconstruction_.shocked[block.begin + static_cast<std::size_t>(near)] = 1;
    const double share = std::fmin((fall / density - weak) / (strong - weak), 1.0);
    for (std::ptrdiff_t f = std::max<std::ptrdiff_t>(i - reach + 1, 1); f <= std::min(i + reach, n - 1); ++f) {
      const std::size_t face = block.begin + static_cast<std::size_t>(f);
      const double a = plus[f - 1] * scale, b = minus[f] * scale;
      faces_.phi[face] += share * ((a + b) / 2 - faces_.phi[face]);
      faces_.psi[face] += share * (std::fmax((a - b) / 2, 0.0) - faces_.psi[face]);
    }
  }
}

/// If phi falls over two cells by more than the sum of their psi, their velocities differ by more than the speed of any
/// wave between them. In a dilute train this is not yet a crossing. Streams have met if they can close their distance
/// in less time than has passed, and if psi has risen to a tenth of the fall.
std::size_t Semidiscrete::crossing(double t, const double* y) const {
  constexpr double met = 0.1, faint = 0.05;
  const ConstValues values(y, size());
  if (!reconstruction_.collides) return size();
  double fastest = 0;
  for (const double phi : centres_.train.phi) fastest = std::fmax(fastest, std::fabs(phi));
  std::size_t hardest = size();
  double most = faint * fastest;
  for (const Block& r : blocks_)
    for (std::size_t i = r.begin + 1; i + 1 < r.end; ++i) {
      const double fall = centres_.train.phi[i - 1] - centres_.train.phi[i + 1];
      const double highest =
          std::fmax(centres_.train.psi[i], std::fmax(centres_.train.psi[i - 1], centres_.train.psi[i + 1]));
      if (!(fall > most && fall > centres_.train.psi[i - 1] + centres_.train.psi[i + 1] && highest > met * fall))
        continue;
      const double apart = values.width(i) + (values.width(i - 1) + values.width(i + 1)) / 2;
      if (apart > t * (centres_.train.velocity[i - 1] - centres_.train.velocity[i + 1])) continue;
      most = fall;
      hardest = i;
    }
  return hardest;
}

}  // namespace slipfront::pulse
