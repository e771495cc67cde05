#include "averages/pulse/grid/layout.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "math/constants.hpp"
#include "math/digits.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse {

using std::numbers::pi;

InitialGrid::InitialGrid(const Problem& problem, const Cells& at_start, FreeEdges free_edges)
    : faces{at_start.left_edge()}, charges{0}, free(free_edges), stress(problem.stress) {
  for (std::size_t i = 0; i < at_start.size(); ++i) {
    faces.push_back(faces.back() + at_start.width(i));
    charges.push_back(charges.back() + at_start.charge[i]);
  }
  const auto differs = [&](double x) { return problem.contact(x) != problem.contact(faces.front()); };
  contact_varies = problem.contact && std::any_of(faces.begin(), faces.end(), differs);
}

double InitialGrid::position_of(double charge) const {
  const double rounding = 1e-12 * (charges.back() - charges.front());
  // A dislocation that entered through an end comes from a train with the stress of that end.
  if (charge < charges.front() - rounding)
    return faces.front() + (charge - charges.front()) * 2 * pi / stress(faces.front());
  if (charge > charges.back() + rounding)
    return faces.back() + (charge - charges.back()) * 2 * pi / stress(faces.back());
  const std::size_t i = interval(charges, charge);
  return charge - charges[i] < charges[i + 1] - charge ? faces[i] : faces[i + 1];
}

/// Adds up the whole cells, and integrates the stress over the parts of cells at either end.
double InitialGrid::charge_between(double from, double to) const {
  if (from > to) return -charge_between(to, from);
  const auto beyond = [&](double a, double b, double end) {
    const bool is_free = end == faces.front() ? free.left : free.right;
    return is_free || !(b > a) ? 0 : (b - a) * stress(end) / (2 * pi);
  };
  double sum =
      beyond(from, std::min(to, faces.front()), faces.front()) + beyond(std::max(from, faces.back()), to, faces.back());
  from = std::clamp(from, faces.front(), faces.back());
  to = std::clamp(to, faces.front(), faces.back());
  const std::size_t first = interval(faces, from), last = interval(faces, to);
  const auto part = [&](double a, double b) { return integral(stress, a, b) / (2 * pi); };
  if (first == last) return sum + part(from, to);
  sum += part(from, faces[first + 1]) + part(faces[last], to);
  for (std::size_t i = first + 1; i < last; ++i) sum += charges[i + 1] - charges[i];
  return sum;
}

bool InitialGrid::fits(const Cells& cells, std::size_t state_values) const {
  const std::size_t n = cells.charge.size();
  const double all = charges.back();
  double left = -cells.entered_left;
  bool fits = std::isfinite(left) && std::isfinite(cells.entered_right) && n > 0 && cells.s.size() == n &&
              (cells.face_momentum.empty() || cells.face_momentum.size() == n + 1) &&
              cells.unknowns.size() == Values::size(n) && cells.state.size() == state_values && cells.charge[0] > 0 &&
              cells.charge[n - 1] > 0;
  for (std::size_t i = 0; i < n && fits; ++i) {
    left += cells.charge[i];
    const auto near = std::lower_bound(charges.begin(), charges.end(), left - 1e-9 * all);
    const bool outside = left < -1e-9 * all || left > (1 + 1e-9) * all;  // entered through an end
    fits = cells.charge[i] >= 0 && (outside || (near != charges.end() && *near <= left + 1e-9 * all));
  }
  return fits && std::fabs(left - all - cells.entered_right) <= 1e-9 * (all + std::fabs(cells.entered_right));
}

double integral(const std::function<double(double)>& f, double a, double b) {
  constexpr double node[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
                              0.9739065285171717};
  constexpr double weight[5] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806,
                                0.0666713443086881};
  const double middle = a + (b - a) / 2, half = (b - a) / 2;
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += weight[i] * (f(middle - half * node[i]) + f(middle + half * node[i]));
  return sum * half;
}

