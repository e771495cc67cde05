#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cell_states.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/pulse/named_values.hpp"
#include "slipfront/train/state.hpp"
#include "stretch.hpp"

namespace slipfront::pulse {

/// The equations in space: time derivatives of the cells' widths X and momenta Y. Knows nothing of time steps.
///     X_t = [U] over the faces,   Y_t = -[p] + q_s (2 pi F - friction - l <1 - cos u> d(a^2)/dx)
/// Where the contact ratio a(x) is not 1, phi and psi are those in the local units a x, a t.
/// Cell averages in the coordinate s (one cell a unit); point values by deconvolution, fourth order; faces by
/// fifth-order WENO on the Riemann invariants, each from its own side, which is the two-fan solution of the Riemann
/// problem at the face.
class Semidiscrete {
 public:
  struct Setup {
    std::vector<double> charge;  ///< dislocations in each cell, 0 in a gap
    Edge left = Edge::continued, right = Edge::continued;
    double left_wall = 0, right_wall = 0;  ///< x, where the edges are walls
    friction::Friction friction;
    std::function<double(double, double)> forcing;  ///< null: none
    std::function<double(double)> contact;          ///< a(x); null: 1
  };
  explicit Semidiscrete(Setup setup);

  std::size_t size() const { return setup_.charge.size(); }
  const std::vector<Stretch>& stretches() const { return stretches_; }

  /// From the unknowns y (NamedValues) to their rates dy. \throws NumericsError with time and place.
  void operator()(double t, const double* y, double* dy);
  /// Starts the next solves for s = tanh(psi) from these values: the bits of a result depend on where its solves start.
  void start_from(const std::vector<double>& s);

  /// From the last call: states at the cell centres, rapidities and psi at the faces, friction rates (loss over
  /// momentum).
  std::vector<State> states() const;
  const std::vector<double>& s() const { return at_.s; }
  const std::vector<double>& face_phi() const { return face_phi_; }
  const std::vector<double>& face_psi() const { return face_psi_; }
  /// 1 in the cells near a shock, 0 elsewhere: there the error of a step is that of the cells' size.
  const std::vector<double>& shocked() const { return shocked_; }
  double largest_friction_rate() const { return largest_rate_; }
  /// From the last call: the cell in the middle of the hardest collision between streams of dislocations that run into
  /// each other faster than the pressure between them could stop over two cells; none: size(). Arguments as of the
  /// call.
  std::size_t crossing(double t, const double* y) const;
  /// Least time in which a wave crosses a cell, or a cell that is being compressed loses three tenths of its width:
  /// what runs into a nearly empty stretch compresses cells faster than waves cross them.
  double crossing_time(const double* y, const double* dy) const;
  /// That of a cell of average width, at the fastest sound speed.
  double mean_crossing_time(const double* y) const;

 private:
  static constexpr std::size_t ghosts = 3;  ///< cells that a face sees to either side
  void find_states(double t, const double* y);
  void find_places(double t, const double* y);
  void find_edges(const double* y);
  void find_faces();
  void fill_ghosts(const Stretch& stretch, double* plus, double* minus) const;
  void find_faces(const Stretch& stretch);
  void flatten_shocks(const Stretch& stretch, const double* plus, const double* minus, double scale);
  void find_rates();
  void add_sources(double t, const double* y, double* dy);
  void add_contact_force(double* dy);

  bool gap(std::size_t i) const { return setup_.charge[i] == 0; }

  Setup setup_;
  std::unique_ptr<friction::RelaxationRate> relaxation_rate_;
  std::vector<Stretch> stretches_;
  std::vector<double> charge_point_;  ///< q_s at the centres
  std::vector<double> per_charge_point_;
  // At the cell centres.
  CellStates at_;
  std::vector<double> width_, momentum_in_cell_, phi_mean_, psi_mean_, rate_, strength_, source_, source_mean_,
      centres_;
  std::vector<double> invariant_plus_, invariant_minus_;  ///< cell averages of one stretch, with ghosts
  std::vector<double> face_phi_, face_psi_, face_U_, face_p_;
  std::vector<double> faces_, contact_, face_contact_, contact_force_;  ///< x of the faces; a(x) at centres and faces
  std::vector<double> shocked_;
  double largest_rate_ = 0;
  bool collides_ = false;  ///< some cell is near a shock
};

}  // namespace slipfront::pulse
