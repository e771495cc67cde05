#include "averages/pulse/time/integrators.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "averages/pulse/grid/cells.hpp"
#include "math/simd/vector_code.hpp"

namespace slipfront::pulse {

Ssprk54::Ssprk54(std::size_t size) {
  for (auto* array : {&u1_, &u2_, &u3_, &u4_, &rate1_, &rate2_, &rate3_, &rate4_}) array->resize(size);
}

void Ssprk54::operator()(const Rates& f, double t, double dt, std::vector<double>& y, const std::vector<double>& k0) {
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

double Ssprk54::error(double dt, const std::vector<double>& k0, const std::vector<double>& scale,
                      const std::vector<double>& excluded) const {
  // Weights of the five rates that leave the conditions up to third order as they are; scaled so that for y' = lambda y
  // the solutions differ by a fifth of the fourth-order term, (lambda dt)^4 / 120.
  constexpr double weight[5] = {-0.033284360230608954, 0.14257333261087404, -0.2147007757724523, 0.06207336170042002,
                                0.04333844169176721};
  double sum = 0;
  for (std::size_t cell = 0; cell < excluded.size(); ++cell)
    for (const std::size_t i : {cell, excluded.size() + cell}) {
      const double difference = (weight[0] * k0[i] + weight[1] * rate1_[i] + weight[2] * rate2_[i] +
                                 weight[3] * rate3_[i] + weight[4] * rate4_[i]) /
                                scale[i];
      sum += (1 - excluded[cell]) * difference * difference;
    }
  const double error = dt * std::sqrt(sum / static_cast<double>(scale.size()));
  return std::isfinite(error) ? error : HUGE_VAL;
}

bool Ssprk54::returns_to_zero(std::size_t i, double before) const {
  const auto returns = [before](double u, double rate) { return before * u < 0 && before * rate > 0; };
  return returns(u1_[i], rate1_[i]) || returns(u2_[i], rate2_[i]) || returns(u3_[i], rate3_[i]) ||
         returns(u4_[i], rate4_[i]);
}

double Ssprk54::largest_rate(std::size_t i) const {
  return std::max({std::fabs(rate1_[i]), std::fabs(rate2_[i]), std::fabs(rate3_[i]), std::fabs(rate4_[i])});
}

namespace {

constexpr std::size_t stages = 4;
/// At which time, in steps, and from which rates the stages come: column 0 is the start.
constexpr double at[stages] = {0.5, 2.0 / 3, 0.5, 1};
constexpr double by_rates[stages][stages] = {
    {1.0 / 2}, {11.0 / 18, 1.0 / 18}, {5.0 / 6, -5.0 / 6, 1.0 / 2}, {1.0 / 4, 7.0 / 4, 3.0 / 4, -7.0 / 4}};
/// And from which friction: column 0 is the first stage.
constexpr double by_friction[stages][stages] = {
    {1.0 / 2}, {1.0 / 6, 1.0 / 2}, {-1.0 / 2, 1.0 / 2, 1.0 / 2}, {3.0 / 2, -3.0 / 2, 1.0 / 2, 1.0 / 2}};

/// Force of friction that leaves `momentum` of `free` in a time, from 1 over that time; returns the power that it
/// takes.
SLIPFRONT_CLONES double take_friction(std::size_t size, const double* free, const double* momentum,
                                      const double* velocity, double per_time, double* friction) {
  SLIPFRONT_INDEPENDENT
  for (std::size_t i = 0; i < size; ++i) friction[i] = (free[i] - momentum[i]) * per_time;
  return reduce(
      size, 0, [=](std::size_t i) { return friction[i] * velocity[i]; }, [](double a, double b) { return a + b; });
}

}  // namespace

Ars443::Ars443(std::size_t cells, std::size_t size)
    : cells_(cells),
      rates_(stages, std::vector<double>(size)),
      friction_(stages, std::vector<double>(cells + 1)),
      stage_(size),
      midpoint_(size),
      free_(cells),
      momentum_(cells),
      velocity_(cells),
      mean_off_(cells) {}

void Ars443::operator()(const Rates& f, const Friction& friction, double t, double dt, std::vector<double>& y,
                        const std::vector<double>& rate_at_start) {
  before_ = y;
  rates_[0] = rate_at_start;
  mean_off_.assign(cells_, 0.0);
  const auto add_to_mean = [&](double weight, const double* momentum) {
    for (std::size_t cell = 0; cell < cells_; ++cell) mean_off_[cell] += weight * momentum[cell];
  };
  constexpr double trapezoidal = 0.5;
  add_to_mean(by_rates[stages - 1][0] - trapezoidal, before_.data() + cells_);
  std::array<const double*, 1 + stages> y_and_rates, y_and_friction;  // as far as they are known; with weight 0 else
  y_and_rates.fill(before_.data());
  y_and_friction.fill(stage_.data());
  for (std::size_t k = 0; k < stages; ++k) {
    std::array<double, 1 + stages> by_stage{1}, taken{1};
    for (std::size_t j = 0; j <= k; ++j) by_stage[1 + j] = dt * by_rates[k][j];
    for (std::size_t j = 0; j < k; ++j) taken[1 + j] = -dt * by_friction[k][j];
    y_and_rates[1 + k] = rates_[k].data();
    combine5(stage_.size(), by_stage, y_and_rates, stage_.data());
    const Values values(stage_.data(), cells_);
    const double time = dt * by_friction[k][k];
    y_and_friction[0] = values.momenta();
    combine5(cells_, taken, y_and_friction, free_.data());
    friction(stage_.data(), free_.data(), time, momentum_.data(), velocity_.data());
    friction_[k][cells_] =
        take_friction(cells_, free_.data(), momentum_.data(), velocity_.data(), 1 / time, friction_[k].data());
    std::copy_n(momentum_.data(), cells_, values.momenta());
    y_and_friction[1 + k] = friction_[k].data();
    for (std::size_t j = 0; j <= k; ++j) values.dissipated() += dt * by_friction[k][j] * friction_[j][cells_];
    add_to_mean(k + 1 < stages ? by_rates[stages - 1][k + 1] : -trapezoidal, momentum_.data());
    if (k + 1 < stages) f(t + at[k] * dt, stage_.data(), rates_[k + 1].data());
  }
  combine3(midpoint_.size(), {1, dt, 0}, {before_.data(), rates_[1].data(), before_.data()}, midpoint_.data());
  const Values values(midpoint_.data(), cells_);
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    values.momentum(cell) -= dt * friction_[0][cell];
    // Friction stops a cell but does not throw it back, as the midpoint rule has it where a cell comes to rest.
    if (momentum_[cell] == 0 || std::signbit(values.momentum(cell)) != std::signbit(momentum_[cell]))
      values.momentum(cell) = 0;
  }
  y = stage_;
}

double Ars443::error(const std::vector<double>& y, const std::vector<double>& scale,
                     const std::vector<double>& excluded, const std::vector<double>& friction_times) const {
  double sum = 0;
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    const std::size_t i = cells_ + cell;
    const double width = (y[cell] - midpoint_[cell]) / scale[cell];
    const double full = std::fabs(y[i] - midpoint_[i]), times = 1 + friction_times[cell],
                 damped = full / (times * times);
    const double momentum = std::fmin(full, std::fmax(damped, std::fabs(mean_off_[cell]))) / scale[i];
    sum += (1 - excluded[cell]) * (width * width + momentum * momentum);
  }
  const double error = std::sqrt(sum / static_cast<double>(2 * cells_));
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

Rodas4::Rodas4(std::size_t cells, std::size_t size, std::size_t reach, bool depends_on_time)
    : cells_(cells),
      unknowns_(2 * cells),
      size_(size),
      reach_(reach),
      stride_(2 * reach + 1),
      depends_on_time_(depends_on_time) {
  jacobian_.resize(unknowns_ * stride_);
  lu_.resize(unknowns_ * stride_);
  positions_.resize(unknowns_);
  positions_before_.resize(unknowns_);
  for (auto* array : {&by_time_, &work_, &rate_}) array->resize(size_);
  for (auto& u : u_) u.resize(size_);
}

void Rodas4::to_positions(const std::vector<double>& y) {
  double position = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    positions_[2 * i] = position += y[i];
    positions_[2 * i + 1] = y[cells_ + i];
  }
}

