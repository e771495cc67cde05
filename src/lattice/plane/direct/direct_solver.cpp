#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "lattice/plane/budget.hpp"
#include "lattice/plane/direct/motion.hpp"
#include "lattice/plane/direct/sites.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "system/archive.hpp"
#include "system/ranks.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

/// The sites of one direction in a stretch of it, [first, last).
struct Range {
  std::size_t first, last;
};
Range sites_between(double from, double to, double edge, double spacing, std::size_t count) {
  const double most = static_cast<double>(count);
  const double first = std::clamp(std::ceil((from - edge) / spacing - 0.5), 0.0, most - 1);
  const double last = std::clamp(std::ceil((to - edge) / spacing - 0.5), first + 1, most);  // at least one
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
}

/// Returns what `make` returns, each rank its own. If it throws on any rank, all ranks throw.
template <class Make>
auto made_together(const Ranks& ranks, const Make& make) {
  std::optional<decltype(make())> made;
  ranks.together([&] { made.emplace(make()); });
  return std::move(*made);
}

/// Values of the sites of a band, without ghosts, from an array with them.
std::vector<double> without_ghosts(const std::vector<double>& array, const Sites& sites) {
  std::vector<double> values;
  if (array.empty()) return values;
  values.reserve(sites.nx * sites.ny);
  for (std::size_t j = 0; j < sites.ny; ++j) {
    const double* const row = &array[sites.at(0, j)];
    values.insert(values.end(), row, row + sites.nx);
  }
  return values;
}

/// An array with room for ghosts, from values of the sites of a band.
std::vector<double> with_ghosts(const std::vector<double>& values, const Sites& sites) {
  std::vector<double> array(values.empty() ? 0 : sites.size(), 0.0);
  for (std::size_t j = 0; j < sites.ny && !values.empty(); ++j)
    std::copy_n(&values[j * sites.nx], sites.nx, &array[sites.at(0, j)]);
  return array;
}

class DirectSolver : public Solver {
 public:
  DirectSolver(const Problem& p, const DirectOptions& options)
      : problem_(p),
        ranks_(options.ranks ? *options.ranks : Ranks::single()),
        sites_(made_together(ranks_,
                             [&] {
                               return make_sites(problem_, options.scale, options.spacing,
                                                 {.number = ranks_.rank(), .bands = ranks_.size()});
                             })),
        stepper_(problem_, sites_, options.threads, ranks_) {
    Start lines = made_together(ranks_, [&] { return lines_at_rest(problem_, sites_); });
    const double density = ranks_.largest(lines.largest_density);
    ranks_.together([&] { check_density(density, options); });
    half_box_ = std::fmax(2 * pi / std::fmax(density, 1), 1) / sites_.scale;
    start_ = lines.u;
    motion_ = stepper_.start(std::move(lines.u));
    stepper_.look_at(motion_, 0, look_);
    elastic_at_start_ = look_.elastic;
  }

  const Problem& problem() const override { return problem_; }
  double time() const override { return time_; }
  long steps() const override { return motion_.steps; }

  bool advance_to(double time, const std::function<bool()>& interrupted) override {
    const bool reached = stepper_.advance(motion_, time, interrupted);
    time_ = reached ? time : stepper_.time_of(motion_);
    if (!reached) return false;
    stepper_.look_at(motion_, time, look_);
    const double noise =
        std::fmax(1e-3 * elastic_at_start_, no_energy * static_cast<double>(count()) * sites_.hx * sites_.hy);
    check_budget(energies(), noise / (sites_.scale * sites_.scale), time,
                 "a smaller spacing of sites or a larger scale is needed");
    return true;
  }

  std::vector<double> slip(const std::vector<Point>& points) const override {
    return around([this](std::size_t at) { return slip_of(at); }, points);
  }
  std::vector<double> velocity(const std::vector<Point>& points) const override {
    return around([this](std::size_t at) { return velocity_of(at); }, points);
  }

  Field field(int nx, int ny) const override {
    return {.time = time(),
            .nx = nx,
            .ny = ny,
            .slip = cells([this](std::size_t at) { return slip_of(at); }, nx, ny),
            .velocity = cells([this](std::size_t at) { return velocity_of(at); }, nx, ny)};
  }

  std::vector<Line> lines() const override {
    if (ranks_.size() == 1) return lines_of(look_.u, sites_);
    const std::vector<double> u = ranks_.joined_at_first(without_ghosts(look_.u, sites_));
    if (u.empty()) return {};
    Sites whole = sites_;
    whole.first_row = 0;
    whole.ny = whole.all_rows;
    return lines_of(with_ghosts(u, whole), whole);
  }

