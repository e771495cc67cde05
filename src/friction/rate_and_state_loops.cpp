#include "friction/rate_and_state_loops.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "foundation/simd/elementary.hpp"
#include "foundation/simd/vector_code.hpp"
#include "friction/asinh_mean_table.hpp"
#include "friction/train_means.hpp"

namespace slipfront::friction {
namespace {

constexpr std::size_t lanes = 8;
constexpr double tiny = 1e-300;        ///< speeds and theta below it count as it
constexpr double most_exponent = 300;  ///< of G: asinh(x) is taken from x below 1e150

inline double at_least(double x, double least) { return x > least ? x : least; }
inline double at_most(double x, double most) { return x < most ? x : most; }

inline double exponent(const RateAndStateRule& r, double theta) {
  return r.base + r.share * log_branch_free(at_least(theta, tiny));
}

/// asinh(exp(log_x)), and x over (1 + x^2)^(1/2) as `slope`.
struct AsinhOfExp {
  double value, slope;
  explicit AsinhOfExp(double log_x) {
    const double x = exp_branch_free(at_least(at_most(log_x, 200.0), -650.0)), root = std::sqrt(1 + x * x);
    value = log_x < 20 ? asinh_branch_free(x, root) : log_x + 0.69314718055994531;
    slope = x / root;
  }
};

}  // namespace

SLIPFRONT_CLONES bool forces(const RateAndStateRule& rule, std::size_t size, const double* speed, const double* theta,
                             double* force) {
  const RateAndStateRule r = rule;
  std::size_t beyond = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double E = exponent(r, theta[j]);
    const double x = at_most(speed[j] * exp_branch_free(at_most(at_least(E, -most_exponent), most_exponent)), 1e150);
    force[j] = r.a * asinh_branch_free(x, std::sqrt(1 + x * x));
    beyond += std::fabs(E) < most_exponent ? 0u : 1u;
  }
  return beyond == 0;
}

bool within_exponents(const RateAndStateRule& rule, double theta) {
  return std::fabs(rule.base + rule.share * std::log(theta)) < most_exponent - 1;
}

namespace {

constexpr std::size_t together = 64;  ///< places
/// Squares of less would be subnormal, which takes processors a hundred times longer; below it all is linear.
constexpr double slowest = 1e-100;

/// Where solves stand.
struct Solves {
  double s[together];  ///< asinh(G v)
  double G[together];
  double late[together];  ///< 1 where there is more to do, else 0
};

/// v + d asinh(G v) = F, with s = asinh(G v): F / c = sinh s + (d / c) s, c = 1 / G. s is asinh(F G) less delta, with
///     R sinh(delta) + d delta - F (cosh(delta) - 1) = d asinh(F G),    R = (F^2 + c^2)^(1/2),
/// whose solution is a series in delta_1 = d asinh(F G) / (R + d). Returns whether that was enough for all places.
/// In short loops over at most `together` places, of which a processor has many turns under way at once: in one long
/// loop each operation would wait for the one before it.
SLIPFRONT_CLONES bool by_series(const RateAndStateRule& rule, std::size_t size, const double* free, double weight,
                                const double* theta, double* speed, double* s, double* G_out, double* late) {
  const RateAndStateRule r = rule;
  const double d = weight * r.a, per_d = 1 / d;
  double root[together], step_at[together], inverse_at[together];
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) G_out[j] = exponent(r, theta[j]);
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j)
    G_out[j] = exp_branch_free(at_most(at_least(G_out[j], -most_exponent), most_exponent));
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double x = at_least(at_least(free[j], slowest) * G_out[j], slowest);
    root[j] = std::sqrt(1 + x * x);
  }
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double G = G_out[j], x = at_least(at_least(free[j], slowest) * G, slowest), slowed = root[j] + d * G;
    const LogRatio ratio = asinh_ratio(x, root[j]);
    const double both = 1 / (ratio.below * slowed);                                     // one division for two
    const double s0 = 2 * ratio.half_log(both * slowed), inverse = both * ratio.below;  // times G: over R + d
    s[j] = s0;
    inverse_at[j] = inverse;
    step_at[j] = d * G * s0 * inverse;
  }
  std::size_t more = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    constexpr double least_step = 1e-30;
    const double F = at_least(free[j], slowest), x = at_least(F * G_out[j], slowest);
    const double s0 = s[j], inverse = inverse_at[j], step = step_at[j], k = x * inverse, p = root[j] * inverse;
    const double k2 = k * k;
    const double b3 = k2 / 2 - p / 6, b4 = k * (5.0 / 8 * k2 - 5.0 / 12 * p + 1.0 / 24),
                 b5 = k2 * (7.0 / 8 * k2 - 7.0 / 8 * p + 1.0 / 8) + p * (p * (1.0 / 12) - 1.0 / 120);
    const double delta = step + step * step * (k / 2 + step * (b3 + step * (b4 + step * b5)));
    const double v = F - d * (s0 - delta), shown = at_least(step, least_step), step3 = shown * shown * shown;
    const bool fine = (d * step3 * step3 <= 3e-16 * v) & (v >= F / 2) & (step <= s0 / 2);
    const double scaled = v * at_most(free[j] * (1 / slowest), 1.0), solved = s0 - delta, most = at_most(s0, F * per_d);
    speed[j] = fine ? scaled : 0.0;
    s[j] = step < 0.2 ? solved : most;
    late[j] = fine ? 0.0 : 1.0;
    more += fine ? 0u : 1u;
  }
  return more == 0;
}

