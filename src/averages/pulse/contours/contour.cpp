#include "averages/pulse/contours/contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "math/constants.hpp"
#include "math/roots.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/rupture/trains.hpp"
#include "slipfront/theory/train.hpp"

namespace slipfront::pulse::edges {
namespace {

/// Widths below this are none: the averages do not exist for smaller ones.
constexpr double no_width = 1e-300;

State train_between(double low, double high) { return {low + (high - low) / 2, (high - low) / 2}; }

/// The bands between these edges. Those that are too narrow are closed.
rupture::FilledBands bands_of(const std::vector<double>& edges) {
  rupture::FilledBands bands = rupture::bands_of_edges(edges);
  for (double& width : bands.widths)
    if (width < no_width) width = 0;
  return bands;
}

}  // namespace

double speed_of(const std::vector<double>& edges, std::size_t j) {
  if (edges.size() == 2) {
    const modulation::Speeds speeds = modulation::characteristic_speeds(train_between(edges[0], edges[1]));
    return j == 0 ? speeds.minus : speeds.plus;
  }
  return rupture::edge_speeds(bands_of(edges))[j];
}

Source source_of(std::vector<double> edges, std::size_t j, const Forces& forces) {
  if (!forces.act()) return {};
  Source result;
  while (edges.size() > 4) {
    std::size_t least = edges.size();
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      if (edges[i] == edges[j] || edges[i + 1] == edges[j]) continue;
      if (least == edges.size() || edges[i + 1] - edges[i] < edges[least + 1] - edges[least]) least = i;
    }
    if (least == edges.size()) least = j + 2;  // all are next to edge j, which is there more than twice
    const double width = edges[least + 1] - edges[least];
    result.left_out = std::fmax(result.left_out, width / (edges.back() - edges.front()));
    const auto at = edges.begin() + static_cast<std::ptrdiff_t>(least);
    edges.erase(at, at + 2);
    if (least < j) j -= 2;
  }
  const std::vector<double> all = rupture::edge_sources(bands_of(edges), forces.load, forces.viscosity);
  result.change = j + 1 < edges.size() && edges[j + 1] == edges[j] ? (all[j] + all[j + 1]) / 2 : all[j];
  return result;
}

Means means_of(const std::vector<double>& edges) {
  std::vector<double> open;  // without bands and gaps that have no width
  for (const double r : edges) {
    const bool same = !open.empty() && r - open.back() < no_width;
    same ? open.pop_back() : open.push_back(r);
  }
  const std::size_t bands = open.size() / 2;
  const auto trains = static_cast<double>(bands);
  if (open.empty()) return {};
  if (open.size() == 2) {
    const train::Averages one = train::averages(train_between(open[0], open[1]));
    return {one.k, one.W, one.P, one.H, one.k > 0 ? one.W / one.k * one.P : 0, trains};  // <u_t^2> = U P
  }
  const rupture::BandAverages all = rupture::averages(rupture::bands_of_edges(open));
  return {all.k, all.W, all.P, all.H, all.squared_rate, trains};
}

}  // namespace slipfront::pulse::edges

