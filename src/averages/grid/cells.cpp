#include "averages/grid/cells.hpp"

#include <cmath>

#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"

namespace slipfront::plane {
namespace {

constexpr std::size_t reach = 2;  ///< a stencil of five cells reaches so far
/// A free cell this close to the boundary, less than 0.3 cells, gives no gradient with it.
constexpr double too_close = 0.2;

/// Derivative at 0 of the parabola through three values.
double slope_at_0(const std::array<double, 3>& at, const std::array<double, 3>& value) {
  const auto [a, b, c] = at;
  return -value[0] * (b + c) / ((a - b) * (a - c)) - value[1] * (a + c) / ((b - a) * (b - c)) -
         value[2] * (a + b) / ((c - a) * (c - b));
}

}  // namespace

Walls::Walls(const Problem& problem, const Cells& cells) : cells_(cells) {
  if (!problem.fixed) return;
  held_.assign(cells.size(), 0);
  cells.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    held_[cell] = problem.fixed(cells.x(i), cells.y(j)) != 0 ? 1 : 0;
  });
  cells_.mirror(held_);
  refuse_unseen(problem);
  for (const bool along_y : {false, true}) {
    std::vector<char>& near = near_[along_y ? 1 : 0];
    near.assign(cells.size(), 0);
    const std::size_t step = cells.step(along_y);
    cells.each([&](std::size_t, std::size_t, std::size_t cell) {
      for (std::size_t n = 0; n <= 2 * reach; ++n)
        if (held_[cell + n * step - reach * step] != 0) near[cell] = 1;
    });
    cells_.mirror(near);
    find(problem, along_y);
  }
}

/// A held region between the centres of cells would have no effect.
void Walls::refuse_unseen(const Problem& problem) const {
  constexpr int samples = 5;
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    for (const std::size_t row : {cell - cells_.stride(), cell, cell + cells_.stride()})
      for (const std::size_t at : {row - 1, row, row + 1})
        if (held(at)) return;
    const auto sample = [](int n) { return (n + 0.5) / samples - 0.5; };
    for (int row = 0; row < samples; ++row)
      for (int column = 0; column < samples; ++column) {
        const double x = cells_.x(i) + sample(column) * cells_.hx, y = cells_.y(j) + sample(row) * cells_.hy;
        if (problem.fixed(x, y) == 0) continue;
        throw InputError({.key = "fixed",
                          .problem = "the held region at x = " + digits(x, 4) + ", y = " + digits(y, 4) +
                                     " lies between the centres of cells",
                          .allowed = "more cells, or a larger region"});
      }
  });
}

void Walls::find(const Problem& problem, bool along_y) {
  const std::size_t step = cells_.step(along_y);
  cells_.each([&](std::size_t i, std::size_t j, std::size_t cell) {
    if ((along_y ? j : i) == 0 || !at_face(cell, along_y)) return;
    const bool is_up = !held(cell);
    Crossing crossing{.face = cell, .free = {}, .count = 0, .sign = is_up ? 1.0 : -1.0, .place = 0, .slip = 0};
    for (std::size_t n = 0; n < 3; ++n) {
      crossing.free[n] = is_up ? cell + n * step : cell - (n + 1) * step;
      if (crossing.count == n && !held(crossing.free[n])) ++crossing.count;
    }
    const auto point = [&](double place) {
      const double along = crossing.sign * place * cells_.spacing(along_y);
      return Point{cells_.x(i) + (along_y ? 0 : along - cells_.hx / 2),
                   cells_.y(j) + (along_y ? along - cells_.hy / 2 : 0)};
    };
    const auto is_fixed = [&](double place) {
      const Point at = point(place);
      return problem.fixed(at.x, at.y) != 0;
    };
    crossing.place = bisected({.holding = -0.5, .failing = 0.5}, is_fixed, 40).failing;
    const Point at = point(crossing.place);
    crossing.slip = problem.slip(at.x, at.y);
    crossings_[along_y ? 1 : 0].push_back(crossing);
  });
}

void Walls::set_gradients(const std::vector<double>& slip, bool along_y, std::vector<double>& gradient) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const std::size_t first = c.place > too_close && c.count > 1 ? 1 : 0;
    double slope = 0;
    if (c.count < first + 2) {
      const double at = static_cast<double>(first) + 0.5;
      slope = (slip[c.free[first]] - c.slip) / (at - std::fmin(c.place, too_close));
    } else {
      const double at = static_cast<double>(first) + 0.5;
      slope = slope_at_0({c.place, at, at + 1}, {c.slip, slip[c.free[first]], slip[c.free[first + 1]]});
    }
    gradient[c.face] = c.sign * slope / cells_.spacing(along_y);
  }
}

void Walls::set_actions(const std::vector<double>& action, bool along_y, std::vector<double>& at_faces) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const std::size_t first = c.place > too_close && c.count > 1 ? 1 : 0;
    const double at = static_cast<double>(first) + 0.5;
    at_faces[c.face] = -action[c.free[first]] * c.place / (at - std::fmin(c.place, too_close));
  }
}

void Walls::set_transverse(const std::vector<double>& in_cells, bool along_y, std::vector<double>& at_faces) const {
  for (const Crossing& c : crossings_[along_y ? 1 : 0]) {
    const double first = in_cells[c.free[0]];
    at_faces[c.face] = c.count > 1 ? first + (first - in_cells[c.free[1]]) / 2 : first;
  }
}

}  // namespace slipfront::plane
