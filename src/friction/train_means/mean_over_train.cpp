#include "friction/train_means/mean_over_train.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/simd/elementary.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/error.hpp"

// The averages of any law, from its force.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "friction/train_means/mean_over_train.hpp"
#include "math/roots.hpp"
#include "math/simd/vector_code.hpp"
#include "slipfront/math/elliptic.hpp"

namespace slipfront::friction {
namespace {

double mean_of(double a, double b) {  // arithmetic-geometric
  for (int i = 0; i < 12 && std::fabs(a - b) > 1e-9 * a; ++i) {
    const double next = (a + b) / 2;
    b = std::sqrt(a * b);
    a = next;
  }
  return a;
}

/// n with exp(-2 pi n K' / K) below 1e-13: the error of a mean over slip is up to a thousand times that, as for f = w.
std::size_t steps_for(double s) {
  const double K_over_K1 = mean_of(1, std::sqrt((1 - s) * (1 + s))) / mean_of(1, s);
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(4.8 * K_over_K1)), 3, PhaseNodes::most_steps);
}

/// Numbers of steps that are used, and the smallest s for which each is enough.
struct StepCounts {
  static constexpr std::array<std::size_t, PhaseNodes::kinds> steps{
      3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 64, PhaseNodes::most_steps};
  std::array<double, steps.size()> least_s;
  StepCounts() {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const auto is_enough = [&](double log_s) { return steps_for(std::exp(log_s)) <= steps[i]; };
      least_s[i] = std::exp(bisected({.holding = 0, .failing = std::log(PhaseNodes::least_s)}, is_enough, 40).holding);
    }
    least_s.back() = 0;
  }
  /// The first that is enough for this s.
  std::size_t of(double s) const {
    std::size_t i = 0;
    while (s < least_s[i]) ++i;
    return i;
  }
};
const StepCounts& step_counts() {
  static const StepCounts counts;
  return counts;
}

// One transformation takes the modulus k to k1 = (1 - k') / (1 + k'), with k1' = 2 k'^(1/2) / (1 + k') nearer to 1, and
// dn = (dn1^2 - (1 - k1)) / (1 + k1 - dn1^2). With S = sin^2 of the last angle, and common factors taken out:
//     D3 = 1 + k3 S,  d2 = D3^2 + c2 S,  r = (d2^2 - c1 S D3^2) / (d2^2 + c1 S D3^2).
SLIPFRONT_CLONES void coefficients(std::size_t size, const double* s, double* k3, double* c2, double* c1) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double s0 = s[i] > PhaseNodes::least_s ? s[i] : PhaseNodes::least_s;
    const double s1 = 2 * std::sqrt(s0) / (1 + s0), s2 = 2 * std::sqrt(s1) / (1 + s1);
    const double root1 = (1 - std::sqrt(s0)) / (1 + std::sqrt(s0)), root2 = (1 - std::sqrt(s1)) / (1 + std::sqrt(s1));
    const double k1 = (1 - s0) / (1 + s0), k2 = root1 * root1;  // (1 - s1) / (1 + s1) without cancellation
    const double w1 = 1 / ((1 + s1) * (1 + s1)), w2 = 1 / ((1 + s2) * (1 + s2));
    k3[i] = root2 * root2;
    c2[i] = 4 * k2 * w2;
    c1[i] = 16 * k1 * w1 * w2;
  }
}

SLIPFRONT_CLONES void nodes(std::size_t size, double S, const double* k3, const double* c2, const double* c1,
                            bool over_slip, double share, double* r, double* weight) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double D = 1 + k3[i] * S, q = D * D, d = q + c2[i] * S, d2 = d * d, e = c1[i] * S * q;
    const double root = std::sqrt(1 - k3[i] * k3[i] * S), below = d2 + e, inverse = 1 / (below * root);  // one for two
    const double ratio = (d2 - e) * (root * inverse);
    r[i] = ratio;
    weight[i] = share * (over_slip ? ratio : 1.0) * (below * inverse);
  }
}

SLIPFRONT_CLONES void add(std::size_t size, const double* weight, const double* f, double* sum, double* weights) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    sum[i] += weight[i] * f[i];
    weights[i] += weight[i];
  }
}

}  // namespace

std::size_t PhaseNodes::kind_of(double s) { return step_counts().of(s); }

