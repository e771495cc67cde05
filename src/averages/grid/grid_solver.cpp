#include "averages/grid/grid_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "averages/grid/steps.hpp"
#include "lattice/plane/budget.hpp"
#include "lattice/plane/direct/sites.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"
#include "theory/modulation/equations.hpp"

namespace slipfront::plane {

using std::numbers::pi;

/// The density of energy is g |grad U|^2 - a^2 p.
GridEnergy energy(const GridMotion& motion, const GridEquations& equations, const Cells& cells) {
  Trains moving = equations.trains();
  std::vector<double> areas(moving.at.size());
  equations.each_row(moving, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const GridEquations::Inside inside = equations.inside(moving.at[i], motion.now.slip);
      areas[i] = motion.now.slip[moving.at[i]] > 0 ? inside.area : 0;
      moving.gradient[i] = inside.gradient;
      set_spacing(moving, i);
    }
    solve(moving, first, last);
  });
  Trains rest = moving;
  std::fill(rest.momentum.begin(), rest.momentum.end(), 0.0);
  equations.each_row(rest, [&](std::size_t first, std::size_t last) { solve(rest, first, last); });
  GridEnergy sum{0, 0};
  for (std::size_t i = 0; i < rest.at.size(); ++i) {
    const double elastic = energy_density(rest, i);
    sum.elastic += areas[i] * elastic;
    sum.kinetic += areas[i] * (energy_density(moving, i) - elastic);
  }
  const double area = cells.hx * cells.hy;
  return {sum.kinetic * area, sum.elastic * area};
}

double value_at(const std::vector<double>& values, const Cells& cells, const Point& at) {
  const auto place = [](double from_edge, double spacing, std::size_t count) {
    return std::clamp(from_edge / spacing - 0.5, 0.0, static_cast<double>(count - 1));
  };
  const double x = place(at.x - cells.left, cells.hx, cells.nx), y = place(at.y - cells.bottom, cells.hy, cells.ny);
  const std::size_t i = std::min(static_cast<std::size_t>(x), cells.nx - 2),
                    j = std::min(static_cast<std::size_t>(y), cells.ny - 2);
  const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
  const auto row = [&](std::size_t n) { return values[cells.at(i, n)] * (1 - fx) + values[cells.at(i + 1, n)] * fx; };
  return row(j) * (1 - fy) + row(j + 1) * fy;
}

double farthest_front(const std::vector<double>& slip, const Cells& cells, const Walls& walls, double y_scale) {
  double farthest = 0;
  const auto look = [&](std::size_t from, std::size_t to) {
    const bool inside = slip[from] > 0;
    if (inside == (slip[to] > 0) || walls.held(from) || walls.held(to)) return;
    const Point a = cells.centre(from), b = cells.centre(to);
    const double part = slip[from] / (slip[from] - slip[to]);
    farthest = std::fmax(farthest, std::hypot(a.x + part * (b.x - a.x), y_scale * (a.y + part * (b.y - a.y))));
  };
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if (i > 0) look(cell, cell - 1);
    if (j > 0) look(cell, cell - cells.stride());
  });
  return farthest;
}

std::vector<Line> front_lines(const std::vector<double>& slip, const Cells& cells) {
  Sites sites;
  sites.nx = cells.nx;
  sites.ny = cells.ny;
  sites.left = cells.left;
  sites.bottom = cells.bottom;
  sites.hx = cells.hx;
  sites.hy = cells.hy;
  std::vector<double> u(sites.size(), 0);
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    const double known = slip[cell] == 0 ? -1 : slip[cell];  // 0 stands for cells far from any line
    u[sites.at(i, j)] = pi + std::clamp(known, -1.0, 1.0);   // so that only the line u = pi is near
  });
  return lines_of(u, sites, 1);
}

namespace {

constexpr double tail = 1e-4;  ///< fraction of the largest initial slip that counts as none

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

class GridSolver : public Solver {
 public:
  GridSolver(const Problem& p, int count, int threads)
      : problem_(p), cells_(cells_of(problem_, count)), motion_(at_rest(problem_, cells_)), start_(motion_.now.slip) {
    largest_ = *std::max_element(start_.begin(), start_.end());
    steps_.emplace(problem_, cells_, motion_, threads);
    steps_->look();
    elastic_at_start_ = energy().elastic;
  }

  const Problem& problem() const override { return problem_; }
  double time() const override { return motion_.time; }
  long steps() const override { return motion_.steps; }

  bool advance_to(double time, const std::function<bool()>& interrupted) override {
    const auto advance = [&](double end) {
      while (motion_.time < end) {
        steps_->take(end);
        check_state();
        if (interrupted && interrupted()) break;
      }
      return motion_.time >= end;
    };
    // A step ends where nucleation begins.
    const double begin = problem_.nucleation ? problem_.nucleation->time : 0;
    if (begin > motion_.time && begin < time && !advance(begin)) return false;
    if (!advance(time)) return false;
    constexpr double noise = 0.02;  // fraction of the energy at the start, of the error at the front
    check_budget(energies(), noise * elastic_at_start_, time, "more cells are needed");
    return true;
  }

