#include "events/inference/sampling/evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "slipfront/theory/medium/medium.hpp"

namespace slipfront::inference {

using catalogue::MeasuredValue;

namespace {

/// Edges in standard deviations.
constexpr std::array<double, 17> fine = {-6,   -4.5, -3.3, -2.4, -1.7, -1.15, -0.7, -0.33, 0,
                                         0.33, 0.7,  1.15, 1.7,  2.4,  3.3,   4.5,  6};
constexpr std::array<double, 10> coarse = {-6, -3.3, -2, -1.1, -0.35, 0.35, 1.1, 2, 3.3, 6};
constexpr std::size_t tail_cells = 6;

std::span<const double> steps_of(Fineness fineness) {
  return fineness == Fineness::fine ? std::span<const double>(fine) : std::span<const double>(coarse);
}

void add_normal(std::vector<double>& edges, const MeasuredValue& m, double low, std::span<const double> steps) {
  for (const double z : steps) {
    const double x = m.low + z * (z < 0 && m.shape == MeasuredValue::Shape::split ? m.spread_below : m.spread);
    if (x > std::fmax(low, 1e-3 * m.low)) edges.push_back(std::log(x));
  }
  // The tail towards zero: cells that widen from a fifth of an e-fold to the rest.
  const double begin = edges.front(), length = begin - std::log(low);
  std::vector<double> tail;
  for (std::size_t i = 0; i < tail_cells; ++i) {
    const double share = static_cast<double>(tail_cells - i) / tail_cells;
    tail.push_back(begin - length * share * share);
  }
  edges.insert(edges.begin(), tail.begin(), tail.end());
}

/// Makes shares cumulative, to end at 1. Returns their sum.
double accumulate(const double* shares, std::size_t count, double* cumulative) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) cumulative[i] = sum += shares[i];
  for (std::size_t i = 0; i < count; ++i) cumulative[i] = sum > 0 ? cumulative[i] / sum : 1;
  return sum;
}

/// A cell, and a position from 0 to 1 within it.
struct Within {
  std::size_t cell;
  double share;  ///< share of the cell
  double position;
};
Within find(const double* cumulative, std::size_t count, double p) {
  const auto cell =
      std::min(static_cast<std::size_t>(std::upper_bound(cumulative, cumulative + count, p) - cumulative), count - 1);
  const double below = cell == 0 ? 0 : cumulative[cell - 1], share = cumulative[cell] - below;
  return {cell, share, share > 0 ? std::clamp((p - below) / share, 0.0, 1.0) : 0.5};
}

double value(const Axis& axis, const Within& w) {
  return axis.is_exact() ? axis.edges[0] : std::lerp(axis.edges[w.cell], axis.edges[w.cell + 1], w.position);
}

}  // namespace

Axis Axis::uniform(double low, double high, std::size_t cells) {
  Axis axis;
  for (std::size_t i = 0; i <= cells; ++i)
    axis.edges.push_back(std::lerp(low, high, static_cast<double>(i) / static_cast<double>(cells)));
  return axis;
}

Axis axis_of(const MeasuredValue& m, double low, double high, Fineness fineness) {
  const std::span<const double> steps = steps_of(fineness);
  if (m.is_exact()) return m.low >= low && m.low <= high ? Axis::exact(std::log(m.low)) : Axis{};
  std::vector<double> edges;
  if (m.shape == MeasuredValue::Shape::lognormal) {
    for (const double z : steps) edges.push_back(std::log(m.low) + std::log(m.spread) * z);
  } else if (m.shape == MeasuredValue::Shape::normal || m.shape == MeasuredValue::Shape::split) {
    add_normal(edges, m, low, steps);
  } else {
    const double from = std::fmax(m.low, low), to = std::fmin(m.high, high);
    if (!(from < to)) return {};
    edges = Axis::uniform(std::log(from), std::log(to), steps.size() - 1).edges;
  }
  const double least = std::log(low), most = std::log(high);
  if (!(edges.back() > least && edges.front() < most)) return {};
  for (double& edge : edges) edge = std::clamp(edge, least, most);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges.size() > 1 ? Axis{edges} : Axis{};
}

Cells::Cells(Axis first, Axis second, Axis third)
    : axes_{std::move(first), std::move(second), std::move(third)},
      share_(axes_[0].cells() * axes_[1].cells() * axes_[2].cells()) {}