/// A step of Newton's method in s, from above the root or near it: the left side is convex. Returns whether any place
/// is late after it.
SLIPFRONT_CLONES bool newton_step(double d, std::size_t size, const double* free, double* speed, double* s,
                                  const double* G, double* late) {
  std::size_t more = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double F = at_least(free[j], slowest), at = s[j], half = 0.5 / G[j];
    const double up = expm1_branch_free(at_least(at_most(at, 650.0), 0.0)), down = up / (1 + up);
    const double v = half * (up + down), slope = half * (2 + up - down);
    const double step = (v + d * at - F) / (slope + d), next = at - step;
    // The difference has the digits where friction is weak, the speed itself, taken on to `next`, where it is strong.
    const double rest = F - d * next, moved = v - step * (slope - step / 2 * v);
    const bool waits = late[j] != 0, near = std::fabs(step) <= 1e-8 * at;
    const double found = (rest > F / 2 ? rest : moved) * (free[j] < slowest ? free[j] * (1 / slowest) : 1.0);
    speed[j] = (waits & near) ? found : speed[j];
    s[j] = waits ? next : at;
    late[j] = (waits & !near) ? 1.0 : 0.0;
    more += (waits & !near) ? 1u : 0u;
  }
  return more != 0;
}

SLIPFRONT_CLONES bool find_done(std::size_t size, const double* G, const double* late, double* done) {
  std::size_t others = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const bool found = (late[j] == 0) & (G[j] > 1e-129) & (G[j] < 1e129);
    done[j] = found ? 1.0 : 0.0;
    others += found ? 0u : 1u;
  }
  return others == 0;
}

}  // namespace

bool speeds_after(const RateAndStateRule& rule, std::size_t size, const double* free, double weight,
                  const double* theta, double* speed, double* done) {
  Solves at;  // size <= together
  if (!by_series(rule, size, free, weight, theta, speed, at.s, at.G, at.late)) {
    constexpr int most_steps = 40;
    for (int i = 0; i < most_steps; ++i)
      if (!newton_step(weight * rule.a, size, free, speed, at.s, at.G, at.late)) break;
  }
  return find_done(size, at.G, at.late, done);
}

namespace {

constexpr double short_step = 1.0 / 16;  ///< of the slip over D_c

/// Steps in which places slip little, to 1e-17; returns whether all did. The others are left.
SLIPFRONT_CLONES bool age_little(std::size_t size, const double* velocity, double per_D, double time, double* theta) {
  constexpr double c[] = {1.0,        -1.0 / 2,   1.0 / 6,      -1.0 / 24,    1.0 / 120,
                          -1.0 / 720, 1.0 / 5040, -1.0 / 40320, 1.0 / 362880, -1.0 / 3628800};
  std::size_t others = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(velocity[j]) * per_D;
    const bool little = p < short_step;
    theta[j] += little ? polynomial(c, little ? p : 0.0) * (time - p * theta[j]) : 0.0;
    others += little ? 0u : 1u;
  }
  return others == 0;
}

