#pragma once
/// \file
/// The boundary of the held region on a grid. Where it crosses the line from a held cell to a free one, the slip is the
/// initial one and nothing moves. Gradients at such faces come from this point and the next free cells.

#include <array>
#include <vector>

#include "plane/grid/cells.hpp"

namespace slipfront::plane {

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
