#pragma once

#include <memory>

#include "pulse/space/semidiscrete.hpp"
#include "pulse/staggered/staggered.hpp"

namespace slipfront::pulse {

/// The equations in space on the present cells, in both forms: with reconstructed faces, and staggered for strong
/// friction.
class Equations {
 public:
  Equations(const Problem& problem, FreeEdges free) : problem_(problem), free_(free) {}

  /// Sets up the equations for other cells.
  void rebuild(const Cells& cells) {
    semidiscrete_ = std::make_unique<Semidiscrete>(setup_of(problem_, cells, free_));
    staggered_.reset();
  }
  Semidiscrete& semidiscrete() { return *semidiscrete_; }
  /// Creates the staggered equations on first use, because most runs never need them.
  Staggered& staggered(const Cells& cells) {
    if (!staggered_) staggered_ = std::make_unique<Staggered>(setup_of(problem_, cells, free_));
    return *staggered_;
  }

 private:
  const Problem& problem_;
  FreeEdges free_;
  std::unique_ptr<Semidiscrete> semidiscrete_;
  std::unique_ptr<Staggered> staggered_;
};

/// Unknowns of the staggered equations from the cells, and back.
void faces_from_cells(const Cells& cells, const Staggered& staggered, std::vector<double>& unknowns);
void cells_from_faces(const Staggered& staggered, const std::vector<double>& unknowns, Cells& cells);

}  // namespace slipfront::pulse
