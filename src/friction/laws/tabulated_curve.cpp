// Friction that the user draws: a formula of the slip velocity, or a table.

#include "friction/laws/tabulated_curve.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "friction/train_means/chebyshev.hpp"
#include "friction/train_means/mean_over_train.hpp"
#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"

namespace slipfront::friction {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr int bits_of_place = 48;  ///< bits within a piece; its index is the exponent and the 4 bits above these
constexpr double slowest_piece = 0x1p-84, fastest_piece = 0x1p6;  // rounding causes speeds not far below 1e-20

std::uint64_t piece_of(double speed) { return std::bit_cast<std::uint64_t>(speed) >> bits_of_place; }
double start_of(std::uint64_t piece) { return std::bit_cast<double>(piece << bits_of_place); }

/// Fits a polynomial to the curve between `from` and `to`. Sets c[0] to NaN if the polynomial is not precise enough or
/// the curve fails.
template <std::size_t n>
void fit(const ChebyshevFit<n>& through, const Curve& curve, double from, double to, double (&c)[n]) {
  constexpr double precision = 1e-12;
  const auto speed_at = [=](double t) { return (from + to) / 2 + (to - from) / 2 * t; };
  bool fits = true;
  try {
    double f[n];
    for (std::size_t i = 0; i < n; ++i) f[i] = curve(speed_at(ChebyshevFit<n>::extremum(i)));
    through(f, c);
    for (std::size_t i = 0; i + 1 < n && fits; ++i) {  // check between the nodes
      const double t = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / (n - 1)),
                   value = curve(speed_at(t));
      fits = std::fabs(polynomial_by_pairs(c, t) - value) <= precision * std::fabs(value);
    }
  } catch (const InputError&) {  // the curve ends; the run may never reach such speeds
    fits = false;
  }
  if (!fits) c[0] = no_number;
}

// This loop is not vectorised, because gathering the coefficients would take longer than the polynomials.
SLIPFRONT_CLONES std::size_t evaluate(std::size_t size, const double* speed, const TabulatedCurve::Piece* pieces,
                                      std::uint64_t first, std::uint64_t count, double* value) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(speed[i]), piece = (bits >> bits_of_place) - first;
    const double t =
        2 * std::bit_cast<double>((bits << (52 - bits_of_place) & 0x000fffffffffffffu) | 0x3ff0000000000000u) - 3;
    value[i] = polynomial_by_pairs(pieces[piece < count ? piece : count].c, t);
    others += std::isnan(value[i]) ? 1u : 0u;
  }
  return others;
}

}  // namespace

TabulatedCurve::TabulatedCurve(Curve curve) : curve_(std::move(curve)), at_rest_(curve_(0)) {
  const ChebyshevFit<Piece::terms> through;
  for (std::uint64_t piece = piece_of(slowest_piece); piece < piece_of(fastest_piece); ++piece)
    fit(through, curve_, start_of(piece), start_of(piece + 1), pieces_.emplace_back().c);
  pieces_.push_back({{no_number}});
}

void TabulatedCurve::values(std::size_t size, const double* speed, double* value) const {
  const std::uint64_t count = pieces_.size() - 1;
  if (evaluate(size, speed, pieces_.data(), piece_of(slowest_piece), count, value) == 0) return;
  for (std::size_t i = 0; i < size; ++i)
    if (std::isnan(value[i])) value[i] = speed[i] == 0 ? at_rest_ : curve_(speed[i]);
}

namespace {

/// Whether the curve leaves rest as a power of w below 0.9.
bool rises_steeply(const Curve& curve) {
  const double near = curve ? curve(1e-10) : 0, far = curve ? curve(1e-8) : 0;
  return near > 0 && std::log(far / near) < 0.9 * std::log(100.0);
}

/// Looks forces up in a table, which is made when it is first needed.
class CurveLoops final : public ForceLoops {
 public:
  using ForceLoops::ForceLoops;
  void strengths(std::size_t size, const double* speed, LocalStates, double* force) const override {
    std::call_once(once_, [this] {
      table_ = std::make_unique<const TabulatedCurve>([this](double w) { return law_.strength(w, {}); });
    });
    table_->values(size, speed, force);
  }

 private:
  mutable std::once_flag once_;
  mutable std::unique_ptr<const TabulatedCurve> table_;
};

class DrawnCurve final : public Law {
 public:
  DrawnCurve(const std::vector<double>& values, const Curve& curve)
      : Law({.steep_at_rest = rises_steeply(curve)}), C_(values[0]), curve_(curve) {}
  double strength(double speed, LocalState) const override { return curve_ ? C_ * curve_(speed) : 0; }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }

 private:
  double C_;
  Curve curve_;
  CurveLoops loops_{*this};
  TabulatedAverage average_{*this};
};

/// The factor of the curve. 1 leaves the curve as it is.
Parameter factor() {
  Parameter parameter = coefficient_in(force_unit);
  parameter.value = 1;
  parameter.if_missing = {};
  return parameter;
}

}  // namespace

const Definition& formula_law() {
  static const Definition definition{.name = "formula",
                                     .adjective = "drawn",
                                     .equation = "f = C times a formula of w >= 0, with the sign of the slip velocity",
                                     .source = "the scenario",
                                     .parameters = {factor()},
                                     .curve = CurveSource::formula,
                                     .make = make_law<DrawnCurve>};
  return definition;
}

const Definition& table_law() {
  static const Definition definition{
      .name = "table",
      .adjective = "tabulated",
      .equation =
          "f = C times a monotone curve through the points (w, f) of a table, with the sign of the slip velocity",
      .source = "the scenario",
      .parameters = {factor()},
      .curve = CurveSource::table,
      .make = make_law<DrawnCurve>};
  return definition;
}

}  // namespace slipfront::friction
