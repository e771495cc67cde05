// Sources of momentum other than the fluxes at the faces: friction, forcing and the slope of the contact ratio.

#include <algorithm>
#include <cmath>

#include "averages/pulse/space/kernels.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "slipfront/theory/train.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::pulse {
namespace {

/// Dry friction on a cell on which the force `push` acts. It opposes motion with `most`, or holds a cell that is at
/// rest.
double dry_friction(double momentum, double push, double most) {
  if (momentum != 0) return -std::copysign(most, momentum);
  return -std::copysign(std::fmin(std::fabs(push), most), push);
}

/// Finds values at the n + 1 faces of a block from those at its centres: fourth order inside, third order next to an
/// end outside which no value is known.
void between_centres(const Block& block, const double* centre, double* face) {
  const auto n = static_cast<std::ptrdiff_t>(block.end - block.begin);
  const auto beyond = [&](Edge edge, std::ptrdiff_t first, std::ptrdiff_t step, std::ptrdiff_t distance) {
    const auto inside = [&](std::ptrdiff_t i) { return centre[first + step * std::min(i, n - 1)]; };
    if (edge == Edge::ring) return inside(n - distance);
    if (edge == Edge::wall) return inside(distance - 1);
    return distance == 1 ? 3 * (inside(0) - inside(1)) + inside(2) : 6 * inside(0) - 8 * inside(1) + 3 * inside(2);
  };
  const auto at = [&](std::ptrdiff_t i) {
    return i < 0 ? beyond(block.left, 0, 1, -i) : i < n ? centre[i] : beyond(block.right, n - 1, -1, i - n + 1);
  };
  for (std::ptrdiff_t f = 0; f <= n; ++f)
    face[f] = std::fmax((9 * (at(f - 1) + at(f)) - (at(f - 2) + at(f + 1))) / 16, 0.0);
}

}  // namespace

/// Adds the force of the contact on each cell, -integral of <1 - cos u> d(a^2), from values at both faces and the
/// centre. This has fourth order and needs no derivative of a.
///
/// In a dilute train <1 - cos u> varies as 1 / ln psi. A psi that follows from the invariants at a face has no accurate
/// digits if it is much smaller than phi. Faces therefore take <1 - cos u> from the centres around them. Next to a free
/// edge the density falls to zero within a cell, and the energy of one dislocation is the smooth quantity.
void Semidiscrete::add_contact_force(double* dy) {
  const Values rates(dy, size());
  const auto square = [](double a) { return a * a; };
  std::vector<double>&centre = sources_.substrate, &face = sources_.substrate_at_faces;
  for (std::size_t i = 0; i < size(); ++i) centre[i] = train::one_minus_cos(centres_.train.psi[i]);
  for (const Block& r : blocks_) between_centres(r, &centre[r.begin], &face[r.begin]);
  for (std::size_t i = 0; i < size(); ++i) {
    const double a = square(faces_.contact[i]), b = square(centres_.contact[i]), c = square(faces_.contact[i + 1]);
    sources_.contact_force[i] = 0;
    if (!gap(i) && (a != b || b != c))
      sources_.contact_force[i] = modulation::contact_source({face[i], centre[i], face[i + 1]}, {a, b, c});
  }
  for (const Block& r : blocks_) {
    const auto at_edge = [&](std::size_t i) {  // the dislocations of an end cell are spread evenly over it
      sources_.contact_force[i] = -centre[i] * (square(faces_.contact[i + 1]) - square(faces_.contact[i]));
    };
    if (r.left == Edge::free) at_edge(r.begin);
    if (r.right == Edge::free) at_edge(r.end - 1);
  }
  for (std::size_t i = 0; i < size(); ++i) rates.momentum(i) += sources_.contact_force[i];
}

void Semidiscrete::add_sources(double t, const double* y, double* dy) {
  const ConstValues values(y, size());
  const Values rates(dy, size());
  const friction::Friction& friction = setup_.friction;
  const bool frictional = friction.acts() && !setup_.friction_apart;
  const std::optional<double> C = friction.linear_coefficient();
  const bool linear = frictional && C && friction.closure() == friction::Closure::consistent;
  if (!frictional && !setup_.forcing) return;
  if (linear && !setup_.forcing) {  // the simplest case needs no point values
    rates.dissipated() = damp(size(), *C, values.momenta(), centres_.train.velocity.data(), rates.momenta());
    return;
  }
  const Powers powers = find_forces(t, frictional && !friction.sticks(), !linear);
  for (const Block& r : blocks_)
    cell_means(r.end - r.begin, {0, r.end - r.begin}, sources_.force.data() + r.begin, means_.source.data() + r.begin);
  double dissipation = powers.dissipation;
  for (std::size_t i = 0; i < size(); ++i) {
    rates.momentum(i) += means_.source[i];
    if (frictional && friction.sticks()) {  // a constant force needs no point values
      const double force =
          dry_friction(values.momentum(i), rates.momentum(i),
                       modulation::force_per_dislocation(sources_.friction_strength[i]) * setup_.charge[i]);
      dissipation -= centres_.train.velocity[i] * force;
      rates.momentum(i) += force;
    } else if (linear) {
      rates.momentum(i) -= *C * values.momentum(i);
    }
  }
  // M = 2 pi P / k and 2 pi q_s = k x_s: these are sums of P dx = M q_s ds over the cells.
  rates.dissipated() = dissipation;
  rates.supplied() = powers.supply;
}