SLIPFRONT_CLONES void age_much(std::size_t size, const double* velocity, double per_D, double time, double* theta) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(velocity[j]) * per_D;
    const double decay = exp_branch_free(-at_most(p, 650.0));
    theta[j] = p < short_step ? theta[j] : theta[j] * decay + time * ((1 - decay) / p);
  }
}

}  // namespace

void advance_ageing(const RateAndStateRule& rule, std::size_t size, const double* velocity, double time,
                    double* theta) {
  const double per_D = time / rule.D;
  for (std::size_t j = 0; j < size; j += together) {
    const std::size_t some = std::min(together, size - j);
    if (!age_little(some, velocity + j, per_D, time, theta + j)) age_much(some, velocity + j, per_D, time, theta + j);
  }
}

SLIPFRONT_CLONES void advance_by_slip(const RateAndStateRule& rule, std::size_t size, const double* mean,
                                      const double* typical, double time, double* theta) {
  const double per_D = 1 / rule.D;
  SLIPFRONT_INDEPENDENT
  for (std::size_t j = 0; j < size; ++j) {
    const double p = std::fabs(mean[j]) * time * per_D, x = std::fabs(typical[j]) * theta[j] * per_D;
    const double change = log_branch_free(at_least(x, tiny)) * expm1_branch_free(-at_most(p, 650.0));
    theta[j] *= p > 0 && x > 0 ? exp_branch_free(at_most(at_least(change, -650.0), 650.0)) : 1.0;
  }
}

namespace {

constexpr double logarithmic_from = 16;  ///< A s; AsinhMeanTable::largest_As is more

/// Of trains: A, with asinh(A) the force over a at the largest slip velocity, and how the mean of asinh(A r) over slip
/// is found.
struct Amplitudes {
  double log_A[PhaseNodes::most], A[PhaseNodes::most];                ///< A between e^-650 and e^300
  double logarithmic[PhaseNodes::most], tabulated[PhaseNodes::most];  ///< 1 or 0
  std::size_t count_logarithmic = 0, count_tabulated = 0;
};

SLIPFRONT_CLONES void find_amplitudes(const RateAndStateRule& rule, std::size_t size, const double* fastest,
                                      const double* s, const double* theta, Amplitudes& at) {
  const RateAndStateRule r = rule;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) at.log_A[i] = exponent(r, theta[i]);
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) at.log_A[i] += log_branch_free(at_least(fastest[i], tiny));
  std::size_t logarithmic = 0, tabulated = 0;
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double A = exp_branch_free(at_least(at_most(at.log_A[i], 300.0), -650.0));
    const bool large = A * s[i] >= logarithmic_from;
    const bool in_table = !large & (s[i] >= AsinhMeanTable::least_s) & (s[i] <= AsinhMeanTable::largest_s);
    at.A[i] = A;
    at.logarithmic[i] = large ? 1.0 : 0.0;
    at.tabulated[i] = in_table ? 1.0 : 0.0;
    logarithmic += large ? 1u : 0u;
    tabulated += in_table ? 1u : 0u;
  }
  at.count_logarithmic = logarithmic;
  at.count_tabulated = tabulated;
}

/// The mean of asinh(A r) over slip where A s is large: ln A + ln(1 + s), as <ln r> = ln((1 + s) / 2), and the next
/// terms of asinh(x) = ln 2x + 1 / 4 x^2 - 3 / 32 x^4 + 5 / 96 x^6, with <r^-2> = 1 / s and so on.
SLIPFRONT_CLONES void logarithmic_means(double a, std::size_t size, const Amplitudes& amplitudes, const double* s,
                                        double* mean, double* slope) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    const double at = s[i], s2 = at * at, p = at * amplitudes.A[i], q = 1 / at_least(p * p, 1.0);
    const double c4 = 3.0 / 64 * (1 + s2), c6 = 5.0 / 768 * (3 + 2 * s2 + 3 * s2 * s2);
    mean[i] = a * (amplitudes.log_A[i] + log_branch_free(1 + at) + at * q * (0.25 - q * (c4 - q * c6)));
    slope[i] = a * (1 - at * q * (0.5 - q * (4 * c4 - q * 6 * c6)));
  }
}

