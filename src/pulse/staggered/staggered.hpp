#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "foundation/math/bracket.hpp"
#include "pulse/grid/values.hpp"
#include "pulse/space/cell_states.hpp"
#include "pulse/space/setup.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::pulse {

/// The equations in space where friction damps a wave before it has crossed a cell: widths live in the cells, momenta
/// at the faces, so that the force on a face is the difference of the pressures beside it and nothing has to be
/// reconstructed,
///     X_t = [U] over the cell's faces,   Y_t = -[p] over the face's cells + q_f (2 pi F - loss).
/// Second order. A face carries the flux of Darcy, M = -p_q / C, where the momentum has relaxed, and its own momentum
/// where it has not: both limits hold for any size of cell. With a contact ratio a(x) the force is
/// -2 pi g_x / cosh(phi), g = (4 / pi) a cosh(psi) E, which vanishes exactly for trains in equilibrium.
class Staggered {
 public:
  explicit Staggered(Setup setup);

  /// Of its unknowns (NamedFaceValues); the momentum Y around a face is that from the middle of one cell to that of the
  /// next.
  std::size_t size() const { return FaceValues::size(faces()); }
  std::size_t faces() const { return setup_.charge.size() + 1; }
  /// Entries to either side that a rate depends on, widths taken as places.
  static constexpr std::size_t reach = 3;

  void operator()(double t, const double* z, double* dz);

  /// A step of the semi-implicit Euler method: the momenta first, with friction implicit and face by face, then the
  /// widths by the new velocities. First order, and stable under any friction where no wave crosses a cell in `dt`.
  /// Friction that is steep at rest needs no small steps here, as its force at the end of the step is solved for.
  void split_step(double t, double dt, const double* z, double* next);
  /// tanh(psi) of the cells: where the next solves start, and what the last found.
  void start_from(const std::vector<double>& s) { cells_.s = s; }
  const std::vector<double>& s() const { return cells_.s; }

  /// Friction that is steep at rest, like powers below 1, changes to a viscous one at velocities of this size and less:
  /// there its force is rounding of what else acts.
  void viscous_below(double velocity) { creep_ = velocity; }

  /// What a dislocation moves at where friction takes all of the largest force on one, of those in `rates` from rest.
  struct Terminal {
    double momentum, velocity;
    double rate;  ///< at which friction takes such a momentum
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
  /// Below this velocity friction that is steep at rest is viscous; 0 for others.
  double creep() const;
  double contact_at(std::size_t face) const { return setup_.contact ? setup_.contact(place_[face]) : 1; }
  /// Mean over the cells beside a face that hold dislocations.
  double beside(const std::vector<double>& values, std::size_t face) const;

  struct FaceBracket : Bracket {
    bool done = false;
  };

  Setup setup_;
  double creep_ = 0;
  std::unique_ptr<friction::RelaxationRate> relaxation_rate_;
  std::vector<Block> blocks_;
  CellStates cells_;
  std::vector<double> width_, pressure_, balance_, a_;  ///< of the cells, where gaps have no pressure
  std::vector<double> mass_;                            ///< cosh(psi) E, an eighth of M / sinh(phi)
  // At the faces.
  std::vector<double> charge_, place_, face_a_;
  std::vector<double> on_one_, face_mass_, sinh_phi_, cosh_phi_, U_,
      face_phi_;                                     ///< momentum of a dislocation, M / sinh
  std::vector<double> free_, free_on_one_, pushes_;  ///< of split steps
  std::vector<FaceBracket> brackets_;
  std::vector<double> psi_, fastest_, s_, per_momentum_, mean_, loss_rate_;  ///< of the trains there
};

}  // namespace slipfront::pulse
