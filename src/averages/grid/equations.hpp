#pragma once
/// \file
/// The averaged equation on a fixed grid, for the mean slip U and the wave action I = g U_t:
///     U_t = V |grad U|,    I_t = div(g grad U) + F - <f>,    g = 4 E K / pi^2
/// V and g are those of the train with the density |grad U| / (2 pi) and the momentum 2 pi I per dislocation.
///
/// The cells of the averaged solver on a fixed grid. Arrays have ghost cells around the domain. A face has the index of
/// the cell to its right, or above it.
///
/// The boundary of the held region on a grid. Where it crosses the line from a held cell to a free one, the slip is the
/// initial one and nothing moves. Gradients at such faces come from this point and the next free cells.

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "slipfront/lattice/plane/problem.hpp"
#include "system/team.hpp"
#include "theory/modulation/modulation.hpp"

namespace slipfront::plane {

struct Cells {
  static constexpr std::size_t ghosts = 3;
  std::size_t nx = 0, ny = 0;
  double left = 0, bottom = 0;
  double hx = 0, hy = 0;

  std::size_t stride() const { return nx + 2 * ghosts; }
  std::size_t size() const { return stride() * (ny + 2 * ghosts); }
  std::size_t at(std::size_t i, std::size_t j) const { return (j + ghosts) * stride() + i + ghosts; }
  double x(std::size_t i) const { return left + (static_cast<double>(i) + 0.5) * hx; }
  double y(std::size_t j) const { return bottom + (static_cast<double>(j) + 0.5) * hy; }
  Point centre(std::size_t cell) const {
    const std::size_t column = cell % stride(), row = cell / stride();
    return {left + (static_cast<double>(column) - ghosts + 0.5) * hx,
            bottom + (static_cast<double>(row) - ghosts + 0.5) * hy};
  }
  /// Distance in an array from a cell to the next one, along x or y.
  std::size_t step(bool along_y) const { return along_y ? stride() : 1; }
  double spacing(bool along_y) const { return along_y ? hy : hx; }

  bool at_edge(std::size_t i, std::size_t j) const { return i == 0 || j == 0 || i + 1 == nx || j + 1 == ny; }

  /// Calls act(i, j, cell) for each cell of the domain.
  template <class Act>
  void each(const Act& act) const {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) act(i, j, at(i, j));
  }
  /// Copies the outermost cells into the ghost cells, as a mirror does: no stress acts at the edges.
  template <class Value>
  void mirror(std::vector<Value>& values) const {
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t g = 0; g < ghosts; ++g) {
        values[at(0, j) - 1 - g] = values[at(g, j)];
        values[at(nx - 1, j) + 1 + g] = values[at(nx - 1 - g, j)];
      }
    for (std::size_t g = 0; g < ghosts; ++g)
      for (std::size_t i = 0; i < stride(); ++i) {
        values[(ghosts - 1 - g) * stride() + i] = values[(ghosts + g) * stride() + i];
        values[(ghosts + ny + g) * stride() + i] = values[(ghosts + ny - 1 - g) * stride() + i];
      }
  }
};

class Walls {
 public:
  /// \throws InputError for a held region without the centre of a cell.
  Walls(const Problem& problem, const Cells& cells);

  bool empty() const { return held_.empty(); }
  bool held(std::size_t cell) const { return !held_.empty() && held_[cell] != 0; }
  /// Whether a face separates a held cell from a free one.
  bool at_face(std::size_t face, bool along_y) const { return held(face) != held(face - cells_.step(along_y)); }
  /// Whether a stencil of five cells along x or y around the cell contains a held one.
  bool near(std::size_t cell, bool along_y) const { return !held_.empty() && near_[along_y ? 1 : 0][cell] != 0; }

  /// Sets the gradients of the slip at the faces of the boundary, along x or y.
  void set_gradients(const std::vector<double>& slip, bool along_y, std::vector<double>& gradient) const;
  /// Sets the wave action at these faces, which is 0 at the boundary.
  void set_actions(const std::vector<double>& action, bool along_y, std::vector<double>& at_faces) const;
  /// Sets the gradients along the other direction at these faces.
  void set_transverse(const std::vector<double>& in_cells, bool along_y, std::vector<double>& at_faces) const;

 private:
  struct Crossing {
    std::size_t face;
    std::array<std::size_t, 3> free;  ///< the next free cells
    std::size_t count;                ///< how many of them are free in a row
    double sign;                      ///< 1 if the free cells are on the side of larger x or y
    double place;                     ///< from the face towards the first free cell, in cells: -1/2 to 1/2
    double slip;
  };
  void refuse_unseen(const Problem& problem) const;
  void find(const Problem& problem, bool along_y);

  const Cells cells_;
  std::vector<char> held_;
  std::array<std::vector<char>, 2> near_;
  std::array<std::vector<Crossing>, 2> crossings_;
};

/// The unknowns in each cell. Outside the rupture front, `slip` continues with negative values for a few cells, so
/// that it is 0 at the front. `action` continues, too.
struct Averages {
  std::vector<double> slip;    ///< U, in b / 2 pi
  std::vector<double> action;  ///< I
};

/// Gradient of the slip below which there are nearly no dislocation lines.
inline constexpr double no_lines = 0.05;

