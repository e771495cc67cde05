#include "pulse/time/time_step.hpp"

#include <algorithm>
#include <cmath>

#include "foundation/text/digits.hpp"
#include "pulse/space/kernels.hpp"
#include "slipfront/pulse/named_values.hpp"

namespace slipfront::pulse {

NumericsError too_strong_forces(double time) {
  return NumericsError("t = " + digits(time) +
                       ": the time step failed: the forces on a cell exceed what any step can resolve");
}

bool cells_jump(const std::vector<double>& before, const std::vector<double>& after,
                const std::vector<double>& charge) {
  for (std::size_t i = 0; i < charge.size(); ++i) {
    const double was = before[Values::momentum_at(i)], is = after[Values::momentum_at(i)];
    if (std::fabs(is - was) > 4 * charge[i] + std::fabs(was) / 2) return true;
    if (charge[i] > 0 && !(after[Values::width_at(i)] > before[Values::width_at(i)] / 10)) return true;
  }
  return false;
}

ExplicitStep::ExplicitStep(std::size_t size) {
  for (auto* array : {&u1_, &u2_, &u3_, &u4_, &rate1_, &rate2_, &rate3_, &rate4_}) array->resize(size);
}

void ExplicitStep::operator()(const Rates& f, double t, double dt, std::vector<double>& y,
                              const std::vector<double>& k0) {
  const std::size_t n = y.size();
  const double *u1 = u1_.data(), *u2 = u2_.data(), *u3 = u3_.data(), *u4 = u4_.data();
  const double *y0 = y.data(), *k1 = rate1_.data(), *k2 = rate2_.data(), *k3 = rate3_.data(), *k4 = rate4_.data();
  combine3(n, {1, 0.391752226571890 * dt, 0}, {y0, k0.data(), y0}, u1_.data());
  f(t + 0.391752226571890 * dt, u1, rate1_.data());
  combine3(n, {0.444370493651235, 0.555629506348765, 0.368410593050371 * dt}, {y0, u1, k1}, u2_.data());
  f(t + 0.586079689311540 * dt, u2, rate2_.data());
  combine3(n, {0.620101851488403, 0.379898148511597, 0.251891774271694 * dt}, {y0, u2, k2}, u3_.data());
  f(t + 0.474542363121399 * dt, u3, rate3_.data());
  combine3(n, {0.178079954393132, 0.821920045606868, 0.544974750228521 * dt}, {y0, u3, k3}, u4_.data());
  f(t + last_stage * dt, u4, rate4_.data());
  combine5(n, {0.517231671970585, 0.096059710526147, 0.063692468666290 * dt, 0.386708617503268, 0.226007483236906 * dt},
           {u2, u3, k3, u4, k4}, y.data());
}

double ExplicitStep::error(double dt, const std::vector<double>& k0, const std::vector<double>& scale,
                           const std::vector<double>& excluded) const {
  // Weights of the five rates that leave the conditions up to third order as they are; scaled so that for y' = lambda y
  // the solutions differ by a fifth of the fourth-order term, (lambda dt)^4 / 120.
  constexpr double weight[5] = {-0.033284360230608954, 0.14257333261087404, -0.2147007757724523, 0.06207336170042002,
                                0.04333844169176721};
  double sum = 0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    const double difference = (weight[0] * k0[i] + weight[1] * rate1_[i] + weight[2] * rate2_[i] +
                               weight[3] * rate3_[i] + weight[4] * rate4_[i]) /
                              scale[i];
    sum += (1 - excluded[i / 2]) * difference * difference;
  }
  const double error = dt * std::sqrt(sum / static_cast<double>(scale.size()));
  return std::isfinite(error) ? error : HUGE_VAL;
}

