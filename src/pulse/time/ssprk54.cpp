#include "pulse/time/ssprk54.hpp"

#include <algorithm>
#include <cmath>

#include "foundation/simd/combine.hpp"

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

}  // namespace slipfront::pulse