  double potency() const override {
    return integral([this](std::size_t at) { return slip_of(at); });
  }
  double potency_rate() const override {
    return integral([this](std::size_t at) { return velocity_of(at); });
  }

  /// The outermost line is the contour u = pi that is farthest from the origin.
  double front(double y_scale) const override {
    double farthest = 0;  // its square
    for (std::size_t j = 0; j < sites_.ny; ++j)
      for (std::size_t i = 0; i < sites_.nx; ++i)
        if (look_.u[sites_.at(i, j)] >= pi)
          farthest = std::fmax(farthest, sites_.x(i) * sites_.x(i) + y_scale * sites_.y(j) * y_scale * sites_.y(j));
    return std::sqrt(ranks_.largest(farthest));
  }

  Energies energies() const override {
    const double per = 1 / (sites_.scale * sites_.scale);
    return {.kinetic = per * look_.kinetic,
            .elastic = per * (look_.elastic - elastic_at_start_),
            .dissipated = per * look_.dissipated,
            .supplied = per * look_.supplied,
            .vanished = 0,
            .radiated = per * look_.radiated};
  }

  void archive(Archive& a) override {
    Motion& m = motion_;
    a(time_, m.steps);
    const auto rows = [&](std::vector<double>& values) {
      a.parts(values, ranks_, sites_.first_row, sites_.ny, sites_.all_rows);
    };
    for (auto* values : {&m.u, &m.old, &m.v_old}) {
      std::vector<double> of_sites = without_ghosts(*values, sites_);
      rows(of_sites);
      if (a.reads()) *values = with_ghosts(of_sites, sites_);
    }
    std::vector<double> states = stepper_.friction().states();
    rows(states);
    for (const auto part : {&RowWork::dissipated, &RowWork::supplied, &RowWork::radiated}) {
      std::vector<double> of_row;
      of_row.reserve(m.work.size());
      for (const RowWork& work : m.work) of_row.push_back(work.*part);
      rows(of_row);
      for (std::size_t j = 0; j < m.work.size(); ++j) m.work[j].*part = of_row[j];
    }
    if (!a.reads()) return;
    stepper_.friction().set_states(states);
    for (auto* values : {&m.u, &m.old}) stepper_.fill_ghosts(*values);
    stepper_.look_at(m, time_, look_);
  }

 private:
  Problem problem_;
  const Ranks& ranks_;
  Sites sites_;
  Motion motion_;
  Sums look_;
  std::vector<double> start_;  ///< u at t = 0
  double half_box_ = 0;        ///< half the width of the squares over which slip at a point is averaged
  Stepper stepper_;
  double elastic_at_start_ = 0;
  double time_ = 0;

  /// Some sites_ are needed from one line to the next.
  static void check_density(double density, const DirectOptions& options) {
    constexpr double fewest = 3.5;
    if (!(2 * pi / density >= fewest * options.spacing))
      throw InputError({.key = "spacing",
                        .value = digits(options.spacing),
                        .problem = "lines are as close as " + digits(2 * pi / density, 3) + " widths",
                        .allowed = "at most " + digits(2 * pi / fewest / density, 3)});
  }

  /// Slip and slip velocity of a site.
  double slip_of(std::size_t at) const { return (look_.u[at] - start_[at]) / sites_.scale; }
  double velocity_of(std::size_t at) const { return look_.velocity[at]; }

  Range columns(double from, double to) const {
    return sites_between(from, to, sites_.left, sites_.hx / sites_.scale, sites_.nx);
  }
  Range rows(double from, double to) const {
    return sites_between(from, to, sites_.bottom, sites_.hy / sites_.scale, sites_.all_rows);
  }
  std::size_t count() const { return sites_.nx * sites_.all_rows; }

