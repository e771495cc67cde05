#pragma once
/// \file
/// The problem that a run on a fault plane solves, in the units of the scenario:
///     u_tt - u_xx - u_yy + a^2 sin u = F - f(u_t).
/// The slip is along x. Lengths along y are divided by the ratio c_y / c of the wave speeds, so that waves have the
/// speed 1 in all directions.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront {
class Archive;
}

namespace slipfront::plane {

struct Point {
  double x = 0, y = 0;
};

/// The start of a rupture. From `time` on, neither the static load of `hold` nor friction with strength at rest acts
/// within `radius` of a point.
struct Nucleation {
  double x = 0, y = 0, radius = 0, time = 0;
};

/// Conditions at the edges of the domain: no stress (free), no slip (fixed), or waves leave (absorbing).
enum class Edges { free, fixed, absorbing };

struct Problem {
  double left = -1, right = 1, bottom = -1, top = 1;
  /// Mean slip U >= 0 at t = 0, in b / 2 pi. Everything is at rest.
  std::function<double(double x, double y)> slip;
  /// The interface is held where this is not 0. null: nowhere.
  std::function<double(double x, double y)> fixed;
  friction::Friction friction;
  std::function<double(double x, double y, double t)> forcing;  ///< F; null: none
  bool steady_forcing = false;                                  ///< F does not depend on t
  std::function<double(double x, double y)> contact;            ///< relative contact ratio a > 0; null: 1
  bool hold = false;  ///< whether a static load balances the initial state, which is at rest then
  std::optional<Nucleation> nucleation;
  Edges edges = Edges::free;

  /// Number of rows of about square cells, for this number of cells along x.
  int rows_of_cells(int along_x) const;
  /// Whether nucleation has begun at a time.
  bool nucleation_has_begun(double time) const { return nucleation && time >= nucleation->time; }
};

/// The energies that a solver conserves, integrated over the plane since t = 0, in units of the scenario.
struct Energies {
  double kinetic = 0;
  double elastic = 0;     ///< energy of the lines at rest, less that of the same lines at t = 0
  double dissipated = 0;  ///< by friction
  double supplied = 0;    ///< by the force F
  /// Energy of lines that shrank to a point, if the solver does not follow the waves that they leave.
  double vanished = 0;
  double radiated = 0;  ///< through absorbing edges
};

/// A dislocation line, or a part of one that ends at an edge: u = (2 number - 1) pi. The last point of a closed line is
/// its first.
struct Line {
  int number = 0;
  std::vector<Point> points;
};

/// Means over the cells of a grid of nx times ny cells that covers the domain: row by row, from the bottom.
struct Field {
  double time = 0;
  int nx = 0, ny = 0;
  std::vector<double> slip;      ///< since t = 0, in b / 2 pi
  std::vector<double> velocity;  ///< slip velocity, in c A / 2 pi
  std::vector<Line> lines = {};  ///< if the schedule of a run asks for them, in the coordinates of the results
};

/// Numbers of time steps: as many as waves need, and with what friction requires. 0: the length of steps is constant.
struct StepsAhead {
  double by_waves = 0, in_all = 0;
  std::string reason;  ///< why steps are not longer, and where, as a sentence without a full stop
};

/// A solver of the problem, in the units of the scenario.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual const Problem& problem() const = 0;
  virtual double time() const = 0;
  virtual long steps() const = 0;
  /// Advances to `time`, or until `interrupted` returns true. Returns whether it has reached the time.
  /// \throws NumericsError, with time and position, if the motion leaves the range of the theory.
  virtual bool advance_to(double time, const std::function<bool()>& interrupted) = 0;
  /// Whether the lengths of steps depend on the `time` of advance_to, because a step ends there.
  virtual bool steps_end_on_time() const { return true; }
  /// The steps in a time, if they are as long as the next one.
  virtual StepsAhead steps_ahead(double) const { return {}; }
  /// Whether lines have run into each other and lost energy that the solver does not follow.
  virtual bool lines_have_met() const { return false; }

  /// Slip since t = 0 and slip velocity at points of the domain.
  virtual std::vector<double> slip(const std::vector<Point>& points) const = 0;
  virtual std::vector<double> velocity(const std::vector<Point>& points) const = 0;
  virtual Field field(int nx, int ny) const = 0;
  /// The dislocation lines, with points about one width of a dislocation apart. The averages have only the outermost
  /// line, which is the rupture front.
  virtual std::vector<Line> lines() const = 0;
  virtual double potency() const = 0;       ///< integral of the slip since t = 0
  virtual double potency_rate() const = 0;  ///< integral of the slip velocity
  /// Largest distance from the origin of the outermost dislocation line, where y is multiplied by `y_scale`.
  virtual double front(double y_scale) const = 0;
  virtual Energies energies() const = 0;
  /// Energies below this are errors of the cells, so that their balance is not checked.
  virtual double least_energy() const { return 0; }

  /// Sentences that describe doubtful results so far.
  virtual std::vector<std::string> warnings() const { return {}; }

  /// Writes or reads the state from which the run continues to the same bits. \throws InputError if what it reads does
  /// not fit the problem.
  virtual void archive(Archive& a) = 0;
};

/// \throws InputError for friction that changes contacts or pores.
void require_steady_contacts(const Problem& problem);

}  // namespace slipfront::plane