namespace {

using std::numbers::pi;

/// Finds the boundary of a stressed stretch between an empty point and a stressed one, by bisection.
double edge_between(const std::function<double(double)>& stress, double empty, double stressed) {
  return bisected({.holding = stressed, .failing = empty}, [&](double x) { return stress(x) > 0; }).holding;
}

/// Maps 0 ... 1 to itself, with zero slope at the free ends.
double graded(double s, bool left_free, bool right_free) {
  if (left_free && right_free) return s * s * (3 - 2 * s);
  if (left_free) return s * s;
  if (right_free) return 1 - (1 - s) * (1 - s);
  return s;
}

/// Density of cells over x: 1 far from any change of stress, larger near changes. The coordinate in which all cells are
/// equally wide is the integral of this density, divided by its total.
class Monitor {
 public:
  static constexpr int points = 4096;

  Monitor(const std::function<double(double)>& stress, double from, double to, double corner)
      : from_(from), h_((to - from) / points) {
    std::vector<double> value(points + 1), density(points + 1, 1.0);
    for (int i = 0; i <= points; ++i) value[at(i)] = stress(i == points ? to : from + i * h_);
    const auto [low, high] = std::minmax_element(value.begin(), value.end());
    const double range = *high - *low;
    const bool stepped = corner > from && corner < to;
    // A large contrast of stress creates shocks, and these occur where the stress was steep.
    const double pull = std::fmin(4.5 * range / (*high + *low), most_pull);
    for (int i = 1; i < points && range > 0 && !stepped; ++i) {
      // The density is sqrt(1 + slope^2), bounded smoothly near `most`, so that it is smooth if the stress is.
      const double slope = pull * points * (value[at(i + 1)] - value[at(i - 1)]) / (2 * range);
      density[at(i)] = std::sqrt(1 + slope * slope / (1 + slope * slope / (most * most)));
    }
    for (int pass = 0; pass < 3; ++pass) smooth(density);
    if (stepped)
      for (int i = 0; i <= points; ++i)
        density[at(i)] += 3 / (1 + std::pow((from + i * h_ - corner) / (0.08 * (to - from)), 2));
    integral_.assign(points + 1, 0.0);
    for (int i = 1; i <= points; ++i)
      integral_[at(i)] = integral_[at(i - 1)] + (density[at(i - 1)] + density[at(i)]) / 2;
    density_ = std::move(density);
  }

  /// Returns x at a given share of the integral, by cubic Hermite interpolation: cell widths then vary smoothly.
  double x_at(double share) const {
    const double target = share * integral_.back();
    const auto above = std::upper_bound(integral_.begin() + 1, integral_.end() - 1, target);
    const std::size_t i = static_cast<std::size_t>(above - integral_.begin()) - 1;
    const double width = integral_[i + 1] - integral_[i], s = (target - integral_[i]) / width, r = 1 - s;
    const double rise = s * s * (3 - 2 * s) + width * s * r * (r / density_[i] - s / density_[i + 1]);
    return from_ + (static_cast<double>(i) + rise) * h_;
  }
  double share_at(double x) const {
    const double position = (x - from_) / h_;
    const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(position), points - 1);
    const double s = position - static_cast<double>(i);
    return (integral_[i] + s * (density_[i] + s * (density_[i + 1] - density_[i]) / 2)) / integral_.back();
  }