  /// (all) Sums over parts of the rows. Those of row j of the domain begin at the index j * columns.size().
  template <class Of>
  std::vector<double> sums(const Of& of, const std::vector<Range>& columns) const {
    std::vector<double> mine;
    mine.reserve(sites_.ny * columns.size());
    for (std::size_t j = 0; j < sites_.ny; ++j)
      for (const Range& range : columns) {
        double sum = 0;
        for (std::size_t i = range.first; i < range.last; ++i) sum += of(sites_.at(i, j));
        mine.push_back(sum);
      }
    return ranks_.joined(mine);
  }
  /// The mean over a part of the plane, from `sums` of which it is the part `k` of `parts`.
  static double mean(const std::vector<double>& sums, std::size_t k, std::size_t parts, const Range& columns,
                     const Range& rows) {
    double sum = 0;
    for (std::size_t j = rows.first; j < rows.last; ++j) sum += sums[j * parts + k];
    return sum / static_cast<double>((rows.last - rows.first) * (columns.last - columns.first));
  }
  /// (all) Means around points.
  template <class Of>
  std::vector<double> around(const Of& of, const std::vector<Point>& points) const {
    std::vector<Range> of_points;
    of_points.reserve(points.size());
    for (const Point& at : points) of_points.push_back(columns(at.x - half_box_, at.x + half_box_));
    const std::vector<double> all = sums(of, of_points);
    std::vector<double> means;
    means.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      means.push_back(
          mean(all, k, points.size(), of_points[k], rows(points[k].y - half_box_, points[k].y + half_box_)));
    return means;
  }
  /// (all) Means over the cells of a grid.
  template <class Of>
  std::vector<double> cells(const Of& of, int nx, int ny) const {
    const auto edge = [](double from, double to, int i, int n) { return from + (to - from) * i / n; };
    const auto count = static_cast<std::size_t>(nx);
    std::vector<Range> of_cells;
    of_cells.reserve(count);
    for (int i = 0; i < nx; ++i)
      of_cells.push_back(
          columns(edge(problem_.left, problem_.right, i, nx), edge(problem_.left, problem_.right, i + 1, nx)));
    const std::vector<double> all = sums(of, of_cells);
    std::vector<double> means;
    means.reserve(count * static_cast<std::size_t>(ny));
    for (int j = 0; j < ny; ++j) {
      const Range row =
          rows(edge(problem_.bottom, problem_.top, j, ny), edge(problem_.bottom, problem_.top, j + 1, ny));
      for (std::size_t i = 0; i < count; ++i) means.push_back(mean(all, i, count, of_cells[i], row));
    }
    return means;
  }
  /// (all) Integral over the plane, in units of the scenario.
  template <class Of>
  double integral(const Of& of) const {
    double sum = 0;
    for (const double row : sums(of, {{0, sites_.nx}})) sum += row;
    return sum * sites_.hx * sites_.hy / (sites_.scale * sites_.scale);
  }
};

}  // namespace

double memory_of_direct(const Problem& problem, const DirectOptions& options) {
  constexpr double arrays =
      14;  // u at three times, the start, two of a look, what its velocity and energy need, accelerations
  const Counts n = count_sites(problem, options.scale, options.spacing);
  const double given = (problem.contact ? 1 : 0) + (problem.friction.is_viscous() ? 1 : 0) + (problem.fixed ? 1 : 0) +
                       (problem.forcing ? 1 : 0) + (problem.hold ? 2 : 0) +
                       static_cast<double>(problem.friction.state_size());
  return (arrays + given) * sizeof(double) * n.nx * n.ny;
}

double largest_unbalanced_force(const Problem& problem, const DirectOptions& options, int nx, int ny) {
  Problem free = problem;
  free.hold = false;
  free.forcing = nullptr;
  const Sites sites = make_sites(free, options.scale, options.spacing);
  const Stepper stepper(free, sites, options.threads);
  const std::vector<double> v = stepper.accelerations_at_rest(lines_at_rest(free, sites).u);
  const auto cell_of = [](std::size_t site, std::size_t sites_in_all, int cells) {
    return site * static_cast<std::size_t>(cells) / sites_in_all;
  };
  std::vector<double> sum(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)), count(sum.size());
  for (std::size_t j = 0; j < sites.ny; ++j)
    for (std::size_t i = 0; i < sites.nx; ++i) {
      const std::size_t cell = cell_of(j, sites.ny, ny) * static_cast<std::size_t>(nx) + cell_of(i, sites.nx, nx);
      sum[cell] += v[sites.at(i, j)];
      ++count[cell];
    }
  double largest = 0;
  for (std::size_t cell = 0; cell < sum.size(); ++cell)
    if (count[cell] > 0) largest = std::fmax(largest, std::fabs(sum[cell] / count[cell]));
  return largest * options.scale;
}

std::unique_ptr<Solver> direct_solver(const Problem& problem, const DirectOptions& options) {
  require_steady_contacts(problem);
  return std::make_unique<DirectSolver>(problem, options);
}

}  // namespace slipfront::plane