PhaseNodes::PhaseNodes(std::size_t size, const double* s) : size_(size), steps_(3) {
  double least = 1;
  for (std::size_t i = 0; i < size; ++i) least = s[i] < least ? s[i] : least;
  steps_ = StepCounts::steps[kind_of(least)];
  const double angle = std::numbers::pi / 2 / static_cast<double>(steps_), c = std::cos(angle), d = std::sin(angle);
  double sine = 0, cosine = 1;
  for (std::size_t k = 0; k <= steps_; ++k) {
    squared_sine_[k] = sine * sine;
    const double turned = cosine * c - sine * d;
    sine = sine * c + cosine * d;
    cosine = turned;
  }
  coefficients(size, s, third_, second_, first_);
}

void PhaseNodes::node(std::size_t k, Closure closure, double* r, double* weight) const {
  nodes(size_, squared_sine_[k], third_, second_, first_, closure == Closure::consistent,
        k == 0 || k == steps_ ? 0.5 : 1.0, r, weight);
}

void means_by_phase(const ForceLoops& loops, const Trains& trains, Closure closure, double* mean) {
  constexpr std::size_t most = PhaseNodes::most;
  double r[most], weight[most], speed[most], force[most], weights[most];
  std::size_t size = 0;
  for (std::size_t begin = 0; begin < trains.size; begin += size) {
    const std::size_t kind = PhaseNodes::kind_of(trains.s[begin]), end = std::min(begin + most, trains.size);
    for (size = 1; begin + size < end && PhaseNodes::kind_of(trains.s[begin + size]) == kind;) ++size;
    const LocalStates states = trains.states.from(begin);
    const PhaseNodes nodes(size, trains.s + begin);
    std::fill_n(mean + begin, size, 0.0);
    std::fill_n(weights, size, 0.0);
    for (std::size_t k = 0; k < nodes.count(); ++k) {
      nodes.node(k, closure, r, weight);
      for (std::size_t i = 0; i < size; ++i) speed[i] = trains.fastest[begin + i] * r[i];
      loops.strengths(size, speed, states, force);
      add(size, weight, force, mean + begin, weights);
    }
    for (std::size_t i = 0; i < size; ++i) mean[begin + i] /= weights[i];
  }
}

namespace {

using std::numbers::pi;

/// From the mean force, with P / k = 8 sinh phi cosh psi E / 2 pi.
class RateByQuadrature final : public RelaxationRate {
 public:
  RateByQuadrature(const TrainAverage& average, Closure closure) : average_(average), closure_(closure) {}
  double operator()(const State& train, double contact, LocalState state) const override {
    if (train.empty()) return 0;
    const double phi = train.phi == 0 ? 1e-8 * std::fmin(train.psi, 1.0) : std::fabs(train.phi);  // the limit at rest
    const double momentum = 8 * contact * std::sinh(phi) * std::cosh(train.psi) * elliptic::at_psi(train.psi).E;
    return 2 * pi * average_.mean_strength({phi, train.psi}, contact, closure_, state) / momentum;
  }

 private:
  const TrainAverage& average_;
  Closure closure_;
};

}  // namespace

void RelaxationRate::rates(std::size_t size, const double* fastest, const double* psi, double* rate) const {
  for (std::size_t i = 0; i < size; ++i)
    rate[i] = (*this)({std::asinh(fastest[i] / (2 * std::cosh(psi[i]))), psi[i]}, 1, {});
}

double QuadratureAverage::mean_strength(const State& train, double contact, Closure closure, LocalState state) const {
  if (const auto constant = law_.facts().constant_strength) return *constant;
  const double fastest = 2 * contact * std::sinh(std::fabs(train.phi)) * std::cosh(train.psi);
  // <f>_u = 1 / (2 pi) integral of f(w(u)) du over a turn; with the paper's closure the mean is over x.
  return mean_over_train(std::tanh(train.psi), closure, {},
                         [&](double r) { return law_.strength(fastest * r, state); });
}

std::unique_ptr<RelaxationRate> QuadratureAverage::relaxation_rate(Closure closure) const {
  return std::make_unique<RateByQuadrature>(*this, closure);
}

