#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "foundation/bytes.hpp"
#include "foundation/text/digits.hpp"
#include "plane/budget.hpp"
#include "plane/direct/lines.hpp"
#include "plane/direct/motion.hpp"
#include "plane/direct/sites.hpp"
#include "slipfront/error.hpp"
#include "slipfront/plane/direct.hpp"

namespace slipfront::plane {
namespace {

using std::numbers::pi;

void check(const Problem& p) {
  if (!p.viscous && p.friction.changes_contacts())
    throw InputError({.key = "friction.law",
                      .value = std::string(p.friction.name()),
                      .problem = "on a plane, friction cannot change contacts or pores",
                      .allowed = "a law without these effects"});
}

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

}  // namespace

struct DirectSolver::Parts {
  Problem problem;
  Sites sites;
  Motion motion;
  Look look;
  std::vector<double> start;  ///< u at t = 0
  double half_box = 0;        ///< half the width of the squares over which slip at a point is averaged
  Stepper stepper;
  double elastic_at_start = 0;
  double time = 0;

  Parts(const Problem& p, const DirectOptions& options)
      : problem(p),
        sites(make_sites(problem, options.scale, options.spacing)),
        stepper(problem, sites, options.threads) {
    Start lines = lines_at_rest(problem, sites);
    check_density(lines.largest_density, options);
    half_box = std::fmax(2 * pi / std::fmax(lines.largest_density, 1), 1) / sites.scale;
    start = lines.u;
    motion = stepper.start(std::move(lines.u));
    stepper.look_at(motion, 0, look);
    elastic_at_start = look.elastic;
  }

  /// Some sites are needed from one line to the next.
  static void check_density(double density, const DirectOptions& options) {
    constexpr double fewest = 3.5;
    if (!(2 * pi / density >= fewest * options.spacing))
      throw InputError({.key = "spacing",
                        .value = digits(options.spacing),
                        .problem = "lines are as close as " + digits(2 * pi / density, 3) + " widths",
                        .allowed = "at most " + digits(2 * pi / fewest / density, 3)});
  }

  /// Slip and slip velocity of a site.
  double slip(std::size_t at) const { return (look.u[at] - start[at]) / sites.scale; }
  double velocity(std::size_t at) const { return look.velocity[at]; }

