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
      stretches_(stretches_of(setup_.charge, setup_.left, setup_.right)) {
  const std::size_t n = size();
  for (auto* array : {&charge_point_, &per_charge_point_, &width_, &momentum_in_cell_, &phi_mean_, &psi_mean_, &rate_,
                      &strength_, &source_, &source_mean_, &centres_, &shocked_})
    array->assign(n, 0);
  at_.resize(n);
  for (auto* array : {&invariant_plus_, &invariant_minus_}) array->assign(n + 2 * ghosts, 0);
  for (auto* array : {&face_phi_, &face_psi_, &face_U_, &face_p_, &faces_}) array->assign(n + 1, 0);
  if (setup_.contact) {
    contact_.assign(n, 1);
    contact_force_.assign(n, 0);
    face_contact_.assign(n + 1, 1);
  }
  for (const Stretch& r : stretches_)
    centre_values(r.end - r.begin, setup_.charge.data() + r.begin, charge_point_.data() + r.begin);
  for (std::size_t i = 0; i < n; ++i) {
    if (gap(i)) {
      at_.EK[i] = HUGE_VAL;  // no friction there
      continue;
    }
    per_charge_point_[i] = 1 / charge_point_[i];
  }
}

void Semidiscrete::start_from(const std::vector<double>& s) { at_.s = s; }

std::vector<State> Semidiscrete::states() const {
  std::vector<State> states(size());
  for (std::size_t i = 0; i < size(); ++i) states[i] = {at_.phi[i], at_.psi[i]};
  return states;
}

void Semidiscrete::find_states(double t, const double* y) {
  const std::size_t n = size();
  split(n, y, width_.data(), momentum_in_cell_.data());
  for (const Stretch& r : stretches_) {
    centre_values(r.end - r.begin, width_.data() + r.begin, at_.spacing.data() + r.begin);
    centre_values(r.end - r.begin, momentum_in_cell_.data() + r.begin, at_.momentum.data() + r.begin);
  }
  per_dislocation(n, per_charge_point_.data(), width_.data(), at_.spacing.data(), at_.momentum.data());
  if (setup_.contact) {
    for (std::size_t i = 0; i < n; ++i) {
      at_.spacing[i] *= contact_[i];
      at_.momentum[i] /= contact_[i];
    }
  }
  at_.resolve(stretches_, t);
  if (setup_.contact)
    for (std::size_t i = 0; i < n; ++i) at_.momentum[i] *= contact_[i];
}

void Semidiscrete::find_places(double t, const double* y) {
  const std::size_t n = size();
  const ConstValues values(y, n);
  faces_[0] = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) {
    faces_[i + 1] = faces_[i] + values.width(i);
    if (!(values.width(i) > 0) && !gap(i))
      throw NumericsError("t = " + digits(t) + ", cell " + std::to_string(i) + ": squeezed to nothing");
  }
  middles(stretches_, faces_, centres_);
  if (!setup_.contact) return;
  for (std::size_t i = 0; i < n; ++i) contact_[i] = setup_.contact(centres_[i]);
  for (std::size_t f = 0; f <= n; ++f) face_contact_[f] = setup_.contact(faces_[f]);
}

void Semidiscrete::operator()(double t, const double* y, double* dy) {
  const std::size_t n = size();
  const Values rates(dy, n);
  if (setup_.forcing || setup_.contact) find_places(t, y);
  find_states(t, y);
  find_rates();
  find_edges(y);
  find_faces();
  face_fluxes(n + 1, face_phi_.data(), face_psi_.data(), face_U_.data(), face_p_.data());
  for (std::size_t f = 0; f < face_contact_.size(); ++f) face_p_[f] *= face_contact_[f] * face_contact_[f];
  rates.left_edge() = face_U_[0];
  rates.dissipated() = rates.supplied() = 0;
  rates.through_ends() = face_p_[0] * face_U_[0] - face_p_[n] * face_U_[n];
  differences(n, face_U_.data(), face_p_.data(), dy);
  if (setup_.contact) add_contact_force(dy);
  add_sources(t, y, dy);
}

double Semidiscrete::crossing_time(const double* y, const double* dy) const {
  const ConstValues values(y, size());
  double least = HUGE_VAL;
  for (const Stretch& r : stretches_) {
    const std::size_t i = r.begin;
    least = std::fmin(least, least_crossing_time(r.end - i, values.from(i), ConstValues(dy, size()).from(i),
                                                 &at_.velocity[i], &at_.sound_speed[i]));
  }
  if (setup_.contact)  // which may not throw a cell, of mass 8 a dislocation, farther than a part of its width
    for (std::size_t i = 0; i < size(); ++i)
      if (contact_force_[i] != 0)
        least = std::fmin(least, std::sqrt(4 * setup_.charge[i] * values.width(i) / std::fabs(contact_force_[i])));
  return least;
}

double Semidiscrete::mean_crossing_time(const double* y) const {
  const ConstValues values(y, size());
  double width = 0, fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (gap(i)) continue;
    width += values.width(i);
    fastest = std::max(fastest, at_.sound_speed[i]);
  }
  return fastest > 0 ? width / static_cast<double>(size()) / fastest : HUGE_VAL;
}

}  // namespace slipfront::pulse