void QuadratureAverage::mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const {
  if (const auto constant = law_.facts().constant_strength) {
    std::fill_n(mean, trains.size, *constant);
    if (slope != nullptr) std::fill_n(slope, trains.size, 0.0);
    return;
  }
  constexpr double least_s = 1e-6;  // the mean over length of emptier trains takes many more phases
  double most_empty = 1;
  for (std::size_t i = 0; i < trains.size; ++i) most_empty = std::fmin(most_empty, trains.s[i]);
  if (closure == Closure::consistent || most_empty > least_s) {
    means_by_phase(law_.loops(), trains, closure, mean);
  } else {
    for (std::size_t i = 0; i < trains.size; ++i) {
      const double psi = std::atanh(std::fmin(trains.s[i], 1 - 1e-16));
      const double phi = std::asinh(trains.fastest[i] / (2 * std::cosh(psi)));
      mean[i] = mean_strength({phi, psi}, 1, closure, trains.states.at(i));
    }
  }
  if (slope == nullptr) return;
  constexpr double step = 1e-6;
  thread_local std::vector<double> faster;  // kept between calls, so that steps allocate nothing
  faster.resize(trains.size);
  for (std::size_t i = 0; i < trains.size; ++i) faster[i] = trains.fastest[i] * std::exp(step);
  // By quadrature too: the difference to a mean from a table would be the error of the table.
  QuadratureAverage::mean_strengths({trains.size, faster.data(), trains.s, trains.states}, closure, slope, nullptr);
  for (std::size_t i = 0; i < trains.size; ++i) slope[i] = (slope[i] - mean[i]) / step;
}

namespace {

constexpr std::size_t patch_terms = ChebyshevPatch::terms;
constexpr double side = 0.25;                             ///< size of a patch in ln(fastest) and in ln s
constexpr double first_row = -138.5, first_column = -14;  ///< logarithms at which the patches begin
constexpr std::size_t rows = 571, columns = 56;           ///< they end at ln(fastest) = 4.25 and s = 1
constexpr double slowest = 1e-60, fastest_of_all = 64, least_s = 1e-6,
                 largest_s = 0.9999999;  ///< limits, inside the patches
constexpr double precision = 2e-11;      ///< largest relative error of a mean

/// Positions of at most `most` trains in the table.
struct Positions {
  static constexpr std::size_t most = PhaseNodes::most;
  double row[most], column[most];  ///< -1 outside the table
  double x[most], y[most];         ///< -1 to 1 across the patch
  const ChebyshevPatch* patch[most];
  double mean[most], slope[most];
};

SLIPFRONT_CLONES void find_positions(std::size_t size, const double* fastest, const double* s, Positions& at) {
  constexpr double per_side = 1 / side;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const bool inside = (fastest[i] > slowest) & (fastest[i] < fastest_of_all) & (s[i] > least_s) & (s[i] < largest_s);
    const double row = (log_branch_free(inside ? fastest[i] : 1.0) - first_row) * per_side;
    const double column = (log_branch_free(inside ? s[i] : 0.5) - first_column) * per_side;
    const int whole_row = static_cast<int>(row), whole_column = static_cast<int>(column);
    at.x[i] = 2 * (row - whole_row) - 1;
    at.y[i] = 2 * (column - whole_column) - 1;
    at.row[i] = inside ? whole_row : -1.0;
    at.column[i] = whole_column;
  }
}

/// Interpolates for one train after the other, because gathering coefficients for many trains would take longer.
SLIPFRONT_CLONES void interpolate_all(std::size_t size, Positions& at) {
  for (std::size_t i = 0; i < size; ++i) {
    const ValueAndSlope found = interpolate(*at.patch[i], at.x[i], at.y[i]);
    at.mean[i] = found.value;
    at.slope[i] = found.by_x * (2 / side);
  }
}

/// Computes the means of trains at `count` points of a patch. `node(i)` gives the coordinates of point i, from -1 to 1.
template <std::size_t count, class Node>
void means_at(const ForceLoops& loops, std::size_t row, std::size_t column, const Node& node, double* mean) {
  double fastest[count], s[count];
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y] = node(i);
    fastest[i] = std::exp(first_row + (static_cast<double>(row) + (1 + x) / 2) * side);
    s[i] = std::fmin(std::exp(first_column + (static_cast<double>(column) + (1 + y) / 2) * side), 1.0);
  }
  means_by_phase(loops, {count, fastest, s, {}}, Closure::consistent, mean);
}