void Rodas4::to_widths(std::vector<double>& y) const {
  double before = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    y[i] = positions_[2 * i] - before;
    y[cells_ + i] = positions_[2 * i + 1];
    before = positions_[2 * i];
  }
}

/// Change of entry j of the banded order by which rates are differentiated.
double Rodas4::nudge(std::size_t j, const std::vector<double>& y, const std::vector<double>& scale, double slow) const {
  constexpr double small = 1e-7;
  const std::size_t i = in_y(j);
  if (is_position(j)) return small * (i + 1 == cells_ ? scale[i] : std::fmin(scale[i], scale[i + 1]));
  if (!(slow > 0)) return small * scale[i];
  const double size = std::fabs(y[i]), tangent = small * std::fmax(size, slow * scale[i]);
  const bool to_rest = size < slow * scale[i] && size > tangent;
  return to_rest ? -y[i] : std::copysign(tangent, y[i]);  // to the other side in a mirror
}

void Rodas4::linearise(const Rates& f, double t, const std::vector<double>& y, const std::vector<double>& rate,
                       const std::vector<double>& scale, double slow) {
  std::fill(jacobian_.begin(), jacobian_.end(), 0.0);
  to_positions(rate);
  positions_before_ = positions_;
  const std::size_t period = stride_;  // columns so far apart share no row
  for (std::size_t first = 0; first < std::min(period, unknowns_); ++first) {
    work_ = y;
    for (std::size_t j = first; j < unknowns_; j += period) {
      const double step = nudge(j, y, scale, slow);
      work_[in_y(j)] += step;
      if (is_position(j) && j + 2 < unknowns_) work_[in_y(j + 2)] -= step;
    }
    f(t, work_.data(), rate_.data());
    to_positions(rate_);
    for (std::size_t j = first; j < unknowns_; j += period) {
      const double step = work_[in_y(j)] - y[in_y(j)];
      const std::size_t low = j > reach_ ? j - reach_ : 0, high = std::min(unknowns_, j + reach_ + 1);
      for (std::size_t i = low; i < high; ++i) entry(jacobian_, i, j) = (positions_[i] - positions_before_[i]) / step;
    }
  }
}

