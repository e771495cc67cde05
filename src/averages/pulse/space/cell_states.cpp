#include "averages/pulse/space/cell_states.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "theory/modulation/modulation.hpp"

namespace slipfront::pulse {

std::vector<Block> blocks_of(const std::vector<double>& charge, Edge left, Edge right) {
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < charge.size(); ++i) {
    if (charge[i] == 0) continue;
    const bool opens = i == 0 || charge[i - 1] == 0;
    if (opens) blocks.push_back({i, i, i > 0 ? Edge::free : left, Edge::free});
    blocks.back().end = i + 1;
  }
  blocks.back().right = right;
  return blocks;
}

void middles(const std::vector<Block>& blocks, const std::vector<double>& faces, std::vector<double>& centres) {
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = (faces[i] + faces[i + 1]) / 2;
  for (const Block& block : blocks)
    for (std::size_t i = block.begin + 1; i + 1 < block.end; ++i) {
      const double* f = faces.data() + i;
      const bool inside = i >= block.begin + 2 && i + 2 < block.end;
      const double smooth = inside ? (150 * (f[0] + f[1]) - 25 * (f[-1] + f[2]) + 3 * (f[-2] + f[3])) / 256
                                   : (9 * (f[0] + f[1]) - (f[-1] + f[2])) / 16;
      // Next to a much wider cell, as at a shock, the smooth value could be outside the cell.
      const double middle = centres[i], quarter = (f[1] - f[0]) / 4;
      centres[i] = std::clamp(smooth, middle - quarter, middle + quarter);
    }
}

namespace {

/// Dislocations so far apart for their width that a double does not hold psi are as near as it does: psi = 0 is a train
/// without any, whose averages have no number.
constexpr double psi_least = 1e-303;

}  // namespace

void CellStates::resize(std::size_t size) {
  for (auto* array : {&spacing, &momentum, &s, &phi, &psi, &sound_speed, &EK, &velocity, &solved_})
    array->assign(size, 0);
}

void CellStates::solve_vector(std::size_t b, std::size_t end) {
  modulation::solve_states({end - b, &spacing[b], &momentum[b], &s[b], &phi[b], &psi[b], &sound_speed[b], &EK[b],
                            &velocity[b], &solved_[b]});
}

void CellStates::solve_slip(std::size_t size, double* fastest) {
  modulation::solve_slip({size, spacing.data(), momentum.data(), s.data(), phi.data(), psi.data(), sound_speed.data(),
                          EK.data(), velocity.data(), solved_.data()},
                         fastest);
  for (std::size_t i = 0; i < size; ++i) {
    if (solved(i)) continue;
    try {
      solve_one(i);
      fastest[i] = 2 * std::sinh(std::fabs(phi[i])) * std::cosh(psi[i]);
    } catch (const NumericsError&) {
    }
  }
}

void CellStates::solve_one(std::size_t i) {
  const double guess = std::atanh(std::fmin(std::fmax(s[i], 0.0), 1 - 1e-16));
  const modulation::SolvedState at = modulation::solve_state({spacing[i], momentum[i]}, guess);
  phi[i] = at.state.phi;
  psi[i] = std::fmax(at.state.psi, psi_least);
  s[i] = std::tanh(psi[i]);
  sound_speed[i] = at.sound_speed;
  EK[i] = at.EK;
  velocity[i] = std::tanh(at.state.phi);
  solved_[i] = 1;
}

void CellStates::solve(const std::vector<Block>& blocks, CellRange awake, double time) {
  for (const Block& r : blocks) {
    const CellRange part = common(r, awake);
    if (part.empty()) continue;
    solve_vector(part.begin, part.end);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (solved_[i] != 0) continue;
      try {
        solve_one(i);
      } catch (const NumericsError& error) {
        throw NumericsError("t = " + digits(time) + ", cell " + std::to_string(i) + " of " + std::to_string(s.size()) +
                            ": " + error.what());
      }
    }
  }
}

namespace {

/// The edge of the cells at an end of the domain. At a wall, the equations find out whether the train touches it.
Edge edge_at(const Problem& problem, End end, bool free) {
  if (problem.periodic) return Edge::ring;
  if (end == End::fixed) return Edge::wall;
  return free || end == End::free ? Edge::free : Edge::continued;
}

}  // namespace

bool is_steep(const friction::Friction& f) { return f.acts() && f.steep_at_rest() && !f.sticks(); }

bool takes_friction_by_cells(const Problem& problem) {
  const friction::Friction& f = problem.friction;
  return f.state_size() > 0 || (is_steep(f) && !problem.periodic);
}

Setup setup_of(const Problem& problem, const Cells& cells, FreeEdges free) {
  Setup s;
  s.charge = cells.charge;
  s.left = edge_at(problem, problem.left_end, free.left);
  s.right = edge_at(problem, problem.right_end, free.right);
  s.left_wall = problem.left;
  s.right_wall = problem.right;
  if (problem.friction.state_size() == 0) s.friction = problem.friction;  // else CellFriction has it
  s.friction_apart = takes_friction_by_cells(problem);
  s.forcing = problem.forcing;
  s.contact = problem.contact;
  if (problem.periodic) {
    const auto on_ring = [left = problem.left, period = problem.right - problem.left](double x) {
      return x - std::floor((x - left) / period) * period;
    };
    if (s.forcing) s.forcing = [on_ring, f = s.forcing](double x, double t) { return f(on_ring(x), t); };
    if (s.contact) s.contact = [on_ring, f = s.contact](double x) { return f(on_ring(x)); };
  }
  return s;
}

}  // namespace slipfront::pulse
