#pragma once
/// \file
/// Where a chain starts: a train of dislocations at rest whose local density follows a stress profile (Eqs. 4-5 with
/// U = 0).

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace slipfront::chain {

/// The spacing of a grid unless another is given, in widths of a dislocation. At 0.5 the grid pins slow dislocations
/// (docs/chain.md, "The barrier of the grid").
inline constexpr double default_spacing = 0.4;

/// Evenly spaced sites: x = left + j spacing, j = 0 ... sites - 1, in b / A.
struct Grid {
  double left = 0;
  double spacing = default_spacing;
  std::size_t sites = 0;

  double x(std::size_t j) const { return left + static_cast<double>(j) * spacing; }
};

/// Displacement and velocity of every site at one time, in b / 2 pi and c A / 2 pi (u and u_t of Eq. 3).
struct Motion {
  std::vector<double> u;
  std::vector<double> velocity;  ///< empty: at rest
};

class LocalTrain;

/// The train at rest with <-u_x> = stress(x) >= 0; u falls with x. Where there is no stress u stays in a well, a
/// multiple of 2 pi, 0 at the right end. A segment with no stress at either end holds a whole number of dislocations:
/// its stress is changed by the less than half a dislocation that this takes. Where all is stressed and the stress
/// jumps, the jump lies midway between two dislocations: u is smooth there. With `whole` the entire chain does: what a
/// periodic chain needs. With `contact`, a(x), a place has psi of stress / a: the substrate is a^2 as strong, and the
/// train of Eq. 4 holds in the local units a x (docs/theory.md 6). Sites are made when asked for: nobody need hold them
/// all, and the bits of a site do not depend on what it is asked with. Costs some microseconds a site where the stress
/// changes.
class StaticTrain {
 public:
  /// Integrates the stress over the chain once. A stress below what a train can have (train::smallest_stress, of
  /// stress / a) counts as none. \throws InputError for a stress that is negative or not finite.
  StaticTrain(std::function<double(double x)> stress, const Grid& grid, bool whole = false,
              std::function<double(double x)> contact = {});

  /// Sites [begin, end).
  Motion operator()(std::size_t begin, std::size_t end) const;

 private:
  /// The running integral of the stress over 2 pi: dislocations left of a site.
  struct Charge {
    double sum = 0, lost = 0;  ///< compensated: 1e8 sites
    void add(double more);
  };
  /// Consecutive sites with stress, or without.
  struct Segment {
    std::size_t begin = 0, end = 0;
    bool empty = false;
    double from = 0, to = 0;  ///< charge at its edges
    double wells = 0;         ///< dislocations right of it
  };
  static constexpr std::size_t piece = 4096;  ///< the charge is kept at every so many sites

  double u(const Segment& segment, std::size_t site, double charge, LocalTrain& train) const;

  std::function<double(double)> stress_, contact_;
  Grid grid_;
  bool whole_;
  std::optional<double> jump_at_;  ///< dislocations left of the hardest jump from one stress to another
  std::vector<Charge> charges_;
  std::vector<Segment> segments_;
};

/// All sites of StaticTrain.
Motion static_train(const std::function<double(double x)>& stress, const Grid& grid, bool whole = false,
                    const std::function<double(double x)>& contact = {});

}  // namespace slipfront::chain
