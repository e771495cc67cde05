#pragma once
/// \file
/// The cells of the averaged solver on a fixed grid. Arrays have ghost cells around the domain. A face has the index of
/// the cell to its right, or above it.
/// The boundary of the held region on a grid. Where it crosses the line from a held cell to a free one, the slip is the
/// initial one and nothing moves. Gradients at such faces come from this point and the next free cells.

#include <array>
#include <cstddef>
#include <vector>

#include "slipfront/lattice/plane/problem.hpp"

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

}  // namespace slipfront::plane