 private:
  // We chose these constants and the smoothing by the error of W(0) with 60 to 120 cells, tanh profiles of width 0.1 to
  // 2, C = 0 to 2, and both closures.
  static constexpr double most = 32;  ///< ratio of the coarsest cell width to the finest, before smoothing
  /// Largest weight of slopes. With 1, cells have equal lengths on the curve of stress over x, both scaled to 1.
  static constexpr double most_pull = 3;

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// Replaces f by its mean over 12 % of the stretch. The scheme has its full order only if neighbouring cells differ
  /// little.
  static void smooth(std::vector<double>& f) {
    constexpr int half = 3 * points / 50;
    std::vector<double> sum(f.size() + 1, 0.0);
    for (std::size_t i = 0; i < f.size(); ++i) sum[i + 1] = sum[i] + f[i];
    for (int i = 0; i <= points; ++i) {
      const int low = std::max(0, i - half), high = std::min(points, i + half);
      f[at(i)] = (sum[at(high) + 1] - sum[at(low)]) / (high - low + 1);
    }
  }

  double from_, h_;
  std::vector<double> integral_, density_;
};

/// Appends faces from `from` to `to`, equidistant in the monitor's coordinate but graded towards free ends.
void fill(std::vector<double>& faces, const Monitor& monitor, double from, double to, int cells, bool left_free,
          bool right_free) {
  const double a = monitor.share_at(from), b = monitor.share_at(to);
  for (int i = 1; i <= cells; ++i)
    faces.push_back(
        i == cells ? to : monitor.x_at(a + (b - a) * graded(static_cast<double>(i) / cells, left_free, right_free)));
}

/// The ends of a stretch that has stress at the sampled points.
struct Stressed {
  double from, to;
};
constexpr int gap_samples = 4096;

/// Checks fifteen more points between two neighbouring samples without stress. A stretch of stress there would get no
/// cells, so it is an error.
void refuse_narrow_stress(const std::function<double(double)>& stress, double from, double to) {
  constexpr int finer = 16;
  for (int i = 1; i < finer; ++i) {
    const double x = std::lerp(from, to, static_cast<double>(i) / finer);
    if (stress(x) > 0)
      throw InputError({.key = "stress",
                        .problem = "the stress at x = " + digits(x) + " is on a stretch narrower than 1 / " +
                                   std::to_string(gap_samples) + " of the domain",
                        .allowed = "wider stretches of stress, or a smaller domain"});
  }
}

std::vector<Stressed> stressed_stretches(const std::function<double(double)>& stress, double left, double right) {
  const double h = (right - left) / gap_samples;
  const auto place = [&](int i) { return i == gap_samples ? right : left + i * h; };
  std::vector<Stressed> found;
  bool before = false;
  for (int i = 0; i <= gap_samples; ++i) {
    const bool now = stress(place(i)) > 0;
    if (now && !before) found.push_back({i == 0 ? left : edge_between(stress, place(i - 1), place(i)), right});
    if (!now && before) found.back().to = edge_between(stress, place(i), place(i - 1));
    if (!now && !before && i > 0) refuse_narrow_stress(stress, place(i - 1), place(i));
    before = now;
  }
  // Remove stretches of a single point, such as the value of a step at the end of the domain.
  const auto point = [h](const Stressed& s) { return !(s.to - s.from > 1e-9 * h); };
  found.erase(std::remove_if(found.begin(), found.end(), point), found.end());
  if (found.empty())
    throw InputError(
        {.key = "stress", .problem = "no stress anywhere in the domain", .allowed = "stress > 0 somewhere"});
  return found;
}

}  // namespace