/// Finds the forces at the cell centres per unit of s: the load and, if `in_force`, friction that has a rate. Returns
/// the power of the load, and that of friction if it is `rated`.
Semidiscrete::Powers Semidiscrete::find_forces(double t, bool rated, bool in_force) {
  Powers powers;
  for (std::size_t i = 0; i < size(); ++i) {
    const double U = centres_.train.velocity[i];
    sources_.force[i] = 0;
    if (setup_.forcing) {
      const double push = modulation::force_per_dislocation(setup_.forcing(centres_.x[i], t)) * centres_.charge[i];
      powers.supply += U * push;
      sources_.force[i] += push;
    }
    if (!rated) continue;
    const double loss = sources_.friction_rate[i] * centres_.train.momentum[i] * centres_.charge[i];
    powers.dissipation += U * loss;
    if (in_force) sources_.force[i] -= loss;
  }
  return powers;
}

void Semidiscrete::find_rates() {
  const friction::Friction& f = setup_.friction;
  sources_.largest_friction_rate = 0;
  if (!f.acts()) return;
  if (const auto C = f.linear_coefficient()) {
    if (f.closure() == friction::Closure::consistent) {
      std::fill(sources_.friction_rate.begin(), sources_.friction_rate.end(), *C);
      sources_.largest_friction_rate = *C;
    } else {  // the values of E K are known already
      sources_.largest_friction_rate = paper_rates(size(), *C, centres_.train.EK.data(), sources_.friction_rate.data());
    }
    return;
  }
  if (relaxation_rate_->tabulated()) {
    for (std::size_t i = 0; i < size(); ++i) {
      if (gap(i)) continue;
      const State state{centres_.train.phi[i], centres_.train.psi[i]};
      sources_.friction_rate[i] = (*relaxation_rate_)(state, setup_.contact ? centres_.contact[i] : 1, {});
      sources_.largest_friction_rate = std::max(sources_.largest_friction_rate, sources_.friction_rate[i]);
    }
    return;
  }
  find_strengths();
  if (f.sticks()) return;  // such friction stops motion, and has no relaxation rate
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    sources_.friction_rate[i] =
        modulation::force_per_dislocation(sources_.friction_strength[i]) / sources_.shown_momentum[i];
    sources_.largest_friction_rate = std::max(sources_.largest_friction_rate, sources_.friction_rate[i]);
  }
}

/// Finds the mean of f over the train in each cell that has one, and the momentum per dislocation. A cell at rest, for
/// a law that does not stick, gets the values of a slow train, whose ratio is at the limit. A cell that
/// stays at rest with the same s keeps its values. Trains whose motion is within rounding get the force at one slip
/// velocity.
void Semidiscrete::find_strengths() {
  const friction::Friction& f = setup_.friction;
  const CellStates& train = centres_.train;
  Sources& o = sources_;
  constexpr double rounding = 1e-14;
  fastest_slip(size(), train.phi.data(), train.psi.data(), o.fastest.data());
  // The arrays are filled from both ends: trains whose motion is within rounding go to the end, all others to the
  // front.
  std::size_t count = 0, rounded = size();
  for (std::size_t i = 0; i < size(); ++i) {
    const double a = setup_.contact ? centres_.contact[i] : 1, s = train.s[i], M = std::fabs(train.momentum[i]);
    const bool rests = M == 0;
    if (gap(i) || (rests && o.resting_s[i] == s && !setup_.contact)) continue;
    o.resting_s[i] = rests ? s : -1;
    o.shown_momentum[i] = M;
    o.fastest[count] = a * o.fastest[i];
    if (rests && !f.sticks()) {
      const double K = train.spacing[i] / (2 * std::sqrt((1 - s) * (1 + s)));
      o.fastest[count] = 1e-8 * s;
      o.shown_momentum[i] = 4 * o.fastest[count] * train.EK[i] / K;  // 8 a sinh phi cosh psi E
    }
    if (!rests && o.fastest[count] < rounding * a * s) {
      o.shape[--rounded] = o.fastest[count];
      o.cell[rounded] = i;
      continue;
    }
    o.shape[count] = s;
    o.cell[count++] = i;
  }
  f.average().mean_strengths({count, o.fastest.data(), o.shape.data()}, f.closure(), o.mean.data(), nullptr);
  f.loops().strengths(size() - rounded, o.shape.data() + rounded, {}, o.mean.data() + rounded);
  for (std::size_t j = 0; j < count; ++j) o.friction_strength[o.cell[j]] = o.mean[j];
  for (std::size_t j = rounded; j < size(); ++j) o.friction_strength[o.cell[j]] = o.mean[j];
}

}  // namespace slipfront::pulse