namespace {

// Rodas4 in the form that needs no product with the Jacobian: row i holds a_ij and c_ij.
constexpr double gamma_diagonal = 0.25;
constexpr double a[6][5] = {{},
                            {1.544000000000000},
                            {0.9466785280815826, 0.2557011698983284},
                            {3.314825187068521, 2.896124015972201, 0.9986419139977817},
                            {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
                            {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1}};
constexpr double c[6][5] = {
    {},
    {-5.668800000000000},
    {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
constexpr double alpha[6] = {0, 0.386, 0.21, 0.63, 1, 1};
constexpr double gamma[6] = {0.25, -0.1043, 0.1035, -0.03620000000000023, 0, 0};

/// Dense output: y(t + h theta) = (1 - theta) y0 + theta (y1 + (1 - theta) (D2 + theta D3)), third order.
constexpr double d2[5] = {10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823,
                          1.025137723295662};
constexpr double d3[5] = {-0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386,
                          -6.594389125716872};

}  // namespace

ImplicitStep::ImplicitStep(std::size_t pairs, std::size_t size, std::size_t reach, bool depends_on_time)
    : unknowns_(2 * pairs), size_(size), reach_(reach), stride_(2 * reach + 1), depends_on_time_(depends_on_time) {
  jacobian_.resize(unknowns_ * stride_);
  lu_.resize(unknowns_ * stride_);
  places_.resize(unknowns_);
  for (auto* array : {&by_time_, &work_, &rate_}) array->resize(size_);
  for (auto& u : u_) u.resize(size_);
}

void ImplicitStep::to_places(const std::vector<double>& y) {
  double place = 0;
  for (std::size_t i = 0; i < unknowns_; i += 2) {
    places_[i] = place += y[i];
    places_[i + 1] = y[i + 1];
  }
}

void ImplicitStep::to_widths(std::vector<double>& y) const {
  double before = 0;
  for (std::size_t i = 0; i < unknowns_; i += 2) {
    y[i] = places_[i] - before;
    y[i + 1] = places_[i + 1];
    before = places_[i];
  }
}

void ImplicitStep::linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                             const std::vector<double>& scale, double slow) {
  std::fill(jacobian_.begin(), jacobian_.end(), 0.0);
  to_places(rate);
  places_before_ = places_;
  constexpr double small = 1e-7;
  const std::size_t last = unknowns_ - 2;  // the last place
  const auto nudge = [&](std::size_t j) {
    if (j % 2 == 1 && slow > 0) {
      const double size = std::fabs(y[j]), tangent = small * std::fmax(size, slow * scale[j]);
      const bool to_rest = size < slow * scale[j] && size > tangent;
      return to_rest ? -y[j] : std::copysign(tangent, y[j]);  // to the other side in a mirror
    }
    if (j % 2 == 1) return small * scale[j];
    return small * (j == last ? scale[j] : std::fmin(scale[j], scale[j + 2]));
  };
  const std::size_t period = stride_;  // columns so far apart share no row
  for (std::size_t first = 0; first < std::min(period, unknowns_); ++first) {
    work_ = y;
    for (std::size_t j = first; j < unknowns_; j += period) {
      const double step = nudge(j);
      work_[j] += step;
      if (j % 2 == 0 && j < last) work_[j + 2] -= step;
    }
    f(t, work_.data(), rate_.data());
    to_places(rate_);
    for (std::size_t j = first; j < unknowns_; j += period) {
      const double step = work_[j] - y[j];
      const std::size_t low = j > reach_ ? j - reach_ : 0, high = std::min(unknowns_, j + reach_ + 1);
      for (std::size_t i = low; i < high; ++i) entry(jacobian_, i, j) = (places_[i] - places_before_[i]) / step;
    }
  }
}

void ImplicitStep::factorise(double diagonal) {  // diagonal dominance comes from 1 / (gamma dt): no pivoting
  for (std::size_t k = 0; k < jacobian_.size(); ++k) lu_[k] = -jacobian_[k];
  for (std::size_t i = 0; i < unknowns_; ++i) entry(lu_, i, i) += diagonal;
  for (std::size_t k = 0; k < unknowns_; ++k) {
    const std::size_t end = std::min(unknowns_, k + reach_ + 1);
    const double inverse = 1 / entry(lu_, k, k);
    for (std::size_t i = k + 1; i < end; ++i) {
      double& l = entry(lu_, i, k);
      if (l == 0) continue;
      l *= inverse;
      double* row = &entry(lu_, i, k);
      const double* pivot = &entry(lu_, k, k);
      for (std::size_t j = 1; j < end - k; ++j) row[j] -= l * pivot[j];
    }
  }
}

void ImplicitStep::solve(std::vector<double>& b) {
  const auto at = [this](std::size_t i, std::size_t j) { return lu_[i * stride_ + (j + reach_ - i)]; };
  to_places(b);
  for (std::size_t i = 0; i < unknowns_; ++i)
    for (std::size_t j = i > reach_ ? i - reach_ : 0; j < i; ++j) places_[i] -= at(i, j) * places_[j];
  for (std::size_t i = unknowns_; i-- > 0;) {
    for (std::size_t j = i + 1; j < std::min(unknowns_, i + reach_ + 1); ++j) places_[i] -= at(i, j) * places_[j];
    places_[i] /= at(i, i);
  }
  to_widths(b);
}

/// df/dt. The difference in time is large, as rates at rest are small differences of large forces. No run begins before
/// t = 0, and a forcing need not be defined there: near it the difference is one of second order to one side.
void ImplicitStep::differentiate_by_time(const Rates& f, double t, double dt, const std::vector<double>& y,
                                         const std::vector<double>& rate_at_start) {
  const double nudge = 1e-3 * dt;
  const bool centred = t >= nudge;
  f(t + nudge, y.data(), by_time_.data());
  f(centred ? t - nudge : t + 2 * nudge, y.data(), rate_.data());
  for (std::size_t i = 0; i < unknowns_; ++i)
    by_time_[i] = (centred ? by_time_[i] - rate_[i] : 4 * by_time_[i] - rate_[i] - 3 * rate_at_start[i]) / (2 * nudge);
}

double ImplicitStep::operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                                const std::vector<double>& rate_at_start, const std::vector<double>& scale,
                                double friction_rate, double tolerance, std::vector<double>& next) {
  factorise(1 / (gamma_diagonal * dt));
  if (depends_on_time_) differentiate_by_time(f, t, dt, y, rate_at_start);
  for (std::size_t stage = 0; stage < 6; ++stage) {
    next = y;
    for (std::size_t j = 0; j < stage; ++j)
      for (std::size_t i = 0; i < unknowns_; ++i) next[i] += a[stage][j] * u_[j][i];
    f(t + alpha[stage] * dt, next.data(), rate_.data());
    std::vector<double>& u = u_[stage];
    for (std::size_t i = 0; i < unknowns_; ++i) u[i] = rate_[i] + gamma[stage] * dt * by_time_[i];
    for (std::size_t j = 0; j < stage; ++j)
      for (std::size_t i = 0; i < unknowns_; ++i) u[i] += c[stage][j] / dt * u_[j][i];
    solve(u);
  }
  const double of_momentum = std::fmax(1 / (1 + friction_rate * dt), 0.05);
  double sum = 0;
  for (std::size_t i = 0; i < unknowns_; ++i) {
    next[i] += u_[5][i];
    if (i == 0) continue;  // the place of the left edge has the errors of what is beside it
    const double error = u_[5][i] / (tolerance * std::fmax(scale[i], std::fabs(next[i])));
    sum += i % 2 == 1 ? of_momentum * of_momentum * error * error : error * error;
  }
  add_sums(f, t, dt, y, rate_at_start, next);
  const double error = std::sqrt(sum / static_cast<double>(unknowns_ - 1));
  return std::isfinite(error) ? error : HUGE_VAL;
}

void ImplicitStep::add_sums(const Rates& f, double t, double dt, const std::vector<double>& y,
                            const std::vector<double>& rate_at_start, std::vector<double>& next) {
  for (std::size_t i = 0; i < unknowns_; ++i) {
    double correction = 0;
    for (std::size_t j = 0; j < 5; ++j) correction += (d2[j] + d3[j] / 2) * u_[j][i];
    work_[i] = (y[i] + next[i]) / 2 + correction / 4;
  }
  f(t + dt / 2, work_.data(), rate_.data());
  std::vector<double>& rate_at_end = u_[0];  // no longer needed
  f(t + dt, next.data(), rate_at_end.data());
  for (std::size_t i = unknowns_; i < size_; ++i)
    next[i] = y[i] + dt / 6 * (rate_at_start[i] + 4 * rate_[i] + rate_at_end[i]);
}

}  // namespace slipfront::pulse