SLIPFRONT_CLONES void add_asinh(std::size_t size, const double* log_A, const double* r, const double* weight,
                                double* sum, double* slopes, double* weights) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) {
    // A is at most 16 / s.
    const double x = exp_branch_free(at_least(log_A[i], -650.0)) * r[i], root = std::sqrt(1 + x * x);
    sum[i] += weight[i] * asinh_branch_free(x, root);
    slopes[i] += weight[i] * (x / root);
    weights[i] += weight[i];
  }
}

/// Where it is not large, in a table.
void means_by_table(double a, std::size_t size, const double* log_A, const double* A, const double* s, double* mean,
                    double* slope) {
  AsinhMeanTable::get().look_up(size, log_A, A, s, mean, slope);
  for (std::size_t i = 0; i < size; ++i) {
    mean[i] *= a;
    slope[i] *= a;
  }
}

/// Means by quadrature where A is not large, of at most PhaseNodes::most trains of one kind.
void means_by_quadrature(double a, std::size_t size, const double* log_A, const double*, const double* s, double* mean,
                         double* slope) {
  constexpr std::size_t most = PhaseNodes::most;
  double r[most], weight[most], weights[most] = {};
  const PhaseNodes nodes(size, s);
  std::fill_n(mean, size, 0.0);
  std::fill_n(slope, size, 0.0);
  for (std::size_t k = 0; k < nodes.count(); ++k) {
    nodes.node(k, Closure::consistent, r, weight);
    add_asinh(size, log_A, r, weight, mean, slope, weights);
  }
  for (std::size_t i = 0; i < size; ++i) {
    mean[i] *= a / weights[i];
    slope[i] *= a / weights[i];
  }
}

/// Some of at most PhaseNodes::most trains, whose means are found together.
struct Some {
  std::size_t count = 0;
  std::size_t place[PhaseNodes::most];
  double log_A[PhaseNodes::most], A[PhaseNodes::most], s[PhaseNodes::most];

  void add(std::size_t i, double log_A_there, double A_there, double s_there) {
    place[count] = i;
    log_A[count] = log_A_there;
    A[count] = A_there;
    s[count++] = s_there;
  }
  template <class Means>
  void find(const Means& means, double a, double* mean, double* slope) {
    if (count == 0) return;
    while (count % lanes != 0) add(place[count - 1], log_A[count - 1], A[count - 1], s[count - 1]);  // whole vectors
    double some_mean[PhaseNodes::most], some_slope[PhaseNodes::most];
    means(a, count, log_A, A, s, some_mean, some_slope);
    for (std::size_t i = 0; i < count; ++i) {
      mean[place[i]] = some_mean[i];
      slope[place[i]] = some_slope[i];
    }
  }
};

}  // namespace

void mean_forces(const RateAndStateRule& rule, std::size_t size, const double* fastest, const double* s,
                 const double* theta, double* mean, double* slope) {
  constexpr std::size_t most = PhaseNodes::most;
  Amplitudes at;
  double slopes[most];
  for (std::size_t begin = 0; begin < size; begin += most) {
    const std::size_t n = std::min(most, size - begin);
    find_amplitudes(rule, n, fastest + begin, s + begin, theta + begin, at);
    if (at.count_tabulated == n) {
      means_by_table(rule.a, n, at.log_A, at.A, s + begin, mean + begin, slopes);
    } else {
      if (at.count_logarithmic > 0) logarithmic_means(rule.a, n, at, s + begin, mean + begin, slopes);
      Some tabulated;
      std::array<Some, PhaseNodes::kinds> others;
      for (std::size_t i = 0; i < n && at.count_logarithmic < n; ++i)
        if (at.logarithmic[i] == 0)
          (at.tabulated[i] != 0 ? tabulated : others[PhaseNodes::kind_of(s[begin + i])])
              .add(i, at.log_A[i], at.A[i], s[begin + i]);
      tabulated.find(means_by_table, rule.a, mean + begin, slopes);
      for (Some& some : others) some.find(means_by_quadrature, rule.a, mean + begin, slopes);
    }
    if (slope != nullptr) std::copy_n(slopes, n, slope + begin);
  }
}

}  // namespace slipfront::friction
