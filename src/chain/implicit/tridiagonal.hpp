#pragma once

#include <cstddef>
#include <vector>

namespace slipfront::chain {

/// Solves A x = r with A tridiagonal, in place: `right` becomes x. `below[i]` and `above[i]` are next to the diagonal
/// in row i. Of a cyclic matrix below[0] and above[n - 1] are its corners. Without pivoting. The matrix is used up.
/// Nothing is allocated after the constructor.
class Tridiagonal {
 public:
  explicit Tridiagonal(std::size_t rows = 0);
  std::size_t rows() const { return diagonal.size(); }
  void solve(std::vector<double>& right, bool cyclic);

  std::vector<double> below, diagonal, above;

 private:
  void eliminate();
  void substitute(std::vector<double>& right) const;
  std::vector<double> scaled_, per_pivot_, correction_;
};

}  // namespace slipfront::chain
