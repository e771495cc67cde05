#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/grid/layout.hpp"
#include "slipfront/averages/pulse/problem.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// Boundary condition at an end of a row of cells.
enum class Edge {
  free,       ///< no dislocations: no pressure, and the edge moves
  continued,  ///< the train in the last cell continues
  wall,       ///< a wall that no dislocation passes; the last dislocation may move away from it
  ring,       ///< the other end of the row
};

/// Returns Edge::wall if the end of a train, at x, touches the wall, and Edge::free if the train has moved away from
/// it. `width` is that of the last cell.
inline Edge edge_at_wall(double x, double wall, double width) {
  return std::fabs(x - wall) <= 1e-13 * std::fabs(wall) + 1e-6 * width ? Edge::wall : Edge::free;
}

/// A range of neighbouring cells or faces. It does not include `end`.
struct CellRange {
  std::size_t begin, end;
  bool empty() const { return begin >= end; }
};

/// A row of cells with dislocations. Between two blocks is a gap, one cell without dislocations, whose faces are free
/// edges.
struct Block {
  std::size_t begin, end;  ///< cells
  Edge left, right;
};
/// The cells that a block and a stretch of cells have in common.
inline CellRange common(const Block& block, CellRange stretch) {
  const std::size_t begin = std::max(block.begin, stretch.begin);
  return {begin, std::max(begin, std::min(block.end, stretch.end))};
}
std::vector<Block> blocks_of(const std::vector<double>& charge, Edge left, Edge right);

/// Finds x at the middle of each cell in s, from the faces: sixth order inside a block, fourth and second order in its
/// last cells. The result is within the middle half of the cell.
void middles(const std::vector<Block>& blocks, const std::vector<double>& faces, std::vector<double>& centres);

/// The trains at the cell centres: spacing and momentum of one dislocation, and the state that they determine. With a
/// contact ratio a(x), all are in the local units a x, a t.
struct CellStates {
  std::vector<double> spacing, momentum;
  std::vector<double> s;  ///< tanh(psi); on entry to `solve`, the initial guess
  std::vector<double> phi, psi, sound_speed, EK, velocity;

  void resize(std::size_t size);
  /// Finds the states of the cells of `awake` from spacing and momentum; gaps do not change. \throws NumericsError with
  /// time and cell if no state exists.
  void solve(const std::vector<Block>& blocks, CellRange awake, double time);
  /// Finds only s, velocity and the largest slip velocities 2 sinh |phi| cosh psi of the first `size` trains. `solved`
  /// is false for a train that has no state.
  void solve_slip(std::size_t size, double* fastest);
  bool solved(std::size_t i) const { return solved_[i] != 0; }

 private:
  /// Like `solve`, but only with vector code, which leaves some trains without a solution.
  void solve_vector(std::size_t begin, std::size_t end);
  void solve_one(std::size_t i);
  std::vector<double> solved_;
};

/// The parts of a problem on which the equations in space depend.
struct Setup {
  std::vector<double> charge;  ///< dislocations in each cell, 0 in a gap
  Edge left = Edge::continued, right = Edge::continued;
  double left_wall = 0, right_wall = 0;  ///< x, where the edges are walls
  friction::Friction friction;
  std::function<double(double, double)> forcing;  ///< null: none
  std::function<double(double)> contact;          ///< a(x); null: 1
  bool friction_apart = false;                    ///< the rates of Semidiscrete are those without friction
};
Setup setup_of(const Problem& problem, const Cells& cells, FreeEdges free);

/// Whether friction damps slow trains at any rate, but does not hold them, as powers of the velocity below 1 do.
bool is_steep(const friction::Friction& friction);
/// Whether steps take friction cell by cell: where it has state variables, or is steep at rest.
bool takes_friction_by_cells(const Problem& problem);

}  // namespace slipfront::pulse
