#include "start.hpp"

#include <cmath>
#include <numbers>

namespace slipfront::chain {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A quantity along the chain with two sites beyond each end, as the ends continue it.
class Extended {
 public:
  Extended(const std::vector<double>& values, const Boundary& b, double jump) : v_(values.size() + 4) {
    const std::size_t n = values.size();
    for (std::size_t j = 0; j < n; ++j) v_[j + 2] = values[j];
    for (std::size_t k = 1; k <= 2; ++k) {
      const double first = values[0], last = values[n - 1];
      v_[2 - k] = b.periodic ? values[n - k] + jump : b.left == End::fixed ? 2 * first - values[k] : values[k];
      v_[n + 1 + k] = b.periodic              ? values[k - 1] - jump
                      : b.right == End::fixed ? 2 * last - values[n - 1 - k]
                                              : values[n - 1 - k];
    }
  }
  double operator()(std::size_t j, int k) const { return v_[static_cast<std::size_t>(static_cast<long>(j) + 2 + k)]; }
  double bend(std::size_t j) const { return (*this)(j, 1) - 2 * (*this)(j, 0) + (*this)(j, -1); }
  /// Second derivative times h^2, fourth order.
  double fine_bend(std::size_t j) const {
    return (16 * ((*this)(j, 1) + (*this)(j, -1)) - ((*this)(j, 2) + (*this)(j, -2)) - 30 * (*this)(j, 0)) / 12;
  }

 private:
  std::vector<double> v_;
};

}  // namespace

Levels first_levels(const Problem& p, const Scheme& s, const Forces& forces, const Motion& start) {
  const std::size_t n = p.grid.sites;
  const double h2 = s.h * s.h, dt = s.dt;
  const double C = p.friction.law == modulation::FrictionLaw::viscous ? p.friction.coefficient : 0;
  const auto contact = [&forces](std::size_t j) { return forces.a2() == nullptr ? 1.0 : forces.a2()[j]; };
  const auto velocity = [&start](std::size_t j) { return start.velocity.empty() ? 0.0 : start.velocity[j]; };
  std::vector<double> acceleration(n), w(n);
  {
    const Extended u(start.u, p.boundary, turn * static_cast<double>(p.boundary.charge));
    for (std::size_t j = 0; j < n; ++j) {
      w[j] = velocity(j);
      const double spring = (p.model == Model::lattice ? u.bend(j) : u.fine_bend(j)) / h2;
      acceleration[j] = spring - contact(j) * std::sin(start.u[j]) + forces.now(j) - forces.friction(w[j]);
    }
  }
  const Extended A(acceleration, p.boundary, 0);
  const auto cosine = [&](std::size_t j) { return contact(j) * std::cos(start.u[j]); };
  const auto sine = [&](std::size_t j) { return contact(j) * std::sin(start.u[j]); };
  std::vector<double> jerk(n);
  {
    const Extended velocities(w, p.boundary, 0);
    for (std::size_t j = 0; j < n; ++j) {
      const double spring = (p.model == Model::lattice ? velocities.bend(j) : velocities.fine_bend(j)) / h2;
      jerk[j] = spring - cosine(j) * w[j] - C * acceleration[j] + forces.rate(j);
    }
  }
  const Extended J(jerk, p.boundary, 0);
  Levels levels;
  levels.now.resize(n);
  levels.before.resize(n);
  const auto z = [&](std::size_t j, double u) { return (u + s.eps * contact(j) * std::sin(u)) / turn; };
  for (std::size_t j = 0; j < n; ++j) {
    const double u = start.u[j], v = w[j], a = acceleration[j];
    const double fourth = A.bend(j) / h2 - cosine(j) * a + sine(j) * v * v - C * jerk[j];
    const double fifth =
        J.bend(j) / h2 - cosine(j) * jerk[j] + sine(j) * 3 * v * a + cosine(j) * v * v * v - C * fourth;
    const bool held = (j == 0 && !p.boundary.periodic && p.boundary.left == End::fixed) ||
                      (j + 1 == n && !p.boundary.periodic && p.boundary.right == End::fixed);
    levels.now[j] = z(j, u);
    levels.before[j] =
        held ? levels.now[j]
             : z(j, u - dt * (v - dt / 2 * (a - dt / 3 * (jerk[j] - dt / 4 * (fourth - dt / 5 * fifth)))));
  }
  return levels;
}

}  // namespace slipfront::chain
