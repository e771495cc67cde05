#pragma once
/// \file
/// The modulation equations with friction, Eqs. (7), solved in the coordinate that counts dislocations
/// (docs/theory.md 3.4):
///     l_t = U_q,   M_t + p_q = 2 pi F - friction,   p = 2 sinh^2 psi.
/// Finite volumes in a coordinate s, one cell a unit, with q(s) fixed: the number of dislocations in a cell never
/// changes, an empty region is a free edge (p = 0) and no cell, and a slow pulse (V ~ 1e-26) is computed like a fast
/// one.

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "slipfront/friction/friction.hpp"
#include "slipfront/pulse/end.hpp"
#include "slipfront/pulse/named_values.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::pulse {

struct MemoryStep;
class Places;
class Semidiscrete;
class Staggered;

/// What to solve.
struct Problem {
  std::function<double(double)> stress;               ///< initial stress at x, >= 0; the interface is at rest
  std::function<double(double x, double t)> forcing;  ///< F; null: none
  std::function<double(double)> contact = {};         ///< relative contact ratio a(x) > 0; null: 1
  friction::Friction friction;
  double left = -1, right = 1;  ///< domain at t = 0
  double corner = 0;            ///< x of a step of stress: a face is laid there
  End left_end = End::continued, right_end = End::continued;
  bool periodic = false;             ///< a ring of the domain's length, stressed at both ends, which then do not count
  int cells = 400;                   ///< over the parts of the domain that are not empty, >= 4
  double tolerance = 1e-6;           ///< relative, of the implicit steps
  double explicit_tolerance = 1e-4;  ///< of the explicit steps, which the size of the cells mostly sets
  double longest_step = HUGE_VAL;    ///< a forcing may change while waves hardly move
  double cfl = 1.0;                  ///< of the explicit steps; smooth problems bear 1.4, steps of stress do not
};

/// The state of a run. Plain numbers: saved and restored, a run continues to the same bits. A gap between two stressed
/// blocks of cells is a cell without dislocations; when its edges meet, it goes.
struct Cells {
  double time = 0;
  long steps = 0;
  double step = 0;               ///< longest that the error of the last step allows, 0 before the first
  std::vector<double> unknowns;  ///< what time steps advance, with the names below
  std::vector<double> s;         ///< tanh(psi) at the cell centres, where the next solve starts
  std::vector<double> charge;    ///< dislocations in each cell, constant; 0 in a gap
  double entered_left = 0;       ///< dislocations that have come in (less those that have left) through the left end
  double entered_right = 0;      ///< and through the right one
  double crossing_time = std::numeric_limits<double>::quiet_NaN();      ///< of the first crossing; NaN: none so far
  double crossing_position = std::numeric_limits<double>::quiet_NaN();  ///< and its x
  std::vector<double> face_momentum;  ///< where friction rules: momenta live at the faces, cells have means; else empty

  std::vector<double> memory;  ///< the friction law's variables at places that do not move with the cells; empty: none

  std::size_t size() const { return charge.size(); }
  Values values() { return {unknowns.data(), size()}; }
  ConstValues values() const { return {unknowns.data(), size()}; }
  double& width(std::size_t cell) { return values().width(cell); }
  double width(std::size_t cell) const { return values().width(cell); }
  double& momentum(std::size_t cell) { return values().momentum(cell); }
  double momentum(std::size_t cell) const { return values().momentum(cell); }
  double& left_edge() { return values().left_edge(); }  ///< x
  double left_edge() const { return values().left_edge(); }
};

class Solver {
 public:
  /// Lays the cells over the stretches where there is stress. \throws InputError for an empty interface or bad numbers.
  explicit Solver(Problem problem);

  /// Continues from saved cells of the same problem. \throws InputError if they do not fit it.
  Solver(Problem problem, Cells cells);

  /// Goes back (or on) to saved cells of the same problem. \throws InputError if they do not fit it.
  void restore(Cells cells);

  /// Advances to `time`. `interrupted` is asked after each step; true stops early. Returns whether `time` was reached.
  /// \throws NumericsError with the time and place where no state exists.
  bool advance_to(double time, const std::function<bool()>& interrupted = {});

  /// About how many steps the next `duration` takes: those that waves allow, or fewer where viscous friction rules.
  double expected_steps(double duration) const;
  /// The reason for short steps, with the position, as a sentence without a full stop for a message.
  std::string reason_of_short_steps() const;

