/// \file
/// The functions of panel "Fault plane": a rupture on a plane, by the averages or line by line.

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "answer.hpp"
#include "slipfront/error.hpp"
#include "slipfront/lattice/plane/quantities.hpp"
#include "slipfront/lattice/plane/run.hpp"
#include "slipfront/lattice/plane/solvers.hpp"
#include "slipfront/scenario/problem.hpp"
#include "system/machine.hpp"

namespace slipfront::explorer {
namespace {

constexpr int frames = 60, cells = 100;
constexpr double most_plane_sites = 1e6;

/// The run of the panel, and how much of it the page has got.
struct LivePlane {
  std::unique_ptr<plane::Run> run;
  std::size_t frames_told = 0, rows_told = 0;
  std::string gave_up;  ///< why the run ended early
};

std::unique_ptr<LivePlane>& live_plane() {
  static std::unique_ptr<LivePlane> now;
  return now;
}

void check_size(const scenario::Scenario& s, bool direct) {
  if (!direct) return;
  plane::DirectOptions options{.scale = s.chain.scale.value_or(1)};
  options.spacing = s.chain.spacing.value_or(options.spacing);
  constexpr double bytes_a_site = 100;
  if (plane::memory_of_direct(s.plane->problem, options) > bytes_a_site * most_plane_sites)
    throw InputError({.key = "chain.scale",
                      .problem = "too many lines for a page",
                      .allowed = "a smaller scale; slipfront plane --direct runs more"});
}

/// Snapshots and rows that the page has not got yet, one after the other.
struct News {
  std::vector<double> time, velocity, slip, line_points, line_x, line_y;

  void add(const plane::Field& frame) {
    time.push_back(frame.time);
    velocity.insert(velocity.end(), frame.velocity.begin(), frame.velocity.end());
    slip.insert(slip.end(), frame.slip.begin(), frame.slip.end());
    const std::size_t before = line_x.size();
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (const plane::Line& line : frame.lines) {
      for (const plane::Point& point : line.points) add(point);
      add(plane::Point{none, none});
    }
    line_points.push_back(static_cast<double>(line_x.size() - before));
  }
  void add(const plane::Point& point) {
    line_x.push_back(point.x);
    line_y.push_back(point.y);
  }
};

News news_of(LivePlane& now) {
  News news;
  const auto& snapshots = now.run->snapshots();
  for (; now.frames_told < snapshots.size(); ++now.frames_told) news.add(snapshots[now.frames_told]);
  return news;
}

/// Puts the rows of the series that the page has not got yet.
Object& put_series(Object& object, LivePlane& now) {
  const std::vector<plane::SeriesRow>& rows = now.run->series();
  for (const plane::SeriesNumber& number : plane::series_numbers()) {
    std::vector<double> values;
    for (std::size_t i = now.rows_told; i < rows.size(); ++i) values.push_back(number.get(rows[i]));
    object.numbers(number.about.name, values);
  }
  now.rows_told = rows.size();
  return object;
}

}  // namespace

/// Starts the rupture of a scenario with changes, which are lines "table.key=value". A file that the scenario names has
/// the rows `r` and `slip`.
SLIPFRONT_EXPORT const char* plane_begin(const char* toml, const char* changes, const double* r, const double* slip,
                                         int rows, int direct) {
  return answer([=] {
    const auto table = [=](const std::string&, const std::vector<std::string>&) {
      std::vector<std::vector<double>> all;
      for (int i = 0; i < rows; ++i) all.push_back({r[i], slip[i]});
      return all;
    };
    scenario::Scenario s = scenario::read_scenario(toml, "", lines_of(changes), table);
    scenario::require_plane(s);
    check_size(s, direct != 0);
    s.plane->cells = cells;
    const scenario::SolverKind which = direct != 0 ? scenario::SolverKind::plane_direct : scenario::SolverKind::plane;
    plane::Schedule schedule = scenario::plane_schedule(s, which);
    schedule.lines = true;
    schedule.times.clear();
    for (int i = 0; i <= frames; ++i) schedule.times.push_back(s.end * i / frames);
    auto solver = scenario::plane_solver(s, which, 1);
    const plane::Problem& p = solver->problem();
    const double ratio = schedule.wave_speed_ratio;
    const Object begun = Object()
                             .put("left", p.left)
                             .put("right", p.right)
                             .put("bottom", p.bottom * ratio)
                             .put("top", p.top * ratio)
                             .put("end", s.end)
                             .put("nx", schedule.nx)
                             .put("ny", schedule.ny)
                             .put("warnings", s.warnings);
    live_plane() = std::make_unique<LivePlane>();
    live_plane()->run = std::make_unique<plane::Run>(std::move(solver), std::move(schedule));
    return begun;
  });
}

/// Advances the rupture for about so many milliseconds. Returns what is new since the last call.
SLIPFRONT_EXPORT const char* plane_go(double milliseconds) {
  return answer([=] {
    if (!live_plane()) throw InputError({.key = "plane", .problem = "no rupture was started"});
    LivePlane& now = *live_plane();
    const auto begun = Clock::now();
    try {
      now.run->go([=] { return 1e3 * seconds_since(begun) > milliseconds; });
    } catch (const NumericsError& error) {
      now.gave_up = error.what();
    }
    const News news = news_of(now);
    Object object;
    object.put("finished", now.run->finished() || !now.gave_up.empty())
        .put("gave_up", now.gave_up)
        .put("now", now.run->solver().time())
        .put("steps", now.run->solver().steps())
        .put("warnings", now.run->warnings())
        .numbers("time", news.time)
        .numbers("velocity", news.velocity)
        .numbers("slip", news.slip)
        .numbers("line_points", news.line_points)
        .numbers("line_x", news.line_x)
        .numbers("line_y", news.line_y);
    return put_series(object, now);
  });
}

}  // namespace slipfront::explorer