  template <class Of>
  double mean(const Of& of, const Range& columns, const Range& rows) const {
    double sum = 0;
    for (std::size_t j = rows.first; j < rows.last; ++j)
      for (std::size_t i = columns.first; i < columns.last; ++i) sum += of(sites.at(i, j));
    return sum / static_cast<double>((rows.last - rows.first) * (columns.last - columns.first));
  }
  Range columns(double from, double to) const {
    return sites_between(from, to, sites.left, sites.hx / sites.scale, sites.nx);
  }
  Range rows(double from, double to) const {
    return sites_between(from, to, sites.bottom, sites.hy / sites.scale, sites.ny);
  }
  template <class Of>
  std::vector<double> around(const Of& of, const std::vector<Point>& points) const {
    std::vector<double> means;
    means.reserve(points.size());
    for (const Point& at : points)
      means.push_back(mean(of, columns(at.x - half_box, at.x + half_box), rows(at.y - half_box, at.y + half_box)));
    return means;
  }
  /// Integral over the plane, in units of the scenario.
  template <class Of>
  double integral(const Of& of) const {
    const double area = sites.hx * sites.hy / (sites.scale * sites.scale);
    return mean(of, {0, sites.nx}, {0, sites.ny}) * area * static_cast<double>(sites.nx * sites.ny);
  }
};

double memory_of_direct(const Problem& problem, const DirectOptions& options) {
  constexpr double arrays =
      14;  // u at three times, the start, two of a look, what its velocity and energy need, accelerations
  const Counts n = count_sites(problem, options.scale, options.spacing);
  const double given = (problem.contact ? 1 : 0) + (problem.viscous ? 1 : 0) + (problem.fixed ? 1 : 0) +
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

DirectSolver::DirectSolver(const Problem& problem, const DirectOptions& options) {
  check(problem);
  parts_ = std::make_unique<Parts>(problem, options);
}
DirectSolver::~DirectSolver() = default;

const Problem& DirectSolver::problem() const { return parts_->problem; }
double DirectSolver::time() const { return parts_->time; }
long DirectSolver::steps() const { return parts_->motion.steps; }
std::size_t DirectSolver::sites() const { return parts_->sites.nx * parts_->sites.ny; }

bool DirectSolver::advance_to(double time, const std::function<bool()>& interrupted) {
  Parts& p = *parts_;
  const bool reached = p.stepper.advance(p.motion, time, interrupted);
  p.time = reached ? time : p.stepper.time_of(p.motion);
  if (!reached) return false;
  p.stepper.look_at(p.motion, time, p.look);
  const double noise =
      std::fmax(1e-3 * p.elastic_at_start, no_energy * static_cast<double>(sites()) * p.sites.hx * p.sites.hy);
  check_budget(energies(), noise / (p.sites.scale * p.sites.scale), time,
               "a smaller chain.spacing or a larger chain.scale is needed");
  return true;
}

std::vector<double> DirectSolver::slip(const std::vector<Point>& points) const {
  return parts_->around([this](std::size_t at) { return parts_->slip(at); }, points);
}
std::vector<double> DirectSolver::velocity(const std::vector<Point>& points) const {
  return parts_->around([this](std::size_t at) { return parts_->velocity(at); }, points);
}

Field DirectSolver::field(int nx, int ny) const {
  const Parts& p = *parts_;
  const Problem& problem = p.problem;
  Field field{.time = time(), .nx = nx, .ny = ny, .slip = {}, .velocity = {}};
  const auto edge = [](double from, double to, int i, int n) { return from + (to - from) * i / n; };
  for (int j = 0; j < ny; ++j) {
    const Range rows = p.rows(edge(problem.bottom, problem.top, j, ny), edge(problem.bottom, problem.top, j + 1, ny));
    for (int i = 0; i < nx; ++i) {
      const Range columns =
          p.columns(edge(problem.left, problem.right, i, nx), edge(problem.left, problem.right, i + 1, nx));
      field.slip.push_back(p.mean([&p](std::size_t at) { return p.slip(at); }, columns, rows));
      field.velocity.push_back(p.mean([&p](std::size_t at) { return p.velocity(at); }, columns, rows));
    }
  }
  return field;
}

std::vector<Line> DirectSolver::lines() const { return lines_of(parts_->look.u, parts_->sites); }

double DirectSolver::potency() const {
  return parts_->integral([this](std::size_t at) { return parts_->slip(at); });
}
double DirectSolver::potency_rate() const {
  return parts_->integral([this](std::size_t at) { return parts_->velocity(at); });
}

/// The outermost line is the contour u = pi that is farthest from the origin.
double DirectSolver::front(double y_scale) const {
  const Parts& p = *parts_;
  double farthest = 0;  // its square
  for (std::size_t j = 0; j < p.sites.ny; ++j)
    for (std::size_t i = 0; i < p.sites.nx; ++i)
      if (p.look.u[p.sites.at(i, j)] >= pi)
        farthest = std::fmax(farthest, p.sites.x(i) * p.sites.x(i) + y_scale * p.sites.y(j) * y_scale * p.sites.y(j));
  return std::sqrt(farthest);
}

Energies DirectSolver::energies() const {
  const Parts& p = *parts_;
  const double per = 1 / (p.sites.scale * p.sites.scale);
  return {.kinetic = per * p.look.kinetic,
          .elastic = per * (p.look.elastic - p.elastic_at_start),
          .dissipated = per * p.look.dissipated,
          .supplied = per * p.look.supplied,
          .vanished = 0,
          .radiated = per * p.look.radiated};
}

std::string DirectSolver::saved() const {
  const Motion& m = parts_->motion;
  bytes::Writer writer;
  for (const double value : {parts_->time, m.dissipated, m.supplied, m.radiated}) writer.put(value);
  writer.put(static_cast<std::int64_t>(m.steps));
  for (const auto* values : {&m.u, &m.old, &m.v_old, &parts_->stepper.friction().states()}) writer.put(*values);
  return std::move(writer).text();
}

void DirectSolver::resume(std::string_view saved) {
  bytes::Reader reader(saved);
  Motion m;
  double time = 0;
  for (double* value : {&time, &m.dissipated, &m.supplied, &m.radiated}) *value = reader.get<double>();
  m.steps = static_cast<long>(reader.get<std::int64_t>());
  for (auto* values : {&m.u, &m.old, &m.v_old}) *values = reader.vector();
  std::vector<double> states = reader.vector();
  reader.end();
  const std::size_t size = parts_->sites.size();
  if (m.u.size() != size || m.old.size() != size || m.v_old.size() != parts_->motion.v_old.size() ||
      !parts_->stepper.friction().set_states(std::move(states)))
    throw InputError({.key = "resume",
                      .problem = "the saved state has another number of sites",
                      .allowed = "a file of the same scenario"});
  parts_->motion = std::move(m);
  parts_->time = time;
  parts_->stepper.look_at(parts_->motion, time, parts_->look);
}

}  // namespace slipfront::plane
