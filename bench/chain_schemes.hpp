#pragma once
// The schemes that were considered for the chain. All use similar loops and the same polynomial for the sine. Damping
// is C u_t.

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/periodic_force.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define CLONES
#define INDEPENDENT
#endif

namespace schemes {

using namespace slipfront::chain;
using std::numbers::pi;
using Exact = std::function<double(double x, double t)>;

/// The start of every scheme: u(x, t) near t = 0 on [left, right]. u is constant at both ends.
struct Start {
  Exact u;
  double left, right, C;
};

class Scheme {
 public:
  virtual ~Scheme() = default;
  virtual void step() = 0;
  virtual void many(long count) {
    for (long i = 0; i < count; ++i) step();
  }
  double time = 0, dt = 0;
  std::vector<double> x;
  virtual std::vector<double> u() const = 0;  // radians, at x
};

/// A scheme with two levels in time on the full grid.
class FullGrid : public Scheme {
 public:
  FullGrid(const Start& s, double h, double step_size) {
    const auto n = static_cast<std::size_t>(std::llround((s.right - s.left) / h)) + 1;
    dt = step_size;
    for (std::size_t j = 0; j < n; ++j) {
      x.push_back(s.left + static_cast<double>(j) * h);
      now.push_back(s.u(x[j], 0) / (2 * pi));
      old.push_back(s.u(x[j], -dt) / (2 * pi));
    }
    other.resize(n + 2);
  }
  std::vector<double> u() const override {
    std::vector<double> out(now);
    for (double& v : out) v *= 2 * pi;
    return out;
  }

 protected:
  std::vector<double> now, old, other;
};

CLONES inline void leapfrog_step(std::size_t n, const double* now, double* old, const PeriodicForce f, double e,
                                 double b, double p) {
  INDEPENDENT
  for (std::size_t j = 1; j + 1 < n; ++j)
    old[j] = now[j] + b * (now[j] - old[j]) + e * (now[j - 1] + now[j + 1] - 2 * now[j]) - p * f(now[j]);
}

class Leapfrog : public FullGrid {
 public:
  Leapfrog(const Start& s, double h) : FullGrid(s, h, 0.95 * h), f(substrate_force(0)) {
    const double g = s.C * dt / 2, a = 1 + g;  // time-centred damping
    e = 0.95 * 0.95 / a;
    b = (1 - g) / a;
    p = dt * dt / a;
  }
  void step() override {
    leapfrog_step(now.size(), now.data(), old.data(), f, e, b, p);
    now.swap(old);
    time += dt;
  }

 private:
  PeriodicForce f;
  double e, b, p;
};

CLONES inline void kick(std::size_t n, const double* u, double* v, const PeriodicForce f, double dt, double e) {
  INDEPENDENT
  for (std::size_t j = 2; j + 2 < n; ++j)
    v[j] += dt * (e * (16 * (u[j - 1] + u[j + 1]) - (u[j - 2] + u[j + 2]) - 30 * u[j]) - f(u[j]));
}
CLONES inline void drift(std::size_t n, double* u, const double* v, double dt) {
  for (std::size_t j = 0; j < n; ++j) u[j] += dt * v[j];
}

/// Fourth-order composition (Yoshida 1990) of drift and kick, with five points in space. Damping by exp(-C dt / 2)
/// comes before and after.
class Yoshida : public FullGrid {
 public:
  Yoshida(const Start& s, double h) : FullGrid(s, h, 0.6 * h), f(substrate_force(0)), C(s.C), e(1 / (12 * h * h)) {
    v.resize(now.size());
    const double d = 1e-3 * dt;
    for (std::size_t j = 0; j < v.size(); ++j) v[j] = (s.u(x[j], d) - s.u(x[j], -d)) / (2 * d) / (2 * pi);
  }
  void step() override {
    const double w1 = 1 / (2 - std::cbrt(2.0)), w0 = 1 - 2 * w1, damp = std::exp(-C * dt / 2);
    for (double& w : v) w *= damp;
    for (const double w : {w1, w0, w1}) {
      drift(now.size(), now.data(), v.data(), w * dt / 2);
      kick(now.size(), now.data(), v.data(), f, w * dt, e);
      drift(now.size(), now.data(), v.data(), w * dt / 2);
    }
    for (double& w : v) w *= damp;
    time += dt;
  }

