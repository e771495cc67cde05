#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "lattice/chain/model/periodic_force.hpp"

namespace slipfront::chain {

/// All that an explicit chain needs to continue, to the same bits: two levels of z / 2 pi (docs/chain.md), and the
/// state of friction if it has any.
struct Levels {
  long level = 0;  ///< steps done
  std::vector<double> now, before;
  /// The friction law's state variables, site by site, and those of contacts that change (state_names in
  /// contact_field.hpp). Empty at a start.
  std::vector<double> state = {};
};

/// The levels of sites [begin, end), for chains that no process holds whole.
using LevelsOf = std::function<Levels(std::size_t begin, std::size_t end)>;

/// The force S = a^2 sin u of a substrate of strength a^2, as a function of z = u + eps S. It is a^2 times a
/// PeriodicForce whose coefficients are polynomials in a^2, so that no equation is solved for u.
struct ContactForce {
  static constexpr int powers = 5;
  double c[PeriodicForce::terms][powers] = {};

  /// Coefficient k of the PeriodicForce. It is always inlined, with its loops unrolled, so that loops over sites become
  /// vector code.
  [[gnu::always_inline]] double coefficient(int k, double a2) const {
    double p = c[k][powers - 1];
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC unroll 16
#endif
    for (int i = powers - 2; i >= 0; --i) p = p * a2 + c[k][i];
    return p;
  }
};

/// The force for 0 <= a^2 <= `most`. Its error is that of PeriodicForce at eps a^2.
ContactForce contact_force(double eps, double most);

/// The loops over sites in which a chain spends its time. They are vector code that is chosen at run time (AVX-512,
/// AVX2 or plain). Every site goes through the same operations, wherever it is in a vector, so tiles and threads do not
/// change the results.

/// The coefficients of one step from z to z at the next level, which takes two loops:
///     S = f(z)    y = z - coupled S    next = keep z - force S - before z_old    next += spread (y_left + y_right)
struct LevelRule {
  PeriodicForce f;
  double coupled = 0, keep = 0, force = 0, before = 0, spread = 0;
};

inline constexpr std::size_t lanes = 8;  ///< ranges are multiples of this; arrays are aligned to this number of doubles

/// Consecutive blocks of sites: block i has those from begins[i] to begins[i + 1], counted from begins[0] on, which is
/// at `at` in arrays. Its sum is that of `lanes` numbers, one for each lane of a vector, from sums + i stride on. All
/// begin at whole vectors, so that the order of a sum depends only on its block. The site at the end of a chain has
/// half a spacing. Arrays
/// end with whole vectors.
struct BlockSums {
  const std::size_t* begins = nullptr;
  std::size_t blocks = 0;
  double* sums = nullptr;
  std::size_t stride = 0, at = 0;
  bool half_first = false, half_last = false;

  std::size_t begin(std::size_t i) const { return at + (begins[i] - begins[0]); }
};

/// The measures of the first loop: u at the level that it starts from, in turns, and the step D since the
/// level before. Sums of blocks get, times `factor`, |D|, |D|^3, or D^2 + B^2 / 12 with B = D - D_before (WorkMeter).
/// `only_` those that keep no D.
enum class Measured { nothing, steps, only_absolutes, absolutes, squares, only_cubes };
struct StepOfU {
  Measured what = Measured::nothing;
  double eps = 0;
  double *u = nullptr, *D = nullptr;  ///< at the level before; they become those of this level
  const double* D_before = nullptr;   ///< D at the level before; may be the same array
  BlockSums to = {};
  double factor = 0;
};

/// The first loop, over [begin, end). `old` is the level before, and may be the same array as `next`.
void local_part(const LevelRule& rule, const double* now, const double* old, double* next, double* y, std::size_t begin,
                std::size_t end, const StepOfU& step = {});
/// The coefficients of the force on sites [begin, end), for the loops below. A vector of sites has its first
/// coefficients next to each other, then its second ones, and so on.
void contact_coefficients(const ContactForce& f, const double* a2, double* coefficients, std::size_t begin,
                          std::size_t end);
/// The first loop for a substrate of strength a(x)^2. It ignores rule.f, and costs hardly more than a constant a.
void local_part_with_coefficients(const LevelRule& rule, const double* coefficients, const double* now,
                                  const double* old, double* next, double* y, std::size_t begin, std::size_t end,
                                  const StepOfU& step = {});
/// Computes u and S from z, with Newton's method. `a2` is null if it is 1 everywhere.
void displacements(const PeriodicForce& sine, double eps, const double* a2, const double* z, double* u, double* S,
                   std::size_t size);
/// Computes only u = z - eps S on sites [begin, end), with the polynomial of the force; `coefficients` as above, or
/// null if a is 1 everywhere.
void displacements(const PeriodicForce& f, double eps, const double* coefficients, const double* z, double* u,
                   std::size_t begin, std::size_t end);
/// The second loop. It reads y from begin - 1 to end.
void add_neighbours(double spread, const double* y, double* next, std::size_t begin, std::size_t end);
/// Adds them, and then shortens steps as shorten_steps does.
void add_neighbours_and_shorten(double spread, double most, const double* y, const double* now, double* next,
                                std::size_t begin, std::size_t end);

/// A force on consecutive sites as a sum of functions X of x, each times a weight that changes from level to level.
struct ForceTerms {
  static constexpr std::size_t most = 8;
  using Weights = std::array<double, most>;

  std::size_t count = 0;
  std::array<const double*, most> X = {};
};
/// Adds to z at the next level the effect of a force, which is shared among the five points of the diamond: `own` are
/// the weights of X at the site, `of_neighbours` those at its neighbours, one site more on either side.
void add_drive(const ForceTerms& F, const ForceTerms::Weights& own, const ForceTerms::Weights& of_neighbours,
               double* next, std::size_t size);
/// Adds `drive`, which is that effect of a force that does not change.
void add_steady_drive(const double* drive, double* next, std::size_t size);
/// Applies Coulomb friction: shortens each step from `now` to `next` by `most`, but not below zero. Friction can stop a
/// site, but not reverse its motion. NaN stays NaN.
void shorten_steps(double most, const double* now, double* next, std::size_t size);

/// Sets `velocity` to (next - now) times `per_step`.
void velocities(double per_step, const double* now, const double* next, double* velocity, std::size_t size);
/// Add `factor` times a or the products of a and b to the sums of blocks. The arrays begin at the first site of the
/// blocks.
void add_values(const BlockSums& to, double factor, const double* a);
void add_products(const BlockSums& to, double factor, const double* a, const double* b);
/// Adds `factor` times the work of a force in steps D, whose second differences are D - D_before: of_D and of_B are the
/// weights of X in the factors of both (WorkMeter).
void add_works(const BlockSums& to, double factor, const ForceTerms& F, const ForceTerms::Weights& of_D,
               const ForceTerms::Weights& of_B, const double* D, const double* D_before);
/// Energy that contacts give to the substrate at each site when a^2 changes from a2 to a2_next. The step D ends at `u`
/// (turns).
void energies_of_contacts(const PeriodicForce& sine, const double* a2, const double* a2_next, const double* u,
                          const double* D, double* energy, std::size_t size);

/// The largest |z| for which the range reduction is right, in turns.
inline constexpr double most_turns = 2251799813685248;
/// Whether every |z| is less than `most`. It is false if any z is NaN.
bool bounded(const double* z, std::size_t size, double most = most_turns);

}  // namespace slipfront::chain
