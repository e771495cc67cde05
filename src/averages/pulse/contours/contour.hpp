#pragma once
/// \file
/// The edges of the filled bands of rapidities over x (docs/theory/9_trains.md 9.1), as curves of points (x, r). A
/// vertical line crosses them an even number of times: at the edges of the bands at that x. A curve that folds over
/// makes two trains out of one.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "slipfront/averages/pulse/problem.hpp"
#include "system/archive.hpp"

/// Speeds and averages that follow from the rapidities of all edges at one position. The rapidities rise, and there is
/// an even number of them.
namespace slipfront::pulse::edges {

/// Speed of edge j.
double speed_of(const std::vector<double>& edges, std::size_t j);

/// Load F and viscosity C at one position.
struct Forces {
  double load = 0, viscosity = 0;
  bool act() const { return load != 0 || viscosity != 0; }
};
/// Change of the rapidity of edge j with time, Eq. (9.11). Two edges that are equal change as one. Of three or more
/// trains, the narrowest bands and gaps of other edges are left out.
struct Source {
  double change = 0;
  double left_out = 0;  ///< greatest width that is left out, over the range of all edges
};
Source source_of(std::vector<double> edges, std::size_t j, const Forces& forces);

/// Averages over all trains at one position; 0 where there are none.
struct Means {
  double k = 0, W = 0, P = 0, H = 0;
  double squared_rate = 0;  ///< <u_t^2>
  double trains = 0;        ///< number of trains
};
Means means_of(const std::vector<double>& edges);

}  // namespace slipfront::pulse::edges

namespace slipfront::pulse {

/// Positions of the two-point Gauss rule between a and b; the weight of each is (b - a) / 2.
std::array<double, 2> gauss_points(double a, double b);

struct Contour {
  static constexpr std::size_t nothing = static_cast<std::size_t>(-1);
  static constexpr double weight_of_x = 0.3;  ///< the whole domain counts as this much of the range of rapidities
  static constexpr double far_away = 1e300;   ///< |x| of the end of a curve that continues outside the domain

  std::vector<double> x;
  std::vector<double> r;                    ///< rapidity of each point
  std::vector<std::size_t> previous, next;  ///< neighbours on the same curve; nothing at the end of a curve
  std::vector<std::uint8_t> corner;         ///< points where a curve has no tangent
  /// Along a curve, x and r are smooth functions of a parameter. This is its change up to the next point: 1 at t = 0.
  std::vector<double> parameter_behind;
  /// The point of the fast front: the foot of the fan of a step, or where a smooth stress first differs from that at
  /// the more stressed end. Nothing if neither end is stressed.
  std::size_t front = nothing;
  std::size_t tip = nothing;                   ///< the point of the slow front of a step between stressed sides
  bool stressed_left = true;                   ///< whether the fast front runs to the left
  bool left_free = false, right_free = false;  ///< whether there is no stress outside the domain

  std::size_t size() const { return r.size(); }
  /// Whether a point is the end of a curve outside the domain. It does not move.
  bool is_end(std::size_t point) const { return previous[point] == nothing || next[point] == nothing; }
  /// The ends of the two curves that continue to the left (side -1) or right, the lower rapidity first; or nothing.
  std::vector<std::size_t> ends(double side) const;
  void archive(Archive& a);
  /// Adds a point on the curve half-way to the next point.
  void add_behind(std::size_t point);
  /// Adds a point between a point and the next one. Returns its number.
  std::size_t insert_behind(std::size_t point, double at_x, double at_r);
  /// Removes a point, whose number the last point gets.
  void remove(std::size_t point);
};

/// The curves of the trains at rest at t = 0, with about `problem.cells` points on each edge. \throws InputError if
/// there is no stress.
Contour contour_at_rest(const Problem& problem);

/// Finds the edges of all bands at many x, from left to right.
class Sweep {
 public:
  explicit Sweep(const Contour& contour) : contour_(contour) {}

  /// Visits the edges at one x: their rapidities, rising.
  using VisitPoint = std::function<void(std::size_t point, const std::vector<double>& edges, std::size_t own)>;
  using VisitPlace = std::function<void(std::size_t i, const std::vector<double>& edges)>;

  /// Visits every point of a curve. The edge of the point is edges[own]. Where a curve turns back, it counts twice.
  void at_points(const VisitPoint& visit);
  /// Visits each x[i], which must rise.
  void at(std::span<const double> x, const VisitPlace& visit);

 private:
  void begin();
  /// Stretches of curves that end at a point are no longer crossed behind it, and those that begin there are.
  void end_at(std::size_t point);
  void begin_at(std::size_t point);
  bool is_behind(std::size_t other, std::size_t point) const {
    return other != Contour::nothing && rank_[other] > rank_[point];
  }
  bool is_before(std::size_t other, std::size_t point) const {
    return other != Contour::nothing && rank_[other] < rank_[point];
  }
  double rapidity(std::size_t first, double x) const;

  const Contour& contour_;
  std::vector<std::size_t> order_, rank_;  ///< points in the order of x, and the position of each in that order
  std::vector<std::size_t> crossed_;       ///< first points of the stretches that cross the present x
  std::vector<double> edges_;
};

}  // namespace slipfront::pulse