struct Node {
  double x, y;
};

}  // namespace

TabulatedAverage::Patch TabulatedAverage::made(std::size_t row, std::size_t column) const {
  using Fit = ChebyshevPatch::Fit;
  static const Fit through;
  Patch patch{};
  ChebyshevPatch::Values values;
  means_at<patch_terms * patch_terms>(
      law_.loops(), row, column,
      [](std::size_t i) {
        return Node{Fit::extremum(i / patch_terms), Fit::extremum(i % patch_terms)};
      },
      &values[0][0]);
  patch.polynomial.fit(through, values);
  // Check the polynomial between the nodes, along both diagonals.
  constexpr std::size_t between = 2 * (patch_terms - 1);
  const auto node = [](std::size_t i) {
    const std::size_t pair = i / 2;
    const double x = std::cos(std::numbers::pi * (static_cast<double>(pair) + 0.5) / (patch_terms - 1));
    return Node{x, i % 2 == 0 ? x : -x};
  };
  double mean[between];
  means_at<between>(law_.loops(), row, column, node, mean);
  patch.good = true;
  for (std::size_t i = 0; i < between; ++i) {
    const double found = interpolate(patch.polynomial, node(i).x, node(i).y).value;
    patch.good = patch.good && std::fabs(found - mean[i]) <= precision * std::fabs(mean[i]);
  }
  return patch;
}

const ChebyshevPatch* TabulatedAverage::good_patch(std::size_t row, std::size_t column) const {
  const auto if_good = [](const Patch* known) { return known->good ? &known->polynomial : nullptr; };
  std::atomic<const Patch*>& entry = patches_[row * columns + column];
  if (const Patch* known = entry.load(std::memory_order_acquire)) return if_good(known);
  Patch found{};
  try {
    found = made(row, column);
  } catch (const InputError&) {  // the curve ends; quadrature reports the speed if a train reaches it
    found.good = false;
  }
  const std::lock_guard<std::mutex> lock(making_);
  if (entry.load(std::memory_order_relaxed) == nullptr)
    entry.store(&all_.emplace_back(found), std::memory_order_release);
  return if_good(entry.load(std::memory_order_relaxed));
}

void TabulatedAverage::mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const {
  if (closure != Closure::consistent) return QuadratureAverage::mean_strengths(trains, closure, mean, slope);
  static constexpr ChebyshevPatch none{};
  std::call_once(once_, [this] { patches_ = std::vector<std::atomic<const Patch*>>(rows * columns); });
  Positions at;
  thread_local std::vector<std::size_t> others;  // reused, so that steps allocate nothing
  others.clear();
  for (std::size_t begin = 0; begin < trains.size; begin += Positions::most) {
    const std::size_t some = std::min(Positions::most, trains.size - begin);
    find_positions(some, trains.fastest + begin, trains.s + begin, at);
    for (std::size_t i = 0; i < some; ++i) {
      at.patch[i] = at.row[i] < 0
                        ? nullptr
                        : good_patch(static_cast<std::size_t>(at.row[i]), static_cast<std::size_t>(at.column[i]));
      if (at.patch[i] != nullptr) continue;
      others.push_back(begin + i);
      at.patch[i] = &none;
    }
    interpolate_all(some, at);
    std::copy_n(at.mean, some, mean + begin);
    if (slope != nullptr) std::copy_n(at.slope, some, slope + begin);
  }
  if (others.empty()) return;
  thread_local std::vector<double> fastest, s, means, slopes;
  fastest.clear();
  s.clear();
  means.resize(others.size());
  slopes.resize(others.size());
  for (const std::size_t i : others) {
    fastest.push_back(trains.fastest[i]);
    s.push_back(trains.s[i]);
  }
  QuadratureAverage::mean_strengths({others.size(), fastest.data(), s.data(), {}}, Closure::consistent, means.data(),
                                    slope == nullptr ? nullptr : slopes.data());
  for (std::size_t i = 0; i < others.size(); ++i) {
    mean[others[i]] = means[i];
    if (slope != nullptr) slope[others[i]] = slopes[i];
  }
}

}  // namespace slipfront::friction
