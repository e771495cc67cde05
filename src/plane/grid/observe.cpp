#include "plane/grid/observe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modulation/equations.hpp"
#include "plane/direct/lines.hpp"

namespace slipfront::plane {

using std::numbers::pi;

/// The density of energy is g |grad U|^2 - a^2 p.
GridEnergy energy(const GridMotion& motion, const GridEquations& equations, const Cells& cells) {
  Trains moving = equations.trains();
  std::vector<double> areas;
  areas.reserve(moving.at.size());
  for (std::size_t i = 0; i < moving.at.size(); ++i) {
    const GridEquations::Inside inside = equations.inside(moving.at[i], motion.now.slip);
    areas.push_back(motion.now.slip[moving.at[i]] > 0 ? inside.area : 0);
    moving.gradient[i] = inside.gradient;
    set_spacing(moving, i);
  }
  solve_all(moving);
  Trains rest = moving;
  std::fill(rest.momentum.begin(), rest.momentum.end(), 0.0);
  solve_all(rest);
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

}  // namespace slipfront::plane
