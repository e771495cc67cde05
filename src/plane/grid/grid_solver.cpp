#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "foundation/archive.hpp"
#include "foundation/text/digits.hpp"
#include "plane/budget.hpp"
#include "plane/grid/observe.hpp"
#include "plane/grid/steps.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/grid.hpp"

namespace slipfront::plane {
namespace {

constexpr double tail = 1e-4;  ///< fraction of the largest initial slip that counts as none

void check(const Problem& p) {
  if (p.friction.changes_contacts())
    throw InputError({.key = "friction",
                      .value = std::string(p.friction.name()),
                      .problem = "on a plane, friction cannot change contacts or pores",
                      .allowed = "a law without these effects"});
}

Cells cells_of(const Problem& p, int cells) {
  const double width = p.right - p.left, height = p.top - p.bottom;
  constexpr int fewest = 8;
  const double rows = std::max(fewest, p.rows_of_cells(cells));
  Cells all;
  all.nx = static_cast<std::size_t>(cells);
  all.ny = static_cast<std::size_t>(rows);
  all.left = p.left;
  all.bottom = p.bottom;
  all.hx = width / cells;
  all.hy = height / rows;
  return all;
}

/// A run ends where the front reaches an edge, so that edges matter only where there is slip at the start.
void check_edges(const Problem& p, const std::vector<double>& slip, const Cells& cells) {
  if (p.edges == Edges::free) return;
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if (cells.at_edge(i, j) && slip[cell] > 0)
      throw InputError({.key = "edges",
                        .problem = "the averaged solver has no such edges where there is slip at t = 0",
                        .allowed = "free edges"});
  });
}

GridMotion at_rest(const Problem& problem, const Cells& cells) {
  GridMotion motion;
  motion.now.slip.assign(cells.size(), 0);
  motion.now.action.assign(cells.size(), 0);
  double largest = 0;
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    const double slip = problem.slip(cells.x(i), cells.y(j));
    if (!(slip >= 0 && std::isfinite(slip)))
      throw InputError({.key = "slip",
                        .problem = "the slip is " + digits(slip) + " at x = " + digits(cells.x(i), 4) +
                                   ", y = " + digits(cells.y(j), 4),
                        .allowed = "a finite number >= 0"});
    motion.now.slip[cell] = slip;
    largest = std::fmax(largest, slip);
  });
  check_edges(problem, motion.now.slip, cells);
  if (!(largest > 0)) throw InputError({.key = "slip", .problem = "there is no slip", .allowed = "a slip > 0"});
  for (double& slip : motion.now.slip)
    if (slip <= tail * largest) slip = 0;
  return motion;
}

}  // namespace

struct GridSolver::Parts {
  Problem problem;
  Cells cells;
  GridMotion motion;
  std::optional<GridSteps> steps;
  std::vector<double> start;  ///< slip at t = 0
  double largest = 0;         ///< largest of them
  double elastic_at_start = 0;

  Parts(const Problem& p, int count)
      : problem(p), cells(cells_of(problem, count)), motion(at_rest(problem, cells)), start(motion.now.slip) {
    largest = *std::max_element(start.begin(), start.end());
    steps.emplace(problem, cells, motion);
    steps->look();
    elastic_at_start = energy().elastic;
  }

  GridEnergy energy() const { return plane::energy(motion, steps->equations(), cells); }

  double slip(std::size_t cell) const { return std::fmax(motion.now.slip[cell], 0.0) - start[cell]; }
  double velocity(std::size_t cell) const {
    return motion.now.slip[cell] > 0 && !steps->walls().held(cell) ? steps->rates().slip[cell] : 0;
  }
  template <class Of>
  std::vector<double> of_cells(const Of& of) const {
    std::vector<double> values(cells.size(), 0);
    cells.each([&](std::size_t, std::size_t, std::size_t cell) { values[cell] = of(cell); });
    return values;
  }
  template <class Of>
  double integral(const Of& of) const {
    double sum = 0;
    cells.each([&](std::size_t, std::size_t, std::size_t cell) { sum += of(cell); });
    return sum * cells.hx * cells.hy;
  }

  /// The front must stay inside the domain, because the equations end at its edges.
  void check_state() const {
    cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
      const auto where = [&] {
        return "t = " + digits(motion.time) + ", x = " + digits(cells.x(i), 4) + ", y = " + digits(cells.y(j), 4) +
               ": ";
      };
      if (!std::isfinite(motion.now.slip[cell]) || !std::isfinite(motion.now.action[cell]))
        throw NumericsError(where() + "the slip is not finite");
      if (cells.at_edge(i, j) && start[cell] == 0 && motion.now.slip[cell] > tail * largest)
        throw NumericsError(where() + "the front has reached the edge of the domain, where the averaged solver ends");
    });
  }
};