  StepsAhead steps_ahead(double duration) const override { return steps_->ahead(duration); }
  bool lines_have_met() const override { return motion_.met_at >= 0; }

  std::vector<double> slip(const std::vector<Point>& points) const override {
    return at(points, [this](std::size_t cell) { return slip_in(cell); });
  }
  std::vector<double> velocity(const std::vector<Point>& points) const override {
    return at(points, [this](std::size_t cell) { return velocity_in(cell); });
  }

  Field field(int nx, int ny) const override {
    const Problem& p = problem_;
    std::vector<Point> centres;
    centres.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        centres.push_back(
            {p.left + (p.right - p.left) * (i + 0.5) / nx, p.bottom + (p.top - p.bottom) * (j + 0.5) / ny});
    return {.time = time(), .nx = nx, .ny = ny, .slip = slip(centres), .velocity = velocity(centres)};
  }

  std::vector<Line> lines() const override { return front_lines(motion_.now.slip, cells_); }

  double potency() const override {
    return integral([this](std::size_t cell) { return slip_in(cell); });
  }
  double potency_rate() const override {
    return integral([this](std::size_t cell) { return velocity_in(cell); });
  }
  double front(double y_scale) const override {
    return farthest_front(motion_.now.slip, cells_, steps_->walls(), y_scale);
  }

  Energies energies() const override {
    const GridEnergy now = energy();
    return {.kinetic = now.kinetic,
            .elastic = now.elastic - elastic_at_start_,
            .dissipated = motion_.dissipated,
            .supplied = motion_.supplied,
            .vanished = 0,
            .radiated = 0};
  }

  double least_energy() const override { return 1e-4 * elastic_at_start_; }

  std::vector<std::string> warnings() const override {
    if (motion_.met_at < 0) return {};
    return {"dislocation lines of different directions have met since t = " + digits(motion_.met_at, 4) +
            ". In the full equation they pass through each other or vanish in waves. In these averages they vanish, "
            "and their energy is lost"};
  }

  void archive(Archive& a) override {
    GridMotion& m = motion_;
    GridEquations::Guesses guesses = steps_->guesses();
    a(m.time, m.power, m.supply, m.dissipated, m.supplied, m.met_at, m.steps);
    a.fixed(m.now.slip, m.now.action, m.strength, m.states, guesses[0], guesses[1], guesses[2]);
    if (!a.reads()) return;
    const GridMotion saved = m;
    steps_->set_guesses(guesses);
    steps_->look();  // for observers
    m = saved;
  }

 private:
  Problem problem_;
  Cells cells_;
  GridMotion motion_;
  std::optional<GridSteps> steps_;
  std::vector<double> start_;  ///< slip at t = 0
  double largest_ = 0;         ///< largest_ of them
  double elastic_at_start_ = 0;

  GridEnergy energy() const { return plane::energy(motion_, steps_->equations(), cells_); }

  double slip_in(std::size_t cell) const { return std::fmax(motion_.now.slip[cell], 0.0) - start_[cell]; }
  double velocity_in(std::size_t cell) const {
    return motion_.now.slip[cell] > 0 && !steps_->walls().held(cell) ? steps_->rates().slip[cell] : 0;
  }
  template <class Of>
  std::vector<double> at(const std::vector<Point>& points, const Of& of) const {
    std::vector<double> values(cells_.size(), 0), at_points;
    cells_.each([&](std::size_t, std::size_t, std::size_t cell) { values[cell] = of(cell); });
    at_points.reserve(points.size());
    for (const Point& point : points) at_points.push_back(value_at(values, cells_, point));
    return at_points;
  }
  template <class Of>
  double integral(const Of& of) const {
    double sum = 0;
    cells_.each([&](std::size_t, std::size_t, std::size_t cell) { sum += of(cell); });
    return sum * cells_.hx * cells_.hy;
  }

  /// The front must stay inside the domain, because the equations end at its edges.
  void check_state() const {
    cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
      const auto where = [&] {
        return "t = " + digits(motion_.time) + ", x = " + digits(cells_.x(i), 4) + ", y = " + digits(cells_.y(j), 4) +
               ": ";
      };
      if (!std::isfinite(motion_.now.slip[cell]) || !std::isfinite(motion_.now.action[cell]))
        throw NumericsError(where() + "the slip is not finite");
      if (cells_.at_edge(i, j) && start_[cell] == 0 && motion_.now.slip[cell] > tail * largest_)
        throw NumericsError(where() + "the front has reached the edge of the domain, where the averaged solver ends");
    });
  }
};

}  // namespace

std::unique_ptr<Solver> grid_solver(const Problem& problem, int cells, int threads) {
  require_steady_contacts(problem);
  return std::make_unique<GridSolver>(problem, cells, threads);
}

}  // namespace slipfront::plane
