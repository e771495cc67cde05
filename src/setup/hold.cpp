#include "setup/hold.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "slipfront/elliptic/complete.hpp"
#include "slipfront/train/train.hpp"

namespace slipfront::setup {
namespace {

/// (4 / pi)(a cosh(psi) E - 1) of the train at rest at x: less 1 throughout, so that slow trains lose no digits.
double balance(const scenario::Scenario& s, double x) {
  const double a = s.contact_at ? s.contact_at(x) : 1, stress = s.stress(x);
  double rest = 0;  // cosh(psi) E - 1
  if (stress >= train::smallest_stress * a) {
    const double psi = train::psi_of_stress(stress / a), half = std::sinh(psi / 2);
    const double cosh_rest = 2 * half * half, E_rest = elliptic::at_psi(psi).E_rest;
    rest = cosh_rest + E_rest + cosh_rest * E_rest;
  }
  return 4 / std::numbers::pi * (a - 1 + a * rest);
}

/// A function of x by cubics through even samples.
class Sampled {
 public:
  Sampled(double left, double right, std::vector<double> values)
      : left_(left), h_((right - left) / static_cast<double>(values.size() - 1)), values_(std::move(values)) {}
  double operator()(double x) const {
    const double last = static_cast<double>(values_.size() - 1);
    const double position = std::clamp((x - left_) / h_, 0.0, last);
    const auto i = static_cast<std::size_t>(std::clamp(std::floor(position), 1.0, last - 2));
    const double s = position - static_cast<double>(i);
    const double *f = &values_[i], a = f[-1], b = f[0], c = f[1], d = f[2];
    return b + s * ((c - a) / 2 + s * (a - 2.5 * b + 2 * c - d / 2 + s * (1.5 * (b - c) + (d - a) / 2)));
  }

 private:
  double left_, h_;
  std::vector<double> values_;
};

}  // namespace

std::function<double(double, double)> forcing_of(const scenario::Scenario& s, double left, double right) {
  if (!s.initial.hold) return s.forcing_at;
  constexpr int samples = 8192;
  const double h = (right - left) / samples;
  std::vector<double> load(samples + 1);
  for (int i = 0; i <= samples; ++i) {
    const double x = left + h * i, low = std::max(left, x - h / 8), high = std::min(right, x + h / 8);
    load[static_cast<std::size_t>(i)] = s.stress(x) > 0 ? (balance(s, high) - balance(s, low)) / (high - low) : 0;
  }
  const auto held = std::make_shared<const Sampled>(left, right, std::move(load));
  return [held, forcing = s.forcing_at](double x, double t) { return (*held)(x) + (forcing ? forcing(x, t) : 0); };
}

}  // namespace slipfront::setup
