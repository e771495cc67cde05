#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "averages/pulse/grid/cells.hpp"
#include "averages/pulse/space/cell_states.hpp"
#include "slipfront/friction/friction.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse {

/// The equations in space, docs/theory/3_modulation.md 3.4: time derivatives of the widths X and momenta Y of the
/// cells. They follow from the states in the cells (here), the states at the faces (reconstruction.cpp), the fluxes
/// there (kernels, face_fluxes) and the sources (sources.cpp). This class is independent of the time integrator.
///     X_t = [U] over the faces,   Y_t = -[p] + q_s (2 pi F - friction - l <1 - cos u> d(a^2)/dx)
/// With a contact ratio a(x), phi and psi are those in the local units a x, a t.
///
/// The unknowns are cell averages in the coordinate s, in which each cell has unit length. Point values follow by
/// deconvolution of fourth order. Face values follow by fifth-order WENO on the Riemann invariants, each from its own
/// side, which is the two-fan solution of the Riemann problem at the face.
class Semidiscrete {
 public:
  explicit Semidiscrete(Setup setup);

  std::size_t size() const { return setup_.charge.size(); }
  const std::vector<Block>& blocks() const { return blocks_; }

  /// Finds the rates dy of the unknowns y (NamedValues). \throws NumericsError with the time and the cell.
  void operator()(double t, const double* y, double* dy);
  /// Lets the next calls skip cells that are at rest and far from all moving cells, until `wake`. The arguments are
  /// those of the last call.
  void let_rest(const double* y, const double* dy);
  void wake() { awake_ = {0, size()}; }
  const CellRange& awake() const { return awake_; }
  /// Sets the initial guesses of s = tanh(psi) for the next solves. The last bits of a result depend on them.
  void start_from(const std::vector<double>& s);

  /// Results of the last call: states at the cell centres, rapidities and psi at the faces, friction rates (loss /
  /// momentum).
  std::vector<State> states() const;
  const CellStates& trains() const { return centres_.train; }
  const std::vector<double>& s() const { return centres_.train.s; }
  const std::vector<double>& face_phi() const { return faces_.phi; }
  const std::vector<double>& face_psi() const { return faces_.psi; }
  /// 1 in the cells near a shock, 0 elsewhere. Near a shock the error of a step comes from the size of the cells.
  const std::vector<double>& shocked() const { return reconstruction_.shocked; }
  double largest_friction_rate() const { return sources_.largest_friction_rate; }
  /// Friction rate of the cell with the largest momentum per dislocation; 0 if all cells are at rest.
  double friction_rate_of_fastest() const;
  /// Friction rate averaged over the momentum of the moving cells, from a sample of them.
  double mean_friction_rate() const;
  /// Finds the largest friction rate from the last call. This is needed only if the rates do not include friction
  /// (Setup::friction_apart), because the call itself finds it otherwise.
  void find_friction_rates() { find_rates(); }
  /// From the last call, finds the cell in the middle of the hardest collision, or size() if there is none. In a
  /// collision, streams of dislocations approach too fast for the pressure between them to stop them over two cells.
  /// The arguments are those of the call.
  std::size_t crossing(double t, const double* y) const;
  /// Least time in which a wave crosses a cell, or in which a cell loses three tenths of its width. A train that runs
  /// into a nearly empty block compresses cells faster than waves cross them.
  double crossing_time(const double* y, const double* dy) const;
  /// Time in which the fastest sound wave crosses a cell of average width.
  double mean_crossing_time(const double* y) const;

 private:
  static constexpr std::size_t ghosts = 3;  ///< cells that the reconstruction of a face uses on either side
  /// The awake cells of a block, counted from its first cell.
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
  void add_contact_force(double* dy);

  bool gap(std::size_t i) const { return setup_.charge[i] == 0; }

  /// Averages over the cells.
  struct Means {
    std::vector<double> phi, psi;
    std::vector<double> source;  ///< force on the cell
  };
  /// Values at the cell centres.
  struct Centres {
    CellStates train;
    std::vector<double> charge, per_charge;  ///< dislocations per unit of s, and the inverse
    std::vector<double> x, contact;          ///< x, a(x)
  };
  struct Faces {
    std::vector<double> phi, psi, velocity, pressure;
    std::vector<double> x, contact;
  };
  /// Input of WENO for one block, and the cells in which it takes plain values instead.
  struct Reconstruction {
    std::vector<double> plus, minus;  ///< Riemann invariants, averages over the cells, with ghosts
    std::vector<double> shocked;      ///< 1 in the cells near a shock, 0 elsewhere
    bool collides = false;            ///< some cell is near a shock
  };
  /// Changes of momentum other than those by the pressure, for each cell.
  struct Sources {
    std::vector<double> friction_rate;      ///< loss over momentum
    std::vector<double> friction_strength;  ///< mean of f over the train
    std::vector<double> shown_momentum;     ///< momentum of one dislocation, on which friction acts
    std::vector<double> resting_s;  ///< if the cell is at rest, the s for which the two above were found; else negative
    std::vector<double> fastest, shape, mean;  ///< largest slip velocity, least over largest, mean f
    std::vector<std::size_t> cell;             ///< cells of these arrays
    std::vector<double> force;                 ///< at the centre, per unit of s
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
