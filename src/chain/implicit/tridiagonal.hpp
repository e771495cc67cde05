#pragma once

#include <cstddef>
#include <vector>

#include "foundation/ranks.hpp"

namespace slipfront::chain {

/// Solves A x = r with A tridiagonal, in place: `right` becomes x. `below[i]` and `above[i]` are next to the diagonal
/// in row i. Of a cyclic matrix, the first `below` and the last `above` are its corners; otherwise they are 0. Without
/// pivoting. The matrix is used up. Nothing is allocated after the constructor.
///
/// Several ranks may share the rows, each those of its sites. They eliminate one after the other, with the operations
/// and the order of a single process, and so get the same bits.
class Tridiagonal {
 public:
  /// A matrix with so many rows on this rank.
  explicit Tridiagonal(std::size_t rows = 0);
  /// (all) `right` has the rows of this rank.
  void solve(std::vector<double>& right, bool cyclic, const Ranks& ranks);

  std::vector<double> below, diagonal, above;

 private:
  void eliminate(std::vector<double>& right, const Ranks& ranks);
  void eliminate_cyclic(std::vector<double>& right, const Ranks& ranks);
  void move_corners(const Ranks& ranks, double upper, double gamma);
  std::vector<double> scaled_, correction_;
};

}  // namespace slipfront::chain
