#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "pulse/grid/values.hpp"
#include "pulse/space/block.hpp"
#include "pulse/space/cell_states.hpp"
#include "pulse/space/setup.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/modulation/per_dislocation.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {

/// The equations in space, docs/theory.md 3.4: time derivatives of the cells' widths X and momenta Y, from the states
/// in the cells (here), at their faces (reconstruction.cpp), the fluxes there (kernels, face_fluxes) and the sources
/// (sources.cpp). Knows nothing of time steps.
///     X_t = [U] over the faces,   Y_t = -[p] + q_s (2 pi F - friction - l <1 - cos u> d(a^2)/dx)
/// Where the contact ratio a(x) is not 1, phi and psi are those in the local units a x, a t.
/// Cell averages in the coordinate s (one cell a unit); point values by deconvolution, fourth order; faces by
/// fifth-order WENO on the Riemann invariants, each from its own side, which is the two-fan solution of the Riemann
/// problem at the face.
class Semidiscrete {
 public:
  explicit Semidiscrete(Setup setup);

  std::size_t size() const { return setup_.charge.size(); }
  const std::vector<Block>& blocks() const { return blocks_; }

  /// From the unknowns y (NamedValues) to their rates dy. \throws NumericsError with time and place.
  void operator()(double t, const double* y, double* dy);
  /// Leaves the cells alone, in the calls to come, that are at rest and far from all that move, until `wake`. From the
  /// arguments of the last call.
  void let_rest(const double* y, const double* dy);
  void wake() { awake_ = {0, size()}; }
  const CellRange& awake() const { return awake_; }
  /// Starts the next solves for s = tanh(psi) from these values: the bits of a result depend on where its solves start.
  void start_from(const std::vector<double>& s);

  /// From the last call: states at the cell centres, rapidities and psi at the faces, friction rates (loss over
  /// momentum).
  std::vector<State> states() const;
  const CellStates& trains() const { return centres_.train; }
  const std::vector<double>& s() const { return centres_.train.s; }
  const std::vector<double>& face_phi() const { return faces_.phi; }
  const std::vector<double>& face_psi() const { return faces_.psi; }
  /// 1 in the cells near a shock, 0 elsewhere: there the error of a step is that of the cells' size.
  const std::vector<double>& shocked() const { return reconstruction_.shocked; }
  double largest_friction_rate() const { return sources_.largest_friction_rate; }
  /// That of the cell with the most momentum a dislocation; 0 where all rest.
  double friction_rate_of_fastest() const;
  /// Mean over the momentum of the cells that move, of some of them.
  double mean_friction_rate() const;
  /// From the last call, where friction is apart: finds the largest rate, which the call itself does else.
  void find_friction_rates() { find_rates(); }
  /// From the last call: the cell in the middle of the hardest collision between streams of dislocations that run into
  /// each other faster than the pressure between them could stop over two cells; none: size(). Arguments as of the
  /// call.
  std::size_t crossing(double t, const double* y) const;
  /// Least time in which a wave crosses a cell, or a cell that is being compressed loses three tenths of its width:
  /// what runs into a nearly empty block compresses cells faster than waves cross them.
  double crossing_time(const double* y, const double* dy) const;
  /// That of a cell of average width, at the fastest sound speed.
  double mean_crossing_time(const double* y) const;

 private:
  static constexpr std::size_t ghosts = 3;  ///< cells that a face sees to either side
  /// The cells of a block that are awake, counted from its first.
  CellRange awake_in(const Block& block) const {
    const CellRange part = common(block, awake_);
    return {part.begin - block.begin, part.end - block.begin};
  }
  void find_states(double t, const double* y);
  void find_places(double t, const double* y);

  // Reconstruction (reconstruction.cpp).
  void find_edges(const double* y);
  void find_faces();
  void fill_ghosts(const Block& block, double* plus, double* minus) const;
  void find_faces(const Block& block);
  void flatten_shocks(const Block& block, const double* plus, const double* minus, double scale);

  // Sources (sources.cpp).
  void find_rates();
  void find_strengths();
  void add_sources(double t, const double* y, double* dy);
  struct Powers {
    double dissipation = 0, supply = 0;
  };
  Powers find_forces(double t, bool rated, bool in_force);
  void add_contact_force(const double* y, double* dy);

  bool gap(std::size_t i) const { return setup_.charge[i] == 0; }

  /// Averages over the cells.
  struct Means {
    std::vector<double> phi, psi;
    std::vector<double> source;  ///< force on the cell
  };
  /// Values at the cell centres.
  struct Centres {
    CellStates train;
    std::vector<double> charge, per_charge;  ///< dislocations in a unit of s, and its inverse
    std::vector<double> x, contact;          ///< place, a(x)
  };
  struct Faces {
    std::vector<double> phi, psi, velocity, pressure;
    std::vector<double> x, contact;
  };
  /// What WENO sees of one block, and where it falls back on plain values.
  struct Reconstruction {
    std::vector<double> plus, minus;  ///< Riemann invariants, averages over the cells, with ghosts
    std::vector<double> shocked;      ///< 1 in the cells near a shock, 0 elsewhere
    bool collides = false;            ///< some cell is near a shock
  };
  /// What changes momentum beside the pressure, of each cell.
  struct Sources {
    std::vector<double> friction_rate;         ///< loss over momentum
    std::vector<double> friction_strength;     ///< mean of f over the train
    std::vector<double> shown_momentum;        ///< of one dislocation, which friction takes from
    std::vector<double> resting_s;             ///< s of a cell at rest that the two were found for; else negative
    std::vector<double> fastest, shape, mean;  ///< of some cells: largest slip velocity, least over it, mean of f
    std::vector<std::size_t> cell;             ///< which
    std::vector<double> force;                 ///< in a unit of s, at the centre
    std::vector<double> contact_force;
    std::vector<double> substrate, substrate_at_faces;  ///< <1 - cos u>
    double largest_friction_rate = 0;
  };

  Setup setup_;
  std::unique_ptr<friction::RelaxationRate> relaxation_rate_;
  std::vector<Block> blocks_;
  CellRange awake_{0, 0};
  Means means_;
  Centres centres_;
  Faces faces_;
  Reconstruction reconstruction_;
  Sources sources_;
};

}  // namespace slipfront::pulse