Axis Cells::refined(std::size_t which, std::size_t cells) const {
  const Axis& axis = axes_[which];
  std::vector<double> mass(axis.cells());
  for (std::size_t i = 0, n = 0; i < axes_[0].cells(); ++i)
    for (std::size_t j = 0; j < axes_[1].cells(); ++j)
      for (std::size_t k = 0; k < axes_[2].cells(); ++k, ++n)
        mass[which == 0   ? i
             : which == 1 ? j
                          : k] += share_[n] * axes_[0].width(i) * axes_[1].width(j) * axes_[2].width(k);
  const double total = std::accumulate(mass.begin(), mass.end(), 0.0);
  const double length = axis.edges.back() - axis.edges.front();
  std::vector<double> cumulative = {0};
  for (std::size_t i = 0; i < mass.size(); ++i) {  // the neighbour of a cell with mass may have some too
    const double around = (i > 0 ? mass[i - 1] : 0) + (i + 1 < mass.size() ? mass[i + 1] : 0);
    cumulative.push_back(cumulative.back() + (0.6 * mass[i] + 0.1 * around) / total + 0.2 * axis.width(i) / length);
  }
  Axis refined;
  for (std::size_t i = 0, at = 0; i <= cells; ++i) {
    const double wanted = cumulative.back() * static_cast<double>(i) / static_cast<double>(cells);
    while (at + 2 < cumulative.size() && cumulative[at + 1] < wanted) ++at;
    const double s = (wanted - cumulative[at]) / (cumulative[at + 1] - cumulative[at]);
    refined.edges.push_back(std::lerp(axis.edges[at], axis.edges[at + 1], std::clamp(s, 0.0, 1.0)));
  }
  return refined;
}

void Cells::finish(double defence, const std::vector<double>& first_base, const std::vector<double>& third_base) {
  const std::size_t n0 = axes_[0].cells(), n1 = axes_[1].cells(), n2 = axes_[2].cells();
  double target = 0, base = 0;
  const auto each = [&](const auto& act) {
    for (std::size_t i = 0, n = 0; i < n0; ++i)
      for (std::size_t j = 0; j < n1; ++j)
        for (std::size_t k = 0; k < n2; ++k, ++n) {
          const double volume = axes_[0].width(i) * axes_[1].width(j) * axes_[2].width(k);
          act(share_[n], volume, first_base[i] * third_base[k] * volume);
        }
  };
  each([&](double share, double volume, double defensive) {
    target += share * volume;
    base += defensive;
  });
  each([&](double& share, double volume, double defensive) {
    share = (1 - defence) * share * volume / target + defence * defensive / base;
  });
  first_.resize(n0), second_.resize(n0 * n1), third_.resize(n0 * n1 * n2);
  std::vector<double> along(n1), sums(n0);
  for (std::size_t i = 0; i < n0; ++i) {
    for (std::size_t j = 0; j < n1; ++j)
      along[j] = accumulate(&share_[(i * n1 + j) * n2], n2, &third_[(i * n1 + j) * n2]);
    sums[i] = accumulate(along.data(), n1, &second_[i * n1]);
  }
  accumulate(sums.data(), n0, first_.data());
}

Cells::Point Cells::at(double p, double q, double r) const {
  const std::size_t n1 = axes_[1].cells(), n2 = axes_[2].cells();
  const Within i = find(first_.data(), axes_[0].cells(), p);
  const Within j = find(&second_[i.cell * n1], n1, q);
  const Within k = find(&third_[(i.cell * n1 + j.cell) * n2], n2, r);
  const double volume = axes_[0].width(i.cell) * axes_[1].width(j.cell) * axes_[2].width(k.cell);
  return {value(axes_[0], i), value(axes_[1], j), value(axes_[2], k), i.share * j.share * k.share / volume};
}

using catalogue::MeasuredValue;
using catalogue::Observation;
using catalogue::UncertainConstant;
using medium::Constants;

namespace {

double squared(double x) { return x * x; }

double squared_spread(const MeasuredValue* m) { return m && !m->is_exact() ? squared(log_spread(*m)) : 0; }

const MeasuredValue* uncertain_constant(const Observation& o, std::optional<double> Constants::*member) {
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member == member) return &c.measured;
  return nullptr;
}

/// Variance in ln that the uncertain elastic constants add to every observation, approximately.
double elastic_blur(const Observation& o) {
  double sum = 0;
  for (const UncertainConstant& c : o.uncertain_constants)
    if (c.member != &Constants::contact_ratio && c.member != &Constants::asperity_spacing)
      sum += squared(log_spread(c.measured));
  return sum;
}

}  // namespace

