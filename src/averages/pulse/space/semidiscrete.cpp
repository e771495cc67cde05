#include "averages/pulse/space/semidiscrete.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "averages/pulse/space/kernels.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::pulse {

using std::numbers::pi;

Semidiscrete::Semidiscrete(Setup setup)
    : setup_(std::move(setup)),
      relaxation_rate_(setup_.friction.relaxation_rate()),
      blocks_(blocks_of(setup_.charge, setup_.left, setup_.right)) {
  const std::size_t n = size();
  wake();
  for (auto* array : {&centres_.charge, &centres_.per_charge, &means_.phi, &means_.psi, &sources_.friction_rate,
                      &sources_.friction_strength, &sources_.force, &means_.source, &sources_.fastest, &sources_.shape,
                      &sources_.mean, &sources_.shown_momentum, &centres_.x, &reconstruction_.shocked})
    array->assign(n, 0);
  sources_.cell.assign(n, 0);
  sources_.resting_s.assign(n, -1);
  centres_.train.resize(n);
  for (auto* array : {&reconstruction_.plus, &reconstruction_.minus}) array->assign(n + 2 * ghosts, 0);
  for (auto* array : {&faces_.phi, &faces_.psi, &faces_.velocity, &faces_.pressure, &faces_.x}) array->assign(n + 1, 0);
  if (setup_.contact) {
    centres_.contact.assign(n, 1);
    sources_.contact_force.assign(n, 0);
    sources_.substrate.assign(n, 0);
    sources_.substrate_at_faces.assign(n + 1, 0);
    faces_.contact.assign(n + 1, 1);
  }
  for (const Block& r : blocks_)
    centre_values(r.end - r.begin, awake_in(r), setup_.charge.data() + r.begin, centres_.charge.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    if (gap(i)) {
      centres_.train.EK[i] = HUGE_VAL;  // no friction in a gap
      continue;
    }
    centres_.per_charge[i] = 1 / centres_.charge[i];
  }
}

void Semidiscrete::start_from(const std::vector<double>& s) { centres_.train.s = s; }

std::vector<State> Semidiscrete::states() const {
  std::vector<State> states(size());
  for (std::size_t i = 0; i < size(); ++i) states[i] = {centres_.train.phi[i], centres_.train.psi[i]};
  return states;
}

void Semidiscrete::find_states(double t, const double* y) {
  const std::size_t n = size();
  const ConstValues means(y, n);
  for (const Block& r : blocks_) {
    const CellRange awake = awake_in(r);
    if (awake.empty()) continue;
    double *spacing = centres_.train.spacing.data() + r.begin, *momentum = centres_.train.momentum.data() + r.begin;
    centre_values(r.end - r.begin, awake, means.widths() + r.begin, spacing);
    centre_values(r.end - r.begin, awake, means.momenta() + r.begin, momentum);
    const std::size_t first = r.begin + awake.begin;
    per_dislocation(awake.end - awake.begin, &centres_.per_charge[first], means.widths() + first, spacing + awake.begin,
                    momentum + awake.begin);
  }
  if (setup_.contact) {
    for (std::size_t i = 0; i < n; ++i) {
      centres_.train.spacing[i] *= centres_.contact[i];
      centres_.train.momentum[i] /= centres_.contact[i];
    }
  }
  centres_.train.solve(blocks_, awake_, t);
  if (setup_.contact)
    for (std::size_t i = 0; i < n; ++i) centres_.train.momentum[i] *= centres_.contact[i];
}

void Semidiscrete::find_places(double t, const double* y) {
  const std::size_t n = size();
  const ConstValues values(y, n);
  faces_.x[0] = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) {
    faces_.x[i + 1] = faces_.x[i] + values.width(i);
    if (!(values.width(i) > 0) && !gap(i))
      throw NumericsError("t = " + digits(t) + ", cell " + std::to_string(i) + ": compressed to zero width");
  }
  middles(blocks_, faces_.x, centres_.x);
  if (!setup_.contact) return;
  for (std::size_t i = 0; i < n; ++i) centres_.contact[i] = setup_.contact(centres_.x[i]);
  for (std::size_t f = 0; f <= n; ++f) faces_.contact[f] = setup_.contact(faces_.x[f]);
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const Values rates(dy, n);
  // Motion within rounding counts as rest, unless a forcing or the contact might cause motion as slow.
  const double rounding = setup_.forcing || setup_.contact ? 0 : 64 * 2.2e-16;
  if (setup_.forcing || setup_.contact) find_places(t, y);
  find_states(t, y);
  if (setup_.friction_apart)
    sources_.largest_friction_rate = 0;
  else
    find_rates();
  find_edges(y);
  find_faces();
  const std::size_t awake = awake_.begin, count = awake_.end - awake;
  face_fluxes(count + 1, &faces_.phi[awake], &faces_.psi[awake], rounding, &faces_.velocity[awake],
              &faces_.pressure[awake]);
  for (std::size_t f = 0; f < faces_.contact.size(); ++f) faces_.pressure[f] *= faces_.contact[f] * faces_.contact[f];
  rates.left_edge() = faces_.velocity[0];
  rates.dissipated() = rates.supplied() = 0;
  rates.through_ends() = faces_.pressure[0] * faces_.velocity[0] - faces_.pressure[n] * faces_.velocity[n];
  std::fill_n(rates.widths(), 2 * n, 0.0);
  differences(count, &faces_.velocity[awake], &faces_.pressure[awake], rounding, rates.widths() + awake,
              rates.momenta() + awake);
  if (setup_.contact) add_contact_force(dy);
  add_sources(t, y, dy);
}

