#include "pulse/staggered/equations.hpp"

namespace slipfront::pulse {

void faces_from_cells(const Cells& cells, const Staggered& staggered, std::vector<double>& unknowns) {
  const std::size_t n = cells.size();
  unknowns.resize(staggered.size());
  const FaceValues faces(unknowns.data(), n + 1);
  const ConstValues values = cells.values();
  if (cells.face_momentum.empty())
    staggered.face_momenta(values.momenta(), &faces.momentum(0));
  else
    for (std::size_t f = 0; f <= n; ++f) faces.momentum(f) = cells.face_momentum[f];
  faces.left_edge() = values.left_edge();
  for (std::size_t i = 0; i < n; ++i) faces.width(i) = values.width(i);
  faces.dissipated() = values.dissipated();
  faces.supplied() = values.supplied();
  faces.through_ends() = values.through_ends();
}

void cells_from_faces(const Staggered& staggered, const std::vector<double>& unknowns, Cells& cells) {
  const std::size_t n = cells.size();
  const ConstFaceValues faces(unknowns.data(), n + 1);
  const Values values = cells.values();
  cells.face_momentum.resize(n + 1);
  values.left_edge() = faces.left_edge();
  for (std::size_t i = 0; i < n; ++i) values.width(i) = faces.width(i);
  for (std::size_t f = 0; f <= n; ++f) cells.face_momentum[f] = faces.momentum(f);
  staggered.cell_momenta(cells.face_momentum.data(), values.momenta());
  values.dissipated() = faces.dissipated();
  values.supplied() = faces.supplied();
  values.through_ends() = faces.through_ends();
}

}  // namespace slipfront::pulse