 private:
  PeriodicForce f;
  double C, e;
  std::vector<double> v;
};

CLONES inline void seen_step(std::size_t n, const double* now, double* old, double* y, const PeriodicForce f, double e,
                             double b, double p, double q) {
  for (std::size_t j = 0; j < n; ++j) {
    const double S = f(now[j]);
    y[j] = now[j] - q * S;
    old[j] = now[j] + b * (now[j] - old[j]) - p * S;
  }
  INDEPENDENT
  for (std::size_t j = 1; j + 1 < n; ++j) old[j] += e * (y[j - 1] + y[j + 1] - 2 * y[j]);
}

/// The diamond rule of the library, with dt near the spacing h.
class Diamond : public FullGrid {
 public:
  Diamond(const Start& s, double h, double c = 1.0 / 12) : FullGrid(s, h, h * std::sqrt(1 - c * h * h)) {
    const double g = s.C * dt / 2, theta = (std::cosh(g) - 1) / (std::cosh(g) + 5), lambda2 = 1 - c * h * h;
    const double eps = dt * dt / 12, scale = (1 - theta) * std::exp(g);
    eps_ = eps / (1 - theta);
    f = substrate_force(eps_);
    e = (lambda2 + theta) / scale;
    b = std::exp(-2 * g);
    p = (10 * eps + (2 + 10 * theta) * eps_) / scale;
    q = (eps + (lambda2 + theta) * eps_) / scale / e;
    for (auto* level : {&now, &old})
      for (double& z : *level) z += eps_ * std::sin(2 * pi * z) / (2 * pi);
  }
  void step() override {
    const double l = now.front(), r = now.back();
    seen_step(now.size(), now.data(), old.data(), other.data(), f, e, b, p, q);
    old.front() = l;
    old.back() = r;
    now.swap(old);
    time += dt;
  }
  std::vector<double> u() const override {
    std::vector<double> out(now);
    for (double& v : out) v = 2 * pi * (v - eps_ * f(v));
    return out;
  }

 private:
  PeriodicForce f;
  double eps_, e, b, p, q;
};

CLONES inline void checkerboard_step(std::size_t n, const double* west, double* centre, const PeriodicForce f, double e,
                                     double b) {
  INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const double sum = west[j] + west[j + 1];
    centre[j] = e * sum - b * centre[j] - f(sum / 2);
  }
}

/// Half of the grid with dt = dx, in a checkerboard pattern. The scheme is that of Ablowitz, Kruskal and Ladik (sine of
/// the mean of the east and west neighbours) or that of Hirota. Both are a function of that mean.
class Checkerboard : public Scheme {
 public:
  Checkerboard(const Start& s, double h, bool hirota, bool static_exact) {
    dt = h;
    const auto n = static_cast<std::size_t>(std::llround((s.right - s.left) / (2 * h)));
    for (std::size_t j = 0; j <= n; ++j) even.push_back(s.u(s.left + 2 * h * static_cast<double>(j), 0) / (2 * pi));
    for (std::size_t j = 0; j < n; ++j)
      odd.push_back(s.u(s.left + 2 * h * (static_cast<double>(j) + 0.5), -h) / (2 * pi));
    for (std::size_t j = 0; j <= n; ++j) x.push_back(s.left + 2 * h * static_cast<double>(j));
    const double kappa = static_exact ? std::pow(std::tanh(h / 2), 2) : h * h / 4, a = 1 + s.C * h / 2;
    f = fit([&](double z) {
      const double sine = std::sin(2 * pi * z);
      return (hirota ? 4 * std::atan(kappa * sine / (1 + kappa * std::cos(2 * pi * z))) : h * h * sine) / (2 * pi * a);
    });
    e = 1 / a;
    b = (1 - s.C * h / 2) / a;
  }
  void step() override {  // two levels
    checkerboard_step(odd.size(), even.data(), odd.data(), f, e, b);
    checkerboard_step(even.size() - 2, odd.data(), even.data() + 1, f, e, b);
    time += 2 * dt;
  }
  std::vector<double> u() const override {
    std::vector<double> out(even);
    for (double& v : out) v *= 2 * pi;
    return out;
  }

 private:
  std::vector<double> even, odd;
  PeriodicForce f;
  double e, b;
};

/// The chain of the library: the diamond rule, with tiles that fit into the cache.
class Library : public Scheme {
 public:
  Library(const Start& s, double h) : chain_(problem(s, h), motion(s, h)) {
    dt = chain_.dt();
    for (std::size_t j = 0; j < chain_.problem().grid.sites; ++j) x.push_back(chain_.problem().grid.x(j));
  }
  void step() override { many(1); }
  void many(long count) override {
    chain_.advance(count);
    time = chain_.time();
  }
  std::vector<double> u() const override { return chain_.window(0, x.size()).u; }

 private:
  static Problem problem(const Start& s, double h) {
    return {.grid = {s.left, h, static_cast<std::size_t>(std::llround((s.right - s.left) / h)) + 1},
            .model = Model::sine_gordon,
            .boundary = {End::fixed, End::fixed, false, 0},
            .friction = slipfront::friction::viscous(s.C),
            .forcing = {},
            .contact = {}};
  }
  static Motion motion(const Start& s, double h) {
    const Grid grid = problem(s, h).grid;
    Motion m;
    for (std::size_t j = 0; j < grid.sites; ++j) {
      m.u.push_back(s.u(grid.x(j), 0));
      m.velocity.push_back(s.C > 0 ? 0 : (s.u(grid.x(j), 1e-4) - s.u(grid.x(j), -1e-4)) / 2e-4);
    }
    return m;
  }
  ExplicitChain chain_;
};

}  // namespace schemes

#undef CLONES
#undef INDEPENDENT