/// States of trains at some cells or faces, for solve_states.
struct Trains {
  std::vector<std::size_t> at;    ///< cells or faces, row by row
  std::vector<std::size_t> rows;  ///< index of the first train in each row of cells, and the number of trains
  std::vector<double> gradient, spacing, momentum, s, phi, psi, sound, EK, velocity, solved;
  std::vector<double> contact;  ///< empty: 1
  std::vector<double> guess;    ///< tanh(psi) of the last solution, for all cells or faces
  /// Calls act(first, last) for the trains of a row, unless there are none.
  template <class Act>
  void in_row(std::size_t j, const Act& act) const {
    if (rows[j] < rows[j + 1]) act(rows[j], rows[j + 1]);
  }
  void resize(std::size_t count);
  modulation::StateArrays arrays(std::size_t first, std::size_t last);
  void solve_again(std::size_t first, std::size_t last);
};
/// Finds the states of some trains from spacings, momenta and guesses. \throws NumericsError, whose position `where`
/// gives, if there is none.
void solve(Trains& trains, std::size_t first, std::size_t last,
           const std::function<std::string(std::size_t)>& where = {});
/// Density of the energy of a train, g |grad U|^2 - a^2 p.
double energy_density(const Trains& trains, std::size_t i);
/// Sets the spacing from the gradient. Where there are nearly no lines, it is that of `no_lines`.
void set_spacing(Trains& trains, std::size_t i);

class GridEquations {
 public:
  GridEquations(const Problem& problem, const Cells& cells, const Walls& walls, int threads = 1);

  /// Calls act(first, last) for the trains of each row that has some, on all threads.
  template <class Act>
  void each_row(const Trains& trains, const Act& act) const {
    for_each_on_team(
        cells_.ny, threads_, [&](std::size_t j) { trains.in_row(j, act); }, rows_at_once);
  }
  /// Calls act(i, cell) for each train in a cell, on all threads.
  template <class Act>
  void each_train(const Act& act) const {
    each_row(in_cells_, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) act(i, in_cells_.at[i]);
    });
  }
  /// Sum over the trains in cells of act(i, cell). Its order does not depend on the number of threads.
  template <class Act>
  double sum_over_trains(const Act& act) const {
    std::vector<double> sums(cells_.ny);
    for_each_on_team(
        cells_.ny, threads_,
        [&](std::size_t j) {
          for (std::size_t i = in_cells_.rows[j]; i < in_cells_.rows[j + 1]; ++i) sums[j] += act(i, in_cells_.at[i]);
        },
        rows_at_once);
    return std::accumulate(sums.begin(), sums.end(), 0.0);
  }

  /// Chooses the cells that move: those whose slip is known.
  void set_known(const std::vector<char>& known);
  /// Finds the rates without friction and without loads. \throws NumericsError with time and position if no state has
  /// these numbers.
  void find_rates(double t, Averages& now, Averages& rate);

  // Results of the last call, for the cells in trains().at.
  const Trains& trains() const { return in_cells_; }
  /// Whether dislocation lines of different directions meet.
  bool lines_meet() const { return lines_meet_; }
  /// Whether a cell has no lines around.
  bool is_flat(std::size_t cell) const;
  /// A cell that has slip: the size of the gradient on its side inside the front, and the area up to the front, in
  /// cells.
  struct Inside {
    double gradient, area;
  };
  Inside inside(std::size_t cell, const std::vector<double>& slip) const;
  /// The initial guesses of the next solution, in cells and at faces along x and y.
  using Guesses = std::array<std::vector<double>, 3>;
  Guesses guesses() const { return {in_cells_.guess, in_faces_[0].guess, in_faces_[1].guess}; }
  void set_guesses(const Guesses& guesses) {
    in_cells_.guess = guesses[0];
    in_faces_[0].guess = guesses[1];
    in_faces_[1].guess = guesses[2];
  }

 private:
  static constexpr long rows_at_once = 2;  ///< few, because rows of all lengths are next to each other

  double gradient_in(std::size_t cell) const {
    return std::sqrt(slope_[0][cell] * slope_[0][cell] + slope_[1][cell] * slope_[1][cell]);
  }
  void find_gradients(const std::vector<double>& slip);
  // These functions treat the trains of one row.
  void find_slopes(std::size_t first, std::size_t last);
  bool meet(const Averages& now, std::size_t i) const;
  void solve_at(double t, Trains& trains, std::size_t first, std::size_t last, const std::vector<double>& action);
  void find_slip_rates(std::size_t first, std::size_t last, Averages& rate) const;
  void find_transverse(std::size_t first, std::size_t last, bool along_y);
  void find_actions(const Averages& now, std::size_t first, std::size_t last, bool along_y);
  void find_fluxes(double t, std::size_t first, std::size_t last, std::size_t direction);

  void find_fluxes(double t, const Averages& now);

  const Problem& problem_;
  const Cells& cells_;
  const Walls& walls_;
  const int threads_;
  std::vector<char> known_;
  Trains in_cells_;
  std::array<Trains, 2> in_faces_;                       ///< along x and y
  std::array<std::vector<double>, 2> gradient_, slope_;  ///< gradients of the slip, at faces and in cells
  std::array<std::vector<double>, 2> flux_;
  std::vector<double> spread_;                                       ///< half the jumps of the slopes of each cell
  std::array<std::vector<double>, 2> transverse_, at_faces_, jump_;  ///< at faces: gradients, actions
  std::atomic<bool> lines_meet_ = false;
};

}  // namespace slipfront::plane