  const Problem& problem() const { return problem_; }
  const Cells& cells() const { return cells_; }
  /// Cells, gaps included.
  std::size_t size() const { return cells_.charge.size(); }
  const std::vector<double>& charge() const { return cells_.charge; }

  /// What the interface looks like now, for interpolation and sums.
  struct View {
    std::vector<double> faces;         ///< x
    std::vector<double> charge_faces;  ///< dislocations left of each face
    std::vector<State> face_states;
    std::vector<double> face_density;  ///< dislocations per unit of x, k / 2 pi, at the faces
    std::vector<double> centres;       ///< x
    std::vector<State> states;  ///< at the centres, in local units where there is a contact profile; empty in a gap
    std::function<double(double)> contact;
    std::vector<double> shocked;                 ///< 1 in the cells near a shock, where values ring; 0 elsewhere
    bool left_free = false, right_free = false;  ///< there is no stress beyond the first or last face
    double period = 0;                           ///< of a ring: x and x + period are one place; 0: none
  };
  /// Without `densities`, which take as long as the rest, face_density is empty.
  View view(bool densities = true) const;
  /// State at the centre of one cell, as in the view, without making it.
  State state_in(std::size_t cell) const;
  /// Slip at x since t = 0: 2 pi times the dislocations that have passed it, the integral of the initial stress from
  /// where the dislocation now at x began. No difference of sums, so that a small slip has small errors.
  double slip_at(const View& view, double x) const;

  double dissipated() const { return cells_.values().dissipated(); }
  double supplied() const { return cells_.values().supplied(); }
  /// Energy that came in through the ends of the domain, less what went out: with the dislocations, and by the push of
  /// the train beyond.
  double through_ends() const { return cells_.values().through_ends(); }

 private:
  void lay_equations();
  Staggered& staggered() const;
  bool advance_until_gap_closes(double time, const std::function<bool()>& interrupted);
  struct Work;
  /// One step of at most `remaining`, from the rates in `work`; returns its length. `crossing` is the time in which a
  /// wave crosses a cell.
  double step_explicitly(Work& work, double remaining, double crossing);
  double step_implicitly(Work& work, double remaining, double crossing);
  /// Takes friction face by face in the place of an implicit step; `z` are the unknowns at the faces.
  double step_by_faces(const std::vector<double>& z, const std::vector<double>& scale, double longest);
  /// For friction that remembers or is steep at rest (memory_step.cpp); `rate` are the rates at the present time.
  double step_by_parts(MemoryStep& work, const std::vector<double>& rate, double remaining, double crossing);
  Places places() const;
  std::vector<double> faces_of_cells(const Staggered& staggered) const;
  void cells_of_faces(const Staggered& staggered, const std::vector<double>& unknowns);
  double unseen_push(double dt) const;
  double mean_speed() const;
  void look_for_crossing();
  double energy_in(std::size_t cell) const;
  void find_scale(double crossing, std::vector<double>& scale) const;
  bool steep() const;
  bool steep_from_rest() const;
  bool steps_by_parts() const;
  double friction_rate_by_parts() const;
  double gaps_close_in(const std::vector<double>& rates) const;
  bool gap_has_closed(std::size_t i) const;
  void close_gap(std::size_t i);
  void close_gaps();
  void adjust_ends();
  void fill_end(bool left);
  void drop_beyond(bool left);
  void stop_at_walls();
  /// x of the face to the left of a cell; of the last face for size().
  double left_face(std::size_t cell) const;
  /// Where at t = 0 the dislocation with `charge` to its left was, one of a face; and the slip of a place that it has
  /// come to.
  double first_place(double charge) const;
  double way_at(const View& view, std::size_t cell, double x) const;
  double start_of(const View& view, double x) const;
  double charge_between(double from, double to) const;
  /// What Semidiscrete or Staggered are made from.
  template <class Setup>
  Setup setup() const;
  void join(std::size_t cell, std::size_t into);
  void drop_cell(std::size_t i);

  Problem problem_;
  Cells cells_;
  bool contact_varies_ = false;
  bool left_free_, right_free_;
  View first_;
  std::shared_ptr<Semidiscrete> equations_;
  mutable std::shared_ptr<Staggered> staggered_;  ///< made when friction first rules
};

/// State at x between the dislocations of a view; empty outside.
State state_at(const Solver::View& view, double x);
/// Averages of a state at x, in the units of the interface whatever the contact there.
train::Averages averages_of(const Solver::View& view, const State& state, double x);
/// Number of dislocations left of x.
double charge_left_of(const Solver::View& view, double x);

}  // namespace slipfront::pulse
