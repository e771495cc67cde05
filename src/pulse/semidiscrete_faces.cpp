// What is at the faces: by WENO on the Riemann invariants, or, where friction rules, by the compact form.

#include <algorithm>
#include <cmath>

#include "kernels.hpp"
#include "semidiscrete.hpp"
#include "weno.hpp"

namespace slipfront::pulse {

void Semidiscrete::find_faces() {
  for (const Stretch& r : stretches_) {
    cell_means(r.end - r.begin, phi_.data() + r.begin, phi_mean_.data() + r.begin);
    cell_means(r.end - r.begin, psi_.data() + r.begin, psi_mean_.data() + r.begin);
  }
  for (const Stretch& r : stretches_) find_faces(r);
}

void Semidiscrete::find_faces(const Stretch& stretch) {
  const std::size_t n = stretch.end - stretch.begin;
  double* plus = invariant_plus_.data() + ghosts;
  double* minus = invariant_minus_.data() + ghosts;
  const double scale = invariants(n, phi_mean_.data() + stretch.begin, psi_mean_.data() + stretch.begin, plus, minus);
  for (std::size_t g = 1; g <= ghosts; ++g) {
    // Beyond a free edge psi = 0, and the edge moves at the invariant that reaches it.
    *(plus - g) = stretch.left_free ? minus[0] : plus[0];
    *(minus - g) = minus[0];
    plus[n - 1 + g] = plus[n - 1];
    minus[n - 1 + g] = stretch.right_free ? plus[n - 1] : minus[n - 1];
  }
  double* face_phi = face_phi_.data() + stretch.begin;
  double* face_psi = face_psi_.data() + stretch.begin;
  weno_faces(n + 1, plus, minus, scale, face_phi, face_psi);
  flatten_shocks(stretch, plus, minus, scale);
  // At a free edge psi = 0; phi + psi (or phi - psi) is the invariant that reaches it.
  if (stretch.left_free) {
    face_phi[0] = weno5(minus[2], minus[1], minus[0], minus[-1], minus[-2]) * scale;
    face_psi[0] = 0;
  }
  if (stretch.right_free) {
    const double* p = plus + n;
    face_phi[n] = weno5(p[-3], p[-2], p[-1], p[0], p[1]) * scale;
    face_psi[n] = 0;
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
    const double share = std::fmin((fall / density - weak) / (strong - weak), 1.0);
    for (std::ptrdiff_t f = std::max<std::ptrdiff_t>(i - reach + 1, 1); f <= std::min(i + reach, n - 1); ++f) {
      const std::size_t face = stretch.begin + static_cast<std::size_t>(f);
      const double a = plus[f - 1] * scale, b = minus[f] * scale;
      face_phi_[face] += share * ((a + b) / 2 - face_phi_[face]);
      face_psi_[face] += share * (std::fmax((a - b) / 2, 0.0) - face_psi_[face]);
    }
  }
}

void Semidiscrete::find_compact_faces(const double* y) {
  const std::size_t n = size();
  for (std::size_t f = 0; f <= n; ++f) {
    const bool left_edge = f == 0 || gap(f - 1), right_edge = f == n || gap(f);
    const std::size_t i = left_edge ? f : f - 1, j = right_edge ? f - 1 : f;
    const State l{phi_[i], psi_[i]}, r{phi_[j], psi_[j]};
    if (left_edge && (f > 0 || setup_.left_free)) {
      face_phi_[f] = r.phi - r.psi;
      face_psi_[f] = 0;
    } else if (right_edge && (f < n || setup_.right_free)) {
      face_phi_[f] = l.phi + l.psi;
      face_psi_[f] = 0;
    } else {
      face_phi_[f] = (l.phi + r.phi) / 2 + (l.psi - r.psi) / 2;
      face_psi_[f] = std::fmax((l.psi + r.psi) / 2 + (l.phi - r.phi) / 2, 0.0);
    }
    // Between two centres friction acts for the time that a wave needs from one to the other. With it the face carries
    // Darcy's flux, phi = -p_q / 8 C, where friction rules, and the plain Riemann solution where it does not.
    if (setup_.contact) {
      const double rise = left_edge    ? 2 * (contact_[j] - face_contact_[f])
                          : right_edge ? 2 * (face_contact_[f] - contact_[i])
                                       : contact_[j] - contact_[i];
      face_phi_[f] -= rise / (face_contact_[f] * (sound_speed_[i] + sound_speed_[j]));
    }
    const double crossings = (rate_[i] + rate_[j]) * (y[2 * i] + y[2 * j]) / 4 / (sound_speed_[i] + sound_speed_[j]);
    face_phi_[f] /= 1 + crossings;
  }
}

}  // namespace slipfront::pulse
