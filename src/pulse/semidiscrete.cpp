#include "semidiscrete.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "../digits.hpp"
#include "kernels.hpp"
#include "slipfront/error.hpp"
#include "slipfront/modulation/per_dislocation.hpp"

namespace slipfront::pulse {

Semidiscrete::Semidiscrete(Setup setup)
    : setup_(std::move(setup)),
      relaxation_rate_(setup_.friction.relaxation_rate()),
      blocks_(blocks_of(setup_.charge, setup_.left, setup_.right)) {
  const std::size_t n = size();
  for (auto* array :
       {&centres_.charge, &centres_.per_charge, &means_.width, &means_.momentum, &means_.phi, &means_.psi,
        &sources_.friction_rate, &sources_.friction_strength, &sources_.force, &means_.source, &sources_.fastest,
        &sources_.shape, &sources_.mean, &sources_.shown_momentum, &centres_.x, &reconstruction_.shocked})
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
    centre_values(r.end - r.begin, setup_.charge.data() + r.begin, centres_.charge.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    if (gap(i)) {
      centres_.train.EK[i] = HUGE_VAL;  // no friction there
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
  split(n, y, means_.width.data(), means_.momentum.data());
  for (const Block& r : blocks_) {
    centre_values(r.end - r.begin, means_.width.data() + r.begin, centres_.train.spacing.data() + r.begin);
    centre_values(r.end - r.begin, means_.momentum.data() + r.begin, centres_.train.momentum.data() + r.begin);
  }
  per_dislocation(n, centres_.per_charge.data(), means_.width.data(), centres_.train.spacing.data(),
                  centres_.train.momentum.data());
  if (setup_.contact) {
    for (std::size_t i = 0; i < n; ++i) {
      centres_.train.spacing[i] *= centres_.contact[i];
      centres_.train.momentum[i] /= centres_.contact[i];
    }
  }
  centres_.train.solve(blocks_, t);
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
      throw NumericsError("t = " + digits(t) + ", cell " + std::to_string(i) + ": squeezed to nothing");
  }
  middles(blocks_, faces_.x, centres_.x);
  if (!setup_.contact) return;
  for (std::size_t i = 0; i < n; ++i) centres_.contact[i] = setup_.contact(centres_.x[i]);
  for (std::size_t f = 0; f <= n; ++f) faces_.contact[f] = setup_.contact(faces_.x[f]);
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const Values rates(dy, n);
  if (setup_.forcing || setup_.contact) find_places(t, y);
  find_states(t, y);
  find_rates();
  find_edges(y);
  find_faces();
  face_fluxes(n + 1, faces_.phi.data(), faces_.psi.data(), faces_.velocity.data(), faces_.pressure.data());
  for (std::size_t f = 0; f < faces_.contact.size(); ++f) faces_.pressure[f] *= faces_.contact[f] * faces_.contact[f];
  rates.left_edge() = faces_.velocity[0];
  rates.dissipated() = rates.supplied() = 0;
  rates.through_ends() = faces_.pressure[0] * faces_.velocity[0] - faces_.pressure[n] * faces_.velocity[n];
  differences(n, faces_.velocity.data(), faces_.pressure.data(), dy);
  if (setup_.contact) add_contact_force(dy);
  add_sources(t, y, dy);
}

double Semidiscrete::crossing_time(const double* y, const double* dy) const {
  const ConstValues values(y, size());
  double least = HUGE_VAL;
  for (const Block& r : blocks_) {
    const std::size_t i = r.begin;
    least = std::fmin(least, least_crossing_time(r.end - i, values.from(i), ConstValues(dy, size()).from(i),
                                                 &centres_.train.velocity[i], &centres_.train.sound_speed[i]));
  }
  if (setup_.contact)  // which may not throw a cell, of mass 8 a dislocation, farther than a part of its width
    for (std::size_t i = 0; i < size(); ++i)
      if (sources_.contact_force[i] != 0)
        least =
            std::fmin(least, std::sqrt(4 * setup_.charge[i] * values.width(i) / std::fabs(sources_.contact_force[i])));
  return least;
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