namespace slipfront::pulse {
namespace {

constexpr int profile_samples = 4096;

double psi_under(double stress) { return train::at_rest(stress).psi; }

/// A stretch of continuous stress.
struct Piece {
  std::vector<double> x, stress, psi;  ///< samples
};

/// A jump of the initial stress: x on both sides, which differ by rounding.
struct Jump {
  double before, behind;
};

/// Bisects towards the larger change. A change that stays on an interval that has no inside is a jump.
std::optional<Jump> jump_between(const std::function<double(double)>& stress, double a, double b, double range) {
  double at_a = stress(a), at_b = stress(b);
  const double whole = std::fabs(at_b - at_a);
  const bool ends = (at_a > 0) != (at_b > 0);  // the boundary of a stretch without stress
  if (!ends && whole <= 1e-4 * range) return {};
  while (true) {
    const double middle = a + (b - a) / 2;
    if (middle == a || middle == b) break;
    const double at_middle = stress(middle);
    const bool first = ends ? (at_middle > 0) != (at_a > 0) : std::fabs(at_middle - at_a) > std::fabs(at_b - at_middle);
    (first ? b : a) = middle;
    (first ? at_b : at_a) = at_middle;
  }
  if (!ends && std::fabs(at_b - at_a) < whole / 2) return {};
  return Jump{a, b};
}

/// The stretches between jumps, from left to right, those without stress included.
std::vector<Piece> pieces_of(const Problem& problem) {
  const double left = problem.left, width = problem.right - problem.left;
  std::vector<double> x(profile_samples + 1), stress(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = i == profile_samples ? problem.right : left + width * static_cast<double>(i) / profile_samples;
    stress[i] = problem.stress(x[i]);
  }
  const auto [low, high] = std::minmax_element(stress.begin(), stress.end());
  std::vector<Piece> pieces(1);
  const auto add = [&](double at) {
    pieces.back().x.push_back(at);
    pieces.back().stress.push_back(problem.stress(at));
    pieces.back().psi.push_back(psi_under(pieces.back().stress.back()));
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0)
      if (const std::optional<Jump> jump = jump_between(problem.stress, x[i - 1], x[i], *high - *low)) {
        if (jump->before > x[i - 1]) add(jump->before);
        pieces.back().x.back() = jump->behind;  // both pieces end at the same x
        pieces.emplace_back();
        if (jump->behind < x[i]) add(jump->behind);
      }
    add(x[i]);
  }
  // A piece of one sample is the value of a step at an end of the domain.
  std::erase_if(pieces, [](const Piece& piece) { return piece.x.size() < 2; });
  const auto stressed = [](const Piece& piece) { return piece.stress.front() > 0; };
  if (std::none_of(pieces.begin(), pieces.end(), stressed))
    throw InputError(
        {.key = "stress", .problem = "no stress anywhere in the domain", .allowed = "stress > 0 somewhere"});
  return pieces;
}

/// Density of points along a piece. It is large where the stress changes, and where psi changes by a factor.
struct PointDensity {
  double width, range, factor;  ///< changes of x, stress and ln psi over the whole domain

  double between(const Piece& piece, std::size_t i) const {
    constexpr double of_x = Contour::weight_of_x, of_factor = 0.3;
    const double dx = (piece.x[i + 1] - piece.x[i]) / width, ds = (piece.stress[i + 1] - piece.stress[i]) / range;
    const double dl = std::log(piece.psi[i + 1] / piece.psi[i]) / factor;
    return std::sqrt(of_x * of_x * dx * dx + ds * ds + of_factor * of_factor * dl * dl);
  }
};

PointDensity measure_of(const Problem& problem, const std::vector<Piece>& pieces) {
  double low = HUGE_VAL, high = 0;
  for (const Piece& piece : pieces)
    for (const double stress : piece.stress)
      if (stress > 0) {
        low = std::fmin(low, stress);
        high = std::fmax(high, stress);
      }
  const bool uniform = !(high > low);
  constexpr double least_factor = 10;
  return {.width = problem.right - problem.left,
          .range = uniform ? high : high - low,
          .factor = std::fmax(least_factor, std::log(psi_under(high) / psi_under(low)))};
}

/// Steps from 0 to 1 that are cubic at both ends. Where a band closes, the density of its dislocations falls with the
/// logarithm of its width only.
double graded_share(std::size_t i, std::size_t count) {
  const double s = static_cast<double>(i) / static_cast<double>(count);
  return s * s * s * (10 + s * (6 * s - 15));
}

class Builder {
 public:
  explicit Builder(const Problem& given)
      : problem_(given), pieces_(pieces_of(given)), measure_(measure_of(given, pieces_)) {
    double sum = 0;
    for (const Piece& piece : pieces_)
      for (std::size_t i = 0; piece.stress.front() > 0 && i + 1 < piece.x.size(); ++i)
        sum += measure_.between(piece, i);
    for (std::size_t i = 0; i <= pieces_.size(); ++i) sum += jump_at(i);
    density_ = problem_.cells / sum;
  }