Layout lay_cells(const std::function<double(double)>& stress, double left, double right, int cells, double corner,
                 FreeEnds free) {
  const std::vector<Stressed> stretches = stressed_stretches(stress, left, right);
  double length = 0;
  for (const Stressed& s : stretches) length += s.to - s.from;
  Layout layout{{stretches.front().from},
                {},
                free.left || stretches.front().from > left,
                free.right || stretches.back().to < right};
  for (const Stressed& s : stretches) {
    const bool left_free = free.left || s.from > left, right_free = free.right || s.to < right;
    if (layout.faces.back() < s.from) layout.faces.push_back(s.from);  // a gap is one cell
    const int share = std::max(4, static_cast<int>(std::lround(cells * (s.to - s.from) / length)));
    const Monitor monitor(stress, s.from, s.to, corner);
    // If the corner is within rounding of an end of the stretch, it gets no face: rounding would decide the width
    // of the cell between them.
    const double sliver = 1e-9 * (s.to - s.from);
    if (corner - s.from > sliver && s.to - corner > sliver) {
      const int before = std::clamp(static_cast<int>(std::lround(share * monitor.share_at(corner))), 1, share - 1);
      fill(layout.faces, monitor, s.from, corner, before, left_free, false);
      fill(layout.faces, monitor, corner, s.to, share - before, false, right_free);
    } else {
      fill(layout.faces, monitor, s.from, s.to, share, left_free, right_free);
    }
  }
  const auto empty = [&](double x) {  // whether x is between two stretches
    for (const Stressed& s : stretches)
      if (x > s.from && x < s.to) return false;
    return true;
  };
  for (std::size_t i = 0; i + 1 < layout.faces.size(); ++i) {
    const double a = layout.faces[i], b = layout.faces[i + 1];
    layout.charge.push_back(empty(a + (b - a) / 2) ? 0 : integral(stress, a, b) / (2 * pi));
  }
  return layout;
}

using std::numbers::pi;

namespace {

/// A contact that jumps would be a wall to some cells and nothing to others: there must be a slope to climb.
void refuse_jumps(const std::function<double(double)>& contact, double left, double right) {
  constexpr int samples = 4096;
  const double h = (right - left) / samples;
  for (int i = 0; i < samples; ++i) {
    double a = left + i * h, b = a + h, at_a = contact(a), at_b = contact(b);
    const double whole = std::fabs(at_b - at_a), from = at_a, to = at_b;
    if (whole < 1e-3 * at_a) continue;
    while (b - a > 1e-6 * h) {  // the half that changes more
      const double middle = (a + b) / 2, at_middle = contact(middle);
      const bool first = std::fabs(at_middle - at_a) > std::fabs(at_b - at_middle);
      (first ? b : a) = middle;
      (first ? at_b : at_a) = at_middle;
    }
    if (std::fabs(at_b - at_a) > whole / 2)
      throw InputError({.key = "contact",
                        .problem = "jumps from " + digits(from) + " to " + digits(to) + " at x = " + digits(a),
                        .allowed = "a continuous profile, such as tanh of a width of some cells"});
  }
}

}  // namespace

Start start_of(const Problem& problem) {
  assert(problem.left < problem.right && problem.cells >= 4 && problem.tolerance > 0);
  assert(problem.friction.defined_by(problem.friction.closure()));
  if (problem.contact) refuse_jumps(problem.contact, problem.left, problem.right);
  const Layout layout = lay_cells(
      problem.stress, problem.left, problem.right, problem.cells, problem.corner,
      {!problem.periodic && problem.left_end == End::free, !problem.periodic && problem.right_end == End::free});
  if (problem.periodic && (layout.left_free || layout.right_free))
    throw InputError({.key = "periodic",
                      .problem = "there is no stress at an end of the domain",
                      .allowed = "a ring that is stressed where its ends meet"});
  Cells cells;
  cells.charge = layout.charge;
  const std::size_t n = layout.charge.size();
  cells.unknowns.assign(Values::size(n), 0.0);
  cells.s.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    cells.width(i) = layout.faces[i + 1] - layout.faces[i];
    if (cells.charge[i] == 0) continue;
    const double a = problem.contact ? problem.contact((layout.faces[i] + layout.faces[i + 1]) / 2) : 1;
    const double local = 2 * pi * cells.charge[i] / (a * cells.width(i));
    if (!(local >= train::smallest_stress))
      throw InputError(
          {.key = problem.contact ? "contact" : "stress",
           .problem = "stress over contact ratio is " + digits(local) + " at x = " + digits(layout.faces[i]),
           .allowed = "at least 0.0045 where there is stress: dislocations farther apart have no psi"});
    cells.s[i] = std::tanh(train::psi_of_stress(local));
  }
  cells.left_edge() = layout.faces.front();
  return {cells, {layout.left_free, layout.right_free}};
}

