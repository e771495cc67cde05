// The averages of any law, from its force.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "friction/train_means/mean_over_train.hpp"
#include "friction/train_means/phase_nodes.hpp"
#include "slipfront/elliptic/complete.hpp"

namespace slipfront::friction {
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

}  // namespace slipfront::friction
