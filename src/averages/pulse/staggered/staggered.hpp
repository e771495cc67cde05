#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/space/cell_states.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "math/roots.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// The equations in space for friction that damps a wave before it has crossed a cell. We store widths in the cells and
/// momenta at the faces. The force on a face is then the difference of the pressures on its two sides, and nothing has
/// to be reconstructed:
///     X_t = [U] over the cell's faces,   Y_t = -[p] over the face's cells + q_f (2 pi F - loss).
/// The scheme has second order. A face has the Darcy flux, M = -p_q / C, if the momentum has relaxed, and its own
/// momentum if it has not. Both limits hold for any size of cell. With a contact ratio a(x) the force is -2 pi g_x /
/// cosh(phi), g = (4 / pi) a cosh(psi) E, which vanishes exactly for trains in equilibrium.
class Staggered {
 public:
  explicit Staggered(Setup setup);

  /// Number of unknowns (NamedFaceValues). The momentum Y around a face is that between the middles of its two cells.
  std::size_t size() const { return FaceValues::size(faces()); }
  std::size_t faces() const { return setup_.charge.size() + 1; }
  /// Number of entries on either side that a rate depends on, if positions replace the widths.
  static constexpr std::size_t reach = 3;

  void operator()(double t, const double* z, double* dz);

  /// Takes one step of the semi-implicit Euler method, of first order. It advances first the momenta, with implicit
  /// friction at each face, and then the widths with the new velocities. The step is stable under any friction if no
  /// wave crosses a cell in `dt`. Friction that is steep at rest needs no small steps, because we solve for its force
  /// at the end of the step.
  void split_step(double t, double dt, const double* z, double* next);
  /// tanh(psi) of the cells: the initial guess of the next solve, and the result of the last.
  void start_from(const std::vector<double>& s) { cells_.s = s; }
  const std::vector<double>& s() const { return cells_.s; }

  /// Sets the velocity below which friction that is steep at rest, such as a power below 1, is replaced by viscous
  /// friction. At such velocities its force is within rounding of the other forces.
  void viscous_below(double velocity) { creep_ = velocity; }

  /// Terminal motion under the largest force on a dislocation: the momentum and the velocity at which friction balances
  /// this force. The forces are those in `rates`, found at rest.
  struct Terminal {
    double momentum, velocity;
    double rate;  ///< friction rate at that momentum
  };
  Terminal terminal(const double* rates) const;

  /// Rapidities of the dislocations at the faces, from the last call.
  const std::vector<double>& face_phi();

  /// Momenta at the faces from those in the cells, and back.
  void face_momenta(const double* cell_momenta, double* face_momenta) const;
  void cell_momenta(const double* face_momenta, double* cell_momenta) const;
  /// Dislocations around a face.
  double charge_around(std::size_t face) const { return charge_[face]; }

 private:
  double charge_left(std::size_t face) const { return face > 0 ? setup_.charge[face - 1] : 0; }
  double charge_right(std::size_t face) const { return face < setup_.charge.size() ? setup_.charge[face] : 0; }
  bool is_edge(std::size_t face) const { return charge_left(face) == 0 || charge_right(face) == 0; }
  void find_cells(double t, const double* z);
  void find_masses(double t, const double* z);
  double force_on(std::size_t face) const;
  double push_on(std::size_t face, double t) const;
  double power_through(std::size_t face, double U) const;
  double held_by_wall(std::size_t face, double force) const;
  void slow_down(const std::vector<double>& free, double time);
  Edge edge_at(std::size_t face) const;
  double loss_rate(std::size_t face, double phi) const;
  void find_loss_rates();
  /// Velocity below which friction that is steep at rest is viscous; 0 for other laws.
  double creep() const;
  double contact_at(std::size_t face) const { return setup_.contact ? setup_.contact(place_[face]) : 1; }
  /// Mean over the cells with dislocations on either side of a face.
  double beside(const std::vector<double>& values, std::size_t face) const;

  struct FaceBracket : Bracket {
    bool done = false;
  };

  Setup setup_;
  double creep_ = 0;
  std::unique_ptr<friction::RelaxationRate> relaxation_rate_;
  std::vector<Block> blocks_;
  CellStates cells_;
  std::vector<double> width_, pressure_, balance_, a_;  ///< values in the cells; gaps have no pressure
  std::vector<double> mass_;                            ///< cosh(psi) E, an eighth of M / sinh(phi)
  // Values at the faces.
  std::vector<double> charge_, place_, face_a_;
  std::vector<double> on_one_, face_mass_, sinh_phi_, cosh_phi_, U_,
      face_phi_;                                     ///< on_one_: momentum per dislocation; face_mass_: M / sinh(phi)
  std::vector<double> free_, free_on_one_, pushes_;  ///< work arrays of split steps
  std::vector<FaceBracket> brackets_;
  std::vector<double> psi_, fastest_, s_, per_momentum_, mean_, loss_rate_;  ///< the trains at the faces
};

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