double gaps_close_in(const Problem& problem, const Cells& cells, const double* rates) {
  const ConstValues rate(rates, cells.size());
  double least = HUGE_VAL;
  if (problem.left_end == End::fixed && rate.left_edge() < 0)
    least = std::fmax((problem.left - cells.left_edge()) / rate.left_edge(), 0.0);
  if (problem.right_end == End::fixed) {
    double speed = rate.left_edge();
    for (std::size_t i = 0; i < cells.size(); ++i) speed += rate.width(i);
    if (speed > 0) least = std::fmin(least, std::fmax((problem.right - cells.left_face(cells.size())) / speed, 0.0));
  }
  if (least == 0) least = HUGE_VAL;  // at the wall
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells.charge[i] == 0 && rate.width(i) < 0) least = std::fmin(least, -cells.width(i) / rate.width(i));
  return least;
}

namespace {

/// Whether the edges of a gap have met, to a millionth of the cells next to it.
bool gap_has_closed(const Cells& cells, std::size_t i) {
  return cells.charge[i] == 0 && cells.width(i) <= 1e-6 * std::fmin(cells.width(i - 1), cells.width(i + 1));
}

/// Cells next to a closed gap become neighbours. Cells are small at free edges; in the dense state that grows where two
/// edges have met they would only shorten the steps, and are joined.
void close_gap(Cells& cells, std::size_t i) {
  cells.width(i - 1) += cells.width(i) / 2;
  cells.width(i + 1) += cells.width(i) / 2;
  cells.width(i) = 0;
  cells.erase(i);
  std::vector<double> sorted = cells.charge;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double enough = 0.4 * *middle;
  const auto small = [&](std::size_t j) { return cells.charge[j] > 0 && cells.charge[j] < enough; };
  for (std::size_t j = i; j < cells.size() && small(j); ++j)
    while (small(j) && j + 1 < cells.size() && cells.charge[j + 1] > 0) cells.join(j + 1, j);
  std::size_t j = i;
  while (j > 0 && small(j - 1)) {
    --j;
    while (small(j) && j > 0 && cells.charge[j - 1] > 0) {
      cells.join(j - 1, j);
      --j;  // the index of the joined cell
    }
  }
}

}  // namespace

/// Closes gaps from right to left. The first and the last cell are never gaps: layout and saved runs begin and end with
/// stress, and no end drops a cell next to a gap.
bool close_gaps(Cells& cells) {
  bool closed = false;
  for (std::size_t i = cells.size() - 1; i-- > 1;) {
    if (!gap_has_closed(cells, i)) continue;
    close_gap(cells, i);
    i = std::min(i, cells.size() - 1);  // joining may have removed cells on both sides
    closed = true;
  }
  if (closed) cells.face_momentum.clear();
  return closed;
}