void Semidiscrete::let_rest(const double* y, const double* dy) {
  const bool ring = !blocks_.empty() && blocks_.front().left == Edge::ring;
  if (setup_.forcing || setup_.contact || ring) return;
  constexpr std::size_t far = 16;  // cells, more than a wave crosses in a step
  const ConstValues values(y, size()), rates(dy, size());
  const auto rests = [&](std::size_t i) {
    return values.momentum(i) == 0 && rates.momentum(i) == 0 && rates.width(i) == 0;
  };
  CellRange moving{0, size()};
  while (!moving.empty() && rests(moving.begin)) ++moving.begin;
  while (!moving.empty() && rests(moving.end - 1)) --moving.end;
  awake_ = {moving.begin > far ? moving.begin - far : 0, std::min(moving.end + far, size())};
}

double Semidiscrete::crossing_time(const double* y, const double* dy) const {
  const ConstValues values(y, size()), rates(dy, size());
  double least = HUGE_VAL;
  for (const Block& r : blocks_) {
    const std::size_t i = r.begin;
    least = std::fmin(least, least_crossing_time(r.end - i, values.widths() + i, rates.widths() + i,
                                                 &centres_.train.velocity[i], &centres_.train.sound_speed[i]));
  }
  // The contact force may move a cell, of mass 8 per dislocation, by at most a quarter of its width.
  if (setup_.contact)
    for (std::size_t i = 0; i < size(); ++i)
      if (sources_.contact_force[i] != 0)
        least =
            std::fmin(least, std::sqrt(4 * setup_.charge[i] * values.width(i) / std::fabs(sources_.contact_force[i])));
  return least;
}

double Semidiscrete::friction_rate_of_fastest() const {
  if (!setup_.friction.acts()) return 0;
  const std::vector<double>& momentum = centres_.train.momentum;
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (!gap(i) && std::fabs(momentum[i]) > std::fabs(momentum[fastest])) fastest = i;
  if (momentum[fastest] == 0) return 0;
  double slip = 0, force = 0;
  fastest_slip(1, &centres_.train.phi[fastest], &centres_.train.psi[fastest], &slip);
  if (setup_.contact) slip *= centres_.contact[fastest];
  setup_.friction.average().mean_strengths({1, &slip, &centres_.train.s[fastest]}, setup_.friction.closure(), &force,
                                           nullptr);
  return modulation::force_per_dislocation(force) / std::fabs(momentum[fastest]);
}

double Semidiscrete::mean_friction_rate() const {
  constexpr std::size_t most = 64;
  constexpr double slow = 0.01;
  const CellStates& trains = centres_.train;
  double fastest = 0;
  for (std::size_t i = 0; i < size(); ++i)
    if (!gap(i)) fastest = std::fmax(fastest, std::fabs(trains.momentum[i]));
  std::vector<double> slip, s, charge;
  double momentum = 0;
  for (std::size_t i = 0; i < size() && fastest > 0; i += std::max<std::size_t>(size() / most, 1)) {
    if (gap(i) || !(std::fabs(trains.momentum[i]) > slow * fastest)) continue;
    slip.push_back(0);
    fastest_slip(1, &trains.phi[i], &trains.psi[i], &slip.back());
    if (setup_.contact) slip.back() *= centres_.contact[i];
    s.push_back(trains.s[i]);
    charge.push_back(setup_.charge[i]);
    momentum += setup_.charge[i] * std::fabs(trains.momentum[i]);
  }
  if (slip.empty()) return friction_rate_of_fastest();
  std::vector<double> force(slip.size());
  setup_.friction.average().mean_strengths({slip.size(), slip.data(), s.data()}, setup_.friction.closure(),
                                           force.data(), nullptr);
  double taken = 0;
  for (std::size_t j = 0; j < force.size(); ++j) taken += 2 * pi * charge[j] * force[j];
  return taken / momentum;
}

double Semidiscrete::mean_crossing_time(const double* y) const {
  const ConstValues values(y, size());
  double width = 0, fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    width += values.width(i);
    fastest = std::max(fastest, centres_.train.sound_speed[i]);
  }
  return fastest > 0 ? width / static_cast<double>(size()) / fastest : HUGE_VAL;
}

}  // namespace slipfront::pulse
