#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "slipfront/lattice/chain/chain.hpp"

/// Chains of every kind of end and force, from a rough start, for comparisons to the bit.
namespace cases {

inline constexpr int kinds = 18;

/// A law by its name, with the first of its parameters; the others have their default values.
inline slipfront::friction::Friction law(const char* name, const std::vector<double>& first) {
  for (const slipfront::friction::Definition* known : slipfront::friction::laws()) {
    if (known->name != name) continue;
    std::vector<double> values;
    for (std::size_t i = 0; i < known->parameters.size(); ++i)
      values.push_back(i < first.size() ? first[i] : known->parameters[i].value);
    return {*known, values};
  }
  throw std::logic_error("no such law");
}

/// A parameter that varies between `least` and `most`.
inline slipfront::friction::AlongInterface between(double least, double most) {
  return {[=](double x, double) { return least + (most - least) * (1 + std::sin(0.7 * x)) / 2; }, least, most};
}

inline slipfront::chain::Problem problem(std::size_t sites, int kind) {
  using namespace slipfront::chain;
  Problem p{.grid = {-10, 0.4, sites},
            .model = Model::sine_gordon,
            .boundary = {End::free, End::absorbing, false, 0},
            .friction = {},
            .forcing = {},
            .contact = {}};
  if (kind == 1) p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
  if (kind == 2) p.boundary = {End::fixed, End::free, false, 0};
  if (kind == 2 || kind == 1) p.friction = slipfront::friction::viscous(0.3);
  if (kind == 3 || kind == 5) {
    p.forcing = [](double x, double t) { return 0.1 * std::sin(0.1 * x + t); };
    p.contact = [](double x) { return 1 + 0.2 * std::cos(0.3 * x); };
  }
  if (kind == 3) {
    p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 2};
    p.friction = slipfront::friction::power(0.2, 1.5);
  }
  if (kind == 4) {
    p.model = Model::lattice;
    p.boundary = {End::fixed, End::absorbing, false, 0};
    p.friction = slipfront::friction::coulomb(0.02);
  }
  if (kind == 6 || kind == 7) p.contact = [](double x) { return 1.1 + 0.3 * std::cos(0.3 * x); };
  if (kind == 6) p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
  if (kind == 7) {
    p.boundary = {End::absorbing, End::fixed, false, 0};
    p.friction = slipfront::friction::viscous(0.2);
  }
  if (kind == 5) {
    p.boundary = {End::absorbing, End::free, false, 0};
    p.friction = slipfront::friction::viscous(0.1);
  }
  if (kind == 8) {  // the state of friction around a ring
    p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
    p.friction = law("rate-and-state", {0.05, 0.01, 0.015, 6, 0.05, 0});
  }
  if (kind == 9) {  // contacts that age and pores that dilate
    p.boundary = {End::fixed, End::free, false, 0};
    p.friction = law("rate-and-state", {0.05, 0.01, 0.015, 3, 0.05, 0, 0, 0.1, 10, 0.02, 30, 0.1});
    p.contact = [a = p.friction.contact_at_start(0)](double x) { return a * (1 + 0.1 * std::cos(0.3 * x)); };
    p.forcing = [](double x, double t) { return 0.1 * std::sin(0.1 * x + t); };
    p.longest = 100;
  }
  if (kind == 11) {  // a steady force, contacts and implicit friction together
    p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
    p.friction = law("flash-heating", {0.05, 0.02, 0.5});
    p.contact = [](double x) { return 1 + 0.2 * std::cos(0.3 * x); };
    p.forcing = [](double x, double) { return 0.1 * std::sin(0.1 * x); };
    p.steady_forcing = true;
  }
  if (kind == 10) {
    p.boundary = {End::absorbing, End::free, false, 0};
    p.friction = law("slip-weakening", {0.05, 0.02, 3});
  }
  if (kind == 12) {  // steps shortened where neighbours are added, and not next to ends
    p.boundary = {End::fixed, End::free, false, 0};
    p.friction = slipfront::friction::coulomb(0.02);
  }
  if (kind == 13) {  // steps whose friction is a series, and others
    p.boundary = {End::free, End::free, false, 0};
    p.friction = slipfront::friction::power(0.01, 2);
  }
  if (kind == 14) {  // numbers of friction, contacts and pores that vary
    p.boundary = {End::fixed, End::free, false, 0};
    p.friction = law("rate-and-state", {0.05, 0.01, 0.015, 3, 0.05, 0, 0, 0.1, 10, 0.02, 30, 0.1})
                     .with("strength", between(0.03, 0.06))
                     .with("characteristic_slip", between(2, 4))
                     .with("contact_ageing", between(0.05, 0.1))
                     .with("drainage_time", between(20, 30));
    p.longest = 100;
  }
  if (kind >= 15) {  // phases of 32 bits
    p.phases_of_32_bits = true;
    p.boundary = {End::free, End::fixed, false, 0};
  }
  if (kind == 16) p.boundary = {.periodic = true, .charge = sites < 20 ? 1 : 3};
  if (kind == 17) p.boundary = {End::free, End::free, false, 0};
  if (kind == 16 || kind == 17) p.friction = slipfront::friction::viscous(0.3);
  return p;
}

inline slipfront::chain::Motion bumpy(const slipfront::chain::Problem& p) {
  slipfront::chain::Motion m;
  const double turns = 2 * std::numbers::pi * static_cast<double>(p.boundary.charge);
  const double length = p.grid.spacing * static_cast<double>(p.grid.sites);
  for (std::size_t j = 0; j < p.grid.sites; ++j) {
    const double s = (p.grid.x(j) - p.grid.left) / length;
    m.u.push_back(1000 - turns * s + 0.3 * std::sin(7 * s));
    m.velocity.push_back(0.1 * std::cos(90 * s));
  }
  return m;
}

}  // namespace cases