  Contour contour() {
    const bool left_open = pieces_.front().stress.front() > 0 && problem_.left_end != End::free,
               right_open = pieces_.back().stress.front() > 0 && problem_.right_end != End::free;
    made_.left_free = !left_open;
    made_.right_free = !right_open;
    find_front(left_open, right_open);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (!(pieces_[i].stress.front() > 0)) continue;
      std::size_t last = i;
      while (last + 1 < pieces_.size() && pieces_[last + 1].stress.front() > 0) ++last;
      add_stretch(i, last, i == 0 && left_open, last + 1 == pieces_.size() && right_open);
      i = last;
    }
    return std::move(made_);
  }

 private:
  /// Weight of the jump in front of a piece.
  double jump_at(std::size_t piece) const {
    const bool at_end = piece == 0 || piece == pieces_.size();
    if (at_end && (piece == 0 ? problem_.left_end : problem_.right_end) != End::free) return 0;
    const double before = piece > 0 ? pieces_[piece - 1].stress.back() : 0;
    const double behind = piece < pieces_.size() ? pieces_[piece].stress.front() : 0;
    return std::fabs(behind - before) / measure_.range;
  }
  std::size_t points_for(double weight) const {
    constexpr double fewest = 8;
    return static_cast<std::size_t>(std::fmax(fewest, std::round(density_ * weight)));
  }

