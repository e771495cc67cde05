#include "slipfront/theory/rupture/trains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "math/digits.hpp"
#include "math/interpolation.hpp"
#include "slipfront/error.hpp"
#include "slipfront/math/elliptic.hpp"
#include "theory/rupture/band_differentials.hpp"

namespace slipfront::rupture {
namespace {

using std::numbers::pi;

constexpr double least_width = 1e-303, most_spread = 80;

void check_bands(const FilledBands& bands, bool zero_allowed) {
  const auto refuse = [](double value, const char* key, std::string allowed) {
    return InputError({.key = key,
                       .value = digits(value),
                       .problem = "not a state that the averages of several trains exist for",
                       .allowed = std::move(allowed)});
  };
  double total = 0;
  for (const double width : bands.widths) {
    if (!((zero_allowed && width == 0) || width >= least_width))
      throw refuse(width, "width",
                   (zero_allowed ? "0, or " : "") + digits(least_width) + " ... " + digits(most_spread));
    total += width;
  }
  if (bands.widths.size() % 2 == 0)
    throw refuse(static_cast<double>(bands.widths.size()), "number of widths", "an odd number: band, gap, ... band");
  if (!(total <= most_spread)) throw refuse(total, "sum of the widths", "at most " + digits(most_spread));
  if (!(std::fabs(bands.centre) <= most_spread))
    throw refuse(bands.centre, "centre", "-" + digits(most_spread) + " ... " + digits(most_spread));
}

/// The speed tanh(centre + atanh(v)) of what moves at v in the frame of the centre.
double boosted(double v, double centre) {
  const double frame = std::tanh(centre);
  return (v + frame) / (1 + v * frame);
}

/// A band of this width, times the range, has the speed of its limit: the difference is of the order of the width.
constexpr double as_good_as_empty = 1e-30;

/// The bands that have a width. Bands that touch are one band, and a band without width is part of the gap around it.
struct OpenBands {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Position {
    std::size_t band = none;  ///< none: in a gap
    double from_low = 0;
  };
  std::vector<double> widths;
  std::vector<Position> at;  ///< the position of each given edge
  double shift = 0;          ///< added to the centre of the given bands
};

OpenBands open_bands(const std::vector<double>& widths) {
  OpenBands open;
  open.at.resize(widths.size() + 1);
  double gap = 1;            // since the last band with a width
  std::size_t touching = 0;  // the edges from here on are at the lower edge of the next band
  double outside = 0;        // from the lowest edge to the first band with a width
  for (std::size_t low = 0; low < widths.size(); low += 2) {
    if (low > 0) {
      gap += widths[low - 1];
      outside += open.widths.empty() ? widths[low - 1] : 0;
      if (widths[low - 1] > 0) touching = low;
    }
    if (widths[low] == 0 && gap > 0) continue;
    if (gap > 0) {
      if (!open.widths.empty()) open.widths.push_back(gap);
      open.widths.push_back(0);
    } else {
      touching = low;
    }
    const std::size_t band = open.widths.size() / 2;
    for (std::size_t j = touching; j <= low; ++j) open.at[j] = {band, open.widths.back()};
    open.at[low + 1] = {band, open.widths.back() += widths[low]};
    gap = 0;
    touching = low + 2;
  }
  open.shift = (outside - gap) / 2;
  return open;
}

/// A sum whose terms add up to `size` without their signs. It is 0 where the terms of mirrored trains cancel to
/// rounding.
double without_rounding(double sum, double size) {
  return std::fabs(sum) <= 4 * std::numeric_limits<double>::epsilon() * size ? 0 : sum;
}

}  // namespace

std::vector<double> FilledBands::edges() const {
  double total = 0;
  for (const double width : widths) total += width;
  std::vector<double> edges(widths.size() + 1);
  double below = 0;
  edges[0] = centre - total / 2;
  for (std::size_t i = 0; i < widths.size(); ++i) edges[i + 1] = centre + ((below += widths[i]) - total / 2);
  return edges;
}

FilledBands bands_of_edges(std::span<const double> edges) {
  FilledBands bands;
  if (edges.empty()) return bands;
  bands.centre = edges.front() / 2 + edges.back() / 2;
  for (std::size_t i = 1; i < edges.size(); ++i) bands.widths.push_back(edges[i] - edges[i - 1]);
  return bands;
}

FilledBands bands_of_train(const State& train) { return {train.phi, {2 * train.psi}}; }

std::vector<double> edge_speeds(const FilledBands& bands) {
  check_bands(bands, true);
  double total = 0;
  for (const double width : bands.widths) total += width;
  std::vector<double> speeds(bands.widths.size() + 1);
  const OpenBands open = open_bands(bands.widths);
  if (!open.widths.empty()) {
    const BandDifferentials at(open.widths);
    for (std::size_t j = 0; j < speeds.size(); ++j) {
      const auto [band, from_low] = open.at[j];
      if (band == OpenBands::none) continue;
      const double v = from_low == 0                       ? at.speed(2 * band)
                       : from_low == open.widths[2 * band] ? at.speed(2 * band + 1)
                                                           : at.speed_inside(band, from_low);
      speeds[j] = boosted(v, bands.centre + open.shift);
    }
  }
  // A band without width contains one dislocation among the others.
  for (std::size_t i = 0; i < bands.widths.size(); i += 2) {
    if (open.at[i].band != OpenBands::none) continue;
    std::vector<double> widths = bands.widths;
    widths[i] = as_good_as_empty * (total > 0 ? total : 1);
    const OpenBands with_one = open_bands(widths);
    const double v = BandDifferentials(with_one.widths).speed(2 * with_one.at[i].band);
    speeds[i] = speeds[i + 1] = boosted(v, bands.centre + with_one.shift);
  }
  return speeds;
}

BandAverages averages(const FilledBands& bands) {
  check_bands(bands, false);
  const BandDifferentials at(bands.widths);
  BandAverages result{};
  for (std::size_t j = 0; j <= bands.widths.size(); ++j) result.speeds.push_back(boosted(at.speed(j), bands.centre));
  // Under a boost, (k, omega), (I, J) are vectors and H, P, Q are the components of a tensor.
  const double c = std::cosh(bands.centre), s = std::sinh(bands.centre);
  double P = 0, H = 0, Q = 0, size_of_P = 0, size_of_W = 0;
  const GapIntegrals gaps = at.over_gaps();
  for (std::size_t i = 0; i < bands.trains(); ++i) {
    const BandIntegrals band = at.over_band(i);
    double p = 0, w = 0;
    for (std::size_t m = 0; m <= bands.trains(); ++m) {
      p += m <= i ? gaps.p[m] : -gaps.p[m];
      w += m <= i ? gaps.w[m] : -gaps.w[m];
    }
    const double I = 2 / pi * p, J = 2 / pi * w;
    result.trains.push_back({c * band.dp + s * band.dw, c * band.dw + s * band.dp, c * I + s * J, c * J + s * I});
    result.k += result.trains.back().k;
    result.W += result.trains.back().omega;
    size_of_W += std::fabs(result.trains.back().omega);
    result.squared_rate += result.trains.back().omega * result.trains.back().I;
    P += 4 / pi * band.sinh_dp;
    size_of_P += 4 / pi * std::fabs(band.sinh_dp);
    H += 4 / pi * band.cosh_dp;
    Q += 4 / pi * band.sinh_dw;
  }
  P = without_rounding(P, size_of_P);
  result.W = without_rounding(result.W, size_of_W);
  result.P = (c * c + s * s) * P + c * s * (H + Q);
  result.H = c * c * H + 2 * c * s * P + s * s * Q;
  result.Q = s * s * H + 2 * c * s * P + c * c * Q;
  return result;
}

BandDerivatives derivatives(const FilledBands& bands) {
  check_bands(bands, false);
  const BandDifferentials at(bands.widths);
  const std::vector<std::vector<double>> normal = at.normal_differentials();
  const double c = std::cosh(bands.centre), s = std::sinh(bands.centre);
  BandDerivatives result;
  for (std::size_t j = 0; j <= bands.widths.size(); ++j) {
    const EdgeStrength edge = at.strength(j);
    const double side = j % 2 == 0 ? -1 : 1;
    const double dp = c * edge.p + s * edge.w;
    result.speeds.push_back(boosted(at.speed(j), bands.centre));
    result.H.push_back(side * 4 * dp * dp);
    result.k.emplace_back();
    for (std::size_t i = 0; i < bands.trains(); ++i) result.k.back().push_back(side * dp * normal[j][i]);
  }
  return result;
}

namespace {

/// The changes of one train: the spacing l stays, and M_t = 2 pi F - C M (Eq. 7 for one dislocation). l = 2 K / (cosh
/// phi cosh psi) and M = 8 sinh phi cosh psi E.
std::vector<double> sources_of_train(const State& train, double load, double viscosity) {
  const double c = std::cosh(train.phi), s = std::sinh(train.phi);
  if (train.psi < least_width) {
    const double phi_t = (2 * pi * load - viscosity * 8 * s) / (8 * c);
    return {phi_t, phi_t};
  }
  const elliptic::AtPsi at = elliptic::at_psi(train.psi);
  const double tall = std::cosh(train.psi);
  const double psi_per_phi = (s / c) / (elliptic::log_slope_of_K(at) - at.s);  // at constant l
  const double M_per_phi = 8 * tall * (c * at.E + s * at.s * at.K * psi_per_phi);
  const double phi_t = (2 * pi * load - viscosity * 8 * s * tall * at.E) / M_per_phi;
  return {phi_t - psi_per_phi * phi_t, phi_t + psi_per_phi * phi_t};
}

/// The changes of two trains: the numbers of both trains, P and H give four linear equations, Eq. (9.11).
std::vector<double> sources_of_two(const FilledBands& bands, double load, double viscosity) {
  const BandDerivatives d = derivatives(bands);
  const BandAverages now = averages(bands);
  constexpr std::size_t n = 4;
  std::vector<double> matrix(n * n), change(n), largest(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double column[n] = {d.k[j][0], d.k[j][1], d.speeds[j] * d.H[j], d.H[j]};
    for (const double value : column) largest[j] = std::fmax(largest[j], std::fabs(value));
    for (std::size_t i = 0; i < n; ++i) matrix[i * n + j] = column[i] / largest[j];
  }
  change = {0, 0, load * now.k - viscosity * now.P, load * now.W - viscosity * now.squared_rate};
  solve_linear(std::move(matrix), {&change});
  for (std::size_t j = 0; j < n; ++j) change[j] /= largest[j];
  return change;
}

}  // namespace

std::vector<double> edge_sources(const FilledBands& bands, double load, double viscosity) {
  check_bands(bands, true);
  if (bands.trains() == 1) return sources_of_train({bands.centre, bands.widths[0] / 2}, load, viscosity);
  if (bands.trains() > 2)
    throw InputError({.key = "number of trains",
                      .value = digits(static_cast<double>(bands.trains())),
                      .problem = "the effect of friction and load on three or more trains is not known",
                      .allowed = "1 or 2"});
  constexpr double least_share = 1e-7;
  const double total = bands.widths[0] + bands.widths[1] + bands.widths[2];
  if (total == 0) return std::vector<double>(4, sources_of_train({bands.centre, 0}, load, viscosity)[0]);
  FilledBands open = bands;
  for (double& width : open.widths) width = std::fmax(width, least_share * total);
  return sources_of_two(open, load, viscosity);
}

}  // namespace slipfront::rupture
