#include "plane/averaged/loops.hpp"

namespace slipfront::plane {

bool Loops::innermost_vanishes() const {
  constexpr double nearly = 1e-3;  // fraction of the distance of the outermost loop
  const std::size_t inner = rows * angles;
  for (std::size_t k = 0; k < angles; ++k)
    if (!(r[inner + k] > nearly * r[k])) return true;
  return false;
}

void Loops::remove_innermost() {
  --rows;
  label.resize(rows + 1);
  r.resize((rows + 1) * angles);
  momentum.resize(cells());
  s.resize(cells());
  loss.resize(cells());
  limit = 0;
}

}  // namespace slipfront::plane