void Rodas4::factorise(double diagonal) {  // diagonal dominance comes from 1 / (gamma dt): no pivoting
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

void Rodas4::solve(std::vector<double>& b) {
  const auto entry = [this](std::size_t i, std::size_t j) { return lu_[i * stride_ + (j + reach_ - i)]; };
  to_positions(b);
  for (std::size_t i = 0; i < unknowns_; ++i)
    for (std::size_t j = i > reach_ ? i - reach_ : 0; j < i; ++j) positions_[i] -= entry(i, j) * positions_[j];
  for (std::size_t i = unknowns_; i-- > 0;) {
    for (std::size_t j = i + 1; j < std::min(unknowns_, i + reach_ + 1); ++j)
      positions_[i] -= entry(i, j) * positions_[j];
    positions_[i] /= entry(i, i);
  }
  to_widths(b);
}

/// df/dt. The difference in time is large, as rates at rest are small differences of large forces. No run begins before
/// t = 0, and a forcing need not be defined there: near it the difference is one of second order to one side.
void Rodas4::differentiate_by_time(const Rates& f, double t, double dt, const std::vector<double>& y,
                                   const std::vector<double>& rate_at_start) {
  const double nudge = 1e-3 * dt;
  const bool centred = t >= nudge;
  f(t + nudge, y.data(), by_time_.data());
  f(centred ? t - nudge : t + 2 * nudge, y.data(), rate_.data());
  for (std::size_t i = 0; i < unknowns_; ++i)
    by_time_[i] = (centred ? by_time_[i] - rate_[i] : 4 * by_time_[i] - rate_[i] - 3 * rate_at_start[i]) / (2 * nudge);
}

StepAttempt Rodas4::operator()(const Rates& f, double t, double dt, const std::vector<double>& y,
                               const std::vector<double>& rate_at_start, const Tolerance& tolerance,
                               std::vector<double>& next) {
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
  for (std::size_t i = 0; i < unknowns_; ++i) next[i] += u_[5][i];
  const StepAttempt made = attempt(dt, tolerance, next);
  add_sums(f, t, dt, y, rate_at_start, next);
  return made;
}

/// The last stage is the difference between the two solutions of the method. The position of the left edge has the
/// errors of what is next to it.
StepAttempt Rodas4::attempt(double dt, const Tolerance& tolerance, const std::vector<double>& next) const {
  const double of_momentum = std::fmax(1 / (1 + tolerance.friction_rate * dt), 0.05);
  const auto error = [&](std::size_t i) {
    return u_[5][i] / (tolerance.relative * std::fmax(tolerance.scale[i], std::fabs(next[i])));
  };
  double sum = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    const double width = i == 0 ? 0 : error(i), momentum = error(cells_ + i);
    sum += width * width;
    sum += of_momentum * of_momentum * momentum * momentum;
  }
  const double mean = std::sqrt(sum / static_cast<double>(unknowns_ - 1));
  return {.succeeded = std::isfinite(mean), .error = mean};
}

void Rodas4::add_sums(const Rates& f, double t, double dt, const std::vector<double>& y,
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