namespace {

constexpr std::size_t fewest = 8;   ///< cells are removed only while more than this remain
constexpr std::size_t reach = 3;    ///< cells outside a continued end that the faces inside need
constexpr int most_at_once = 5000;  ///< most cells that may enter after one step; waves never need as many

double energy_in(const Problem& problem, const Cells& cells, std::size_t cell) {
  const double x = cells.centre(cell), a = problem.contact ? problem.contact(x) : 1;
  const double q = cells.charge[cell], width = cells.width(cell);
  const State state = modulation::state_of({a * width / q, cells.momentum(cell) / (a * q)}, std::atanh(cells.s[cell]));
  return train::averages(state, a).H * width;
}

/// Adds a copy of the last cell, because the train outside is the same as at the end of the domain.
void fill_end(const Problem& problem, Cells& cells, bool left) {
  const Cells::Cell last = cells.cell(left ? 0 : cells.size() - 1);
  cells.insert(left ? 0 : cells.size(), last);
  if (!cells.face_momentum.empty()) {  // the face at an end has only half a cell around it
    double& half = left ? cells.face_momentum.front() : cells.face_momentum.back();
    const double outer = half;
    half *= 2;
    cells.face_momentum.insert(left ? cells.face_momentum.begin() : cells.face_momentum.end(), outer);
  }
  (left ? cells.entered_left : cells.entered_right) += last.charge;
  if (left) cells.left_edge() -= last.width;
  cells.values().through_ends() += energy_in(problem, cells, left ? 0 : cells.size() - 1);
}

/// Removes the last cell at one end, which is outside the domain.
void drop_outside(const Problem& problem, Cells& cells, bool left) {
  const std::size_t end = left ? 0 : cells.size() - 1;
  const double width = cells.width(end);
  cells.values().through_ends() -= energy_in(problem, cells, end);
  (left ? cells.entered_left : cells.entered_right) -= cells.charge[end];
  if (!cells.face_momentum.empty()) {
    const std::size_t next = left ? 1 : cells.size() - 1;
    const double around = cells.charge[next] + cells.charge[next - 1], inside = cells.charge[left ? 1 : end - 1];
    cells.face_momentum[next] *= inside / around;
    cells.face_momentum.erase(left ? cells.face_momentum.begin() : cells.face_momentum.end() - 1);
  }
  cells.erase(end);
  if (left) cells.left_edge() += width;
}

/// Stops a free edge at the wall when it returns there.
void stop_at_walls(const Problem& problem, Cells& cells) {
  double& x = cells.left_edge();
  const double near = 1e-6;  // fraction of a cell within which an edge counts as at the wall
  if (problem.left_end == End::fixed && x < problem.left + near * cells.width(0)) {
    cells.width(0) -= problem.left - x;
    x = problem.left;
  }
  if (problem.right_end != End::fixed) return;
  double& last = cells.width(cells.size() - 1);
  const double beyond = cells.left_face(cells.size()) - problem.right;
  if (beyond > -near * last) last -= beyond;
}

}  // namespace

bool adjust_ends(const Problem& problem, FreeEdges free, Cells& cells) {
  if (problem.periodic) return false;
  bool changed = false;
  for (const bool left : {true, false}) {
    const End end = left ? problem.left_end : problem.right_end;
    if (end == End::fixed) continue;
    const bool continued = end == End::continued;
    if (continued && (left ? free.left : free.right)) continue;  // the stress ends inside the domain
    const double edge = left ? cells.left_edge() : cells.left_face(cells.size());
    // Rounding moves a train at rest. We do not fill a space narrower than this fraction of a cell.
    const double sliver = continued ? 1e-3 * cells.width(left ? 0 : cells.size() - 1) : 0;
    double inside = (left ? edge - problem.left : problem.right - edge) - sliver;
    for (int i = 0; continued && inside > 0; ++i) {
      if (i == most_at_once)
        throw NumericsError("t = " + digits(cells.time) + ": the train moved away from an end of the domain by " +
                            digits(inside) + " in one step; more cells or a larger domain help");
      fill_end(problem, cells, left);
      changed = true;
      inside -= cells.width(left ? 0 : cells.size() - 1);
    }
    const std::size_t margin = continued ? reach : 0;
    while (cells.size() > fewest + margin) {
      double first = 0;  // total width of the cells that must be outside the domain
      for (std::size_t i = 0; i <= margin; ++i) first += cells.width(left ? i : cells.size() - 1 - i);
      const bool alone = cells.charge[left ? 1 : cells.size() - 2] == 0;
      if (inside + first > 0 || alone) break;
      inside += cells.width(left ? 0 : cells.size() - 1);
      drop_outside(problem, cells, left);
      changed = true;
    }
  }
  stop_at_walls(problem, cells);
  return changed;
}

}  // namespace slipfront::pulse