GridSolver::GridSolver(const Problem& problem, int cells) {
  check(problem);
  parts_ = std::make_unique<Parts>(problem, cells);
}
GridSolver::~GridSolver() = default;

const Problem& GridSolver::problem() const { return parts_->problem; }
double GridSolver::time() const { return parts_->motion.time; }
long GridSolver::steps() const { return parts_->motion.steps; }

bool GridSolver::advance_to(double time, const std::function<bool()>& interrupted) {
  Parts& p = *parts_;
  const auto advance = [&](double end) {
    while (p.motion.time < end) {
      p.steps->take(end);
      p.check_state();
      if (interrupted && interrupted()) break;
    }
    return p.motion.time >= end;
  };
  // A step ends where nucleation begins.
  const double begin = p.problem.nucleation ? p.problem.nucleation->time : 0;
  if (begin > p.motion.time && begin < time && !advance(begin)) return false;
  if (!advance(time)) return false;
  constexpr double noise = 0.02;  // fraction of the energy at the start, of the error at the front
  check_budget(energies(), noise * p.elastic_at_start, time, "more cells are needed");
  return true;
}

StepsAhead GridSolver::steps_ahead(double duration) const { return parts_->steps->ahead(duration); }
bool GridSolver::lines_have_met() const { return parts_->motion.met_at >= 0; }

std::vector<double> GridSolver::slip(const std::vector<Point>& points) const {
  const std::vector<double> slip = parts_->of_cells([this](std::size_t cell) { return parts_->slip(cell); });
  std::vector<double> at_points;
  at_points.reserve(points.size());
  for (const Point& at : points) at_points.push_back(value_at(slip, parts_->cells, at));
  return at_points;
}

std::vector<double> GridSolver::velocity(const std::vector<Point>& points) const {
  const std::vector<double> w = parts_->of_cells([this](std::size_t cell) { return parts_->velocity(cell); });
  std::vector<double> at_points;
  at_points.reserve(points.size());
  for (const Point& at : points) at_points.push_back(value_at(w, parts_->cells, at));
  return at_points;
}

Field GridSolver::field(int nx, int ny) const {
  const Problem& p = parts_->problem;
  std::vector<Point> centres;
  centres.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      centres.push_back({p.left + (p.right - p.left) * (i + 0.5) / nx, p.bottom + (p.top - p.bottom) * (j + 0.5) / ny});
  return {.time = time(), .nx = nx, .ny = ny, .slip = slip(centres), .velocity = velocity(centres)};
}

std::vector<Line> GridSolver::lines() const { return front_lines(parts_->motion.now.slip, parts_->cells); }

double GridSolver::potency() const {
  return parts_->integral([this](std::size_t cell) { return parts_->slip(cell); });
}
double GridSolver::potency_rate() const {
  return parts_->integral([this](std::size_t cell) { return parts_->velocity(cell); });
}
double GridSolver::front(double y_scale) const {
  return farthest_front(parts_->motion.now.slip, parts_->cells, parts_->steps->walls(), y_scale);
}

Energies GridSolver::energies() const {
  const GridEnergy now = parts_->energy();
  return {.kinetic = now.kinetic,
          .elastic = now.elastic - parts_->elastic_at_start,
          .dissipated = parts_->motion.dissipated,
          .supplied = parts_->motion.supplied,
          .vanished = 0,
          .radiated = 0};
}

double GridSolver::least_energy() const { return 1e-4 * parts_->elastic_at_start; }

std::vector<std::string> GridSolver::warnings() const {
  if (parts_->motion.met_at < 0) return {};
  return {"dislocation lines of different directions have met since t = " + digits(parts_->motion.met_at, 4) +
          ". In the full equation they pass through each other or vanish in waves. In these averages they vanish, "
          "and their energy is lost"};
}

void GridSolver::archive(Archive& a) {
  Parts& p = *parts_;
  GridMotion& m = p.motion;
  GridEquations::Guesses guesses = p.steps->guesses();
  a(m.time, m.power, m.supply, m.dissipated, m.supplied, m.met_at, m.steps);
  a.fixed(m.now.slip, m.now.action, m.strength, m.states, guesses[0], guesses[1], guesses[2]);
  if (!a.reads()) return;
  const GridMotion saved = m;
  p.steps->set_guesses(guesses);
  p.steps->look();  // for observers
  m = saved;
}

}  // namespace slipfront::plane