double log_spread(const MeasuredValue& m) {
  if (m.shape == MeasuredValue::Shape::lognormal) return std::log(m.spread);
  if (m.shape == MeasuredValue::Shape::normal) return m.spread / m.low;
  if (m.shape == MeasuredValue::Shape::split) return (m.spread + m.spread_below) / 2 / m.low;
  return m.is_exact() ? 0 : std::log(m.high / m.low) / std::sqrt(12.0);
}

double Evidence::spread() const { return std::hypot(log_spread(measured), blur); }

double Evidence::blurred_likelihood(double ln_x, double resolution, bool falls) const {
  const double more = std::hypot(blur, resolution);
  double z = 0;
  switch (measured.shape) {
    case MeasuredValue::Shape::lognormal:
      z = (ln_x - std::log(measured.low)) / std::hypot(std::log(measured.spread), more);
      break;
    case MeasuredValue::Shape::normal:
    case MeasuredValue::Shape::split: {
      const double x = std::exp(ln_x);
      const bool under = measured.shape == MeasuredValue::Shape::split && x < measured.low;
      // A value that is uncertain by a factor may be near the observed one, however small it is.
      const double blurred = more * (more > 1 ? std::fmax(x, measured.low) : x);
      z = (x - measured.low) / std::hypot(under ? measured.spread_below : measured.spread, blurred);
      if (falls && x > measured.low)
        z = std::fmax(z, (ln_x - std::log(measured.low)) / std::hypot(measured.spread / measured.low, more));
      break;
    }
    case MeasuredValue::Shape::range: {
      const double outside = std::fmax(std::log(measured.low) - ln_x, ln_x - std::log(measured.high));
      z = std::fmax(outside, 0.0) / std::fmax(more, 1e-6);
    }
  }
  return std::exp(-z * z / 2);
}

double Evidence::offset(const PulseState& p, double u, const Surroundings& around) const {
  switch (source) {
    case Source::slip:  // w = c A W / pi
      return std::log(medium::slip_velocity_unit(around.elastic.speed, 1) * p.W * around.slipping);
    case Source::contact:
      return 0;
    case Source::drop:  // mu A / pi times the share of Sigma- that was observed
      return std::log(medium::stress_unit(around.elastic.shear_modulus, 1) * p.stress * p.drop_share);
    case Source::strength:  // A = A_plastic normal stress / hardness
      return std::log(around.hardness / around.plastic);
    case Source::friction:  // C = Gamma b / (T c A)
      return std::log(std::expm1(u) * around.spacing / (around.duration * around.elastic.speed));
  }
  return 0;
}

void sort_by_precision(std::vector<Evidence>& evidence) {
  std::stable_sort(evidence.begin(), evidence.end(), [](const Evidence& a, const Evidence& b) {
    if (a.measured.is_exact() || b.measured.is_exact()) return a.measured.is_exact() && !b.measured.is_exact();
    return a.spread() < b.spread();
  });
}

std::vector<Evidence> evidence_of(const Observation& o) {
  std::vector<Evidence> all;
  const double elastic = elastic_blur(o);
  if (o.has_slip_velocity()) {
    const MeasuredValue& m = o.slip_velocity_m_s ? *o.slip_velocity_m_s : *o.slip;
    all.push_back({Source::slip, o.slip_velocity_m_s ? "slip_velocity" : "slip", m,
                   std::sqrt(elastic + squared_spread(o.slip_time()))});
  }
  if (o.contact_ratio) {
    const MeasuredValue* m = uncertain_constant(o, &Constants::contact_ratio);
    all.push_back({Source::contact, "contact_ratio", m ? *m : MeasuredValue{*o.contact_ratio, *o.contact_ratio}, 0});
  }
  if (o.stress_drop) all.push_back({Source::drop, "stress_drop", *o.stress_drop, std::sqrt(elastic)});
  if (o.normal_stress && o.hardness)
    all.push_back({Source::strength, "normal_stress", *o.normal_stress, std::sqrt(squared_spread(&*o.hardness))});
  if (o.friction_coefficient && o.asperity_spacing && o.damping_time()) {
    const double blur = elastic + squared_spread(o.damping_time()) +
                        squared_spread(uncertain_constant(o, &Constants::asperity_spacing));
    all.push_back({Source::friction, "friction_coefficient", *o.friction_coefficient, std::sqrt(blur)});
  }
  sort_by_precision(all);
  return all;
}

}  // namespace slipfront::inference