  void add(double x, double r, bool corner = false) {
    const std::size_t n = made_.size();
    made_.x.push_back(x);
    made_.r.push_back(r);
    made_.corner.push_back(corner);
    made_.parameter_behind.push_back(1);
    made_.previous.push_back(n > first_ ? n - 1 : Contour::nothing);
    made_.next.push_back(Contour::nothing);
    if (n > first_) made_.next[n - 1] = n;
  }
  /// Points between two rapidities at one x. The first and the last one are there already.
  void add_jump(double x, double from, double to, std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) add(x, std::lerp(from, to, graded_share(i, count)));
  }
  /// The lower (sign -1) or upper edge of one piece, from left to right or back.
  void add_piece(const Piece& piece, double sign) {
    const bool with_front = front_piece_ == &piece;
    std::vector<double> at(piece.x.size());
    for (std::size_t i = 0; i + 1 < at.size(); ++i) at[i + 1] = at[i] + measure_.between(piece, i);
    const auto [least, most] = std::minmax_element(piece.stress.begin(), piece.stress.end());
    const bool straight = !(*least < *most) && !problem_.forcing;  // its ends are enough
    const std::size_t count = straight ? 1 : points_for(at.back());
    std::size_t nearest = Contour::nothing;
    std::vector<double> x(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
      const double wanted = at.back() * static_cast<double>(i) / static_cast<double>(count);
      const std::size_t k = interval(at, wanted);
      x[i] = i == 0       ? piece.x.front()
             : i == count ? piece.x.back()
                          : std::lerp(piece.x[k], piece.x[k + 1], (wanted - at[k]) / (at[k + 1] - at[k]));
      if (with_front && (nearest == Contour::nothing || std::fabs(x[i] - front_x_) < std::fabs(x[nearest] - front_x_)))
        nearest = i;
    }
    const bool of_front = (sign < 0) == made_.stressed_left;
    for (std::size_t j = 0; j <= count; ++j) {
      const std::size_t i = sign < 0 ? j : count - j;
      const bool is_front = of_front && i == nearest;
      if (is_front) {
        x[i] = front_x_;
        made_.front = made_.size();
      }
      if (!of_front && i == nearest && !made_.left_free && !made_.right_free) made_.tip = made_.size();
      const double psi = i == 0 ? piece.psi.front() : i == count ? piece.psi.back() : psi_under(problem_.stress(x[i]));
      add(x[i], sign * psi, i == 0 || i == count);
    }
  }

  /// One curve of points, or two if both ends continue: the lower edge from left to right, then the upper edge back.
  void add_stretch(std::size_t begin, std::size_t end, bool left_open, bool right_open) {
    const double left = pieces_[begin].x.front(), right = pieces_[end].x.back();
    const double psi_left = pieces_[begin].psi.front(), psi_right = pieces_[end].psi.back();
    // If only the right end continues, the curve has to begin there, with the upper edge.
    const bool upper_first = right_open && !left_open;
    first_ = made_.size();
    if (left_open) add(-Contour::far_away, -psi_left);
    for (const bool lower : {!upper_first, upper_first}) {
      if (!lower && right_open) {
        first_ = made_.size();
        add(Contour::far_away, psi_right);
      }
      for (std::size_t k = 0; k <= end - begin; ++k) {
        const std::size_t i = lower ? begin + k : end - k;
        const double sign = lower ? -1 : 1;
        if (k > 0) {
          const std::size_t behind = lower ? i : i + 1;
          const double from = made_.r.back(), to = sign * (lower ? pieces_[i].psi.front() : pieces_[i].psi.back());
          add_jump(made_.x.back(), from, to, points_for(jump_at(behind)));
        }
        add_piece(pieces_[i], sign);
      }
      if (lower && !right_open) add_jump(right, -psi_right, psi_right, 2 * points_for(jump_at(end + 1)));
      if (lower && right_open) add(Contour::far_away, -psi_right);
      if (!lower && !left_open) add_jump(left, psi_left, -psi_left, 2 * points_for(jump_at(begin)));
      if (!lower && left_open) add(-Contour::far_away, psi_left);
    }
    if (!left_open && !right_open) {
      made_.previous[first_] = made_.size() - 1;
      made_.next[made_.size() - 1] = first_;
    }
  }

  /// The x at which the stress first differs from that at the more stressed end by a hundredth of its range.
  void find_front(bool left_open, bool right_open) {
    const double at_left = left_open ? pieces_.front().stress.front() : 0,
                 at_right = right_open ? pieces_.back().stress.back() : 0;
    constexpr double rounding = 1e-9, felt = 0.01;
    made_.stressed_left = at_left >= (1 - rounding) * at_right;
    if (!left_open && !right_open) {
      const double left = problem_.stress(problem_.left), right = problem_.stress(problem_.right);
      made_.stressed_left = left >= (1 - rounding) * right;
      return;
    }
    const double stressed = made_.stressed_left ? at_left : at_right;
    double low = stressed, high = stressed;
    for (const Piece& piece : pieces_)
      for (const double stress : piece.stress) {
        low = std::fmin(low, stress);
        high = std::fmax(high, stress);
      }
    const auto departs = [&](double x) { return std::fabs(problem_.stress(x) - stressed) > felt * (high - low); };
    double still = made_.stressed_left ? problem_.left : problem_.right;
    for (int i = 1; i <= profile_samples; ++i) {
      const double share = static_cast<double>(i) / profile_samples;
      const double x = std::lerp(problem_.left, problem_.right, made_.stressed_left ? share : 1 - share);
      if (departs(x)) {
        still = bisected({.holding = x, .failing = still}, departs).failing;
        break;
      }
      still = x;
    }
    front_x_ = still;
    for (const Piece& piece : pieces_) {
      const bool reaches = made_.stressed_left ? piece.x.back() >= still : piece.x.front() <= still;
      if (reaches && (!made_.stressed_left || !front_piece_)) front_piece_ = &piece;
    }
  }

  const Problem& problem_;
  std::vector<Piece> pieces_;
  PointDensity measure_;
  double density_ = 0;
  double front_x_ = 0;
  const Piece* front_piece_ = nullptr;  ///< with the fast front, from its stressed side
  Contour made_;
  std::size_t first_ = 0;  ///< first point of the present curve
};

}  // namespace

std::array<double, 2> gauss_points(double a, double b) {
  const double offset = (b - a) * (1 - 1 / std::sqrt(3)) / 2;
  return {a + offset, b - offset};
}

Contour contour_at_rest(const Problem& problem) { return Builder(problem).contour(); }

}  // namespace slipfront::pulse
