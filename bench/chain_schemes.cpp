// Error against cost of the schemes that were weighed for the chain (docs/chain.md), in one run.
//
// Each scheme runs the same loops over the same polynomial for the sine, so that the seconds compare; damping is C u_t.
// Problems: exact solutions of Eq. 3 (travelling kink, breather, kink through kink, kink through antikink), and a
// damped train, step 0.855 into an empty interface.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "chain/periodic_force.hpp"
#include "slipfront/chain/chain.hpp"
#include "slipfront/chain/initial.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define CLONES
#define INDEPENDENT
#endif

namespace {

using namespace slipfront::chain;
using std::numbers::pi;
using Exact = std::function<double(double x, double t)>;

/// What every scheme is built from: u(x, t) near t = 0 on [left, right], whose ends stay as they are.
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

/// Two levels on the full grid.
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

CLONES void leapfrog_step(std::size_t n, const double* now, double* old, const PeriodicForce f, double e, double b,
                          double p) {
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

CLONES void kick(std::size_t n, const double* u, double* v, const PeriodicForce f, double dt, double e) {
  INDEPENDENT
  for (std::size_t j = 2; j + 2 < n; ++j)
    v[j] += dt * (e * (16 * (u[j - 1] + u[j + 1]) - (u[j - 2] + u[j + 2]) - 30 * u[j]) - f(u[j]));
}
CLONES void drift(std::size_t n, double* u, const double* v, double dt) {
  for (std::size_t j = 0; j < n; ++j) u[j] += dt * v[j];
}

/// Fourth-order composition (Yoshida 1990) of drift and kick, five points in space; damping as exp(-C dt) halves
/// around.
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

CLONES void seen_step(std::size_t n, const double* now, double* old, double* y, const PeriodicForce f, double e,
                      double b, double p, double q) {
  for (std::size_t j = 0; j < n; ++j) {
    const double S = f(now[j]);
    y[j] = now[j] - q * S;
    old[j] = now[j] + b * (now[j] - old[j]) - p * S;
  }
  INDEPENDENT
  for (std::size_t j = 1; j + 1 < n; ++j) old[j] += e * (y[j - 1] + y[j + 1] - 2 * y[j]);
}

/// The diamond rule, near the light cone.
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

CLONES void checkerboard_step(std::size_t n, const double* west, double* centre, const PeriodicForce f, double e,
                              double b) {
  INDEPENDENT
  for (std::size_t j = 0; j < n; ++j) {
    const double sum = west[j] + west[j + 1];
    centre[j] = e * sum - b * centre[j] - f(sum / 2);
  }
}

/// Half the sites of dt = dx: Ablowitz-Kruskal-Ladik (sine of the mean of E and W) or Hirota's, as one function of that
/// mean.
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

using Make = std::function<std::unique_ptr<Scheme>(const Start&, double h)>;
/// The library: the diamond rule with tiles in cache.
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
            .friction = {slipfront::modulation::FrictionLaw::viscous, s.C},
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
  Chain chain_;
};

struct Entry {
  const char* name;
  std::vector<double> spacings;  ///< in the problem of the damped train
  bool checkerboard;
  Make make;
};

const std::vector<Entry> entries{
    {"leapfrog dt=.95dx",
     {0.2, 0.1, 0.05},
     false,
     [](const Start& s, double h) { return std::make_unique<Leapfrog>(s, h); }},
    {"Yoshida 4, 5-point",
     {0.5, 0.4, 0.3},
     false,
     [](const Start& s, double h) { return std::make_unique<Yoshida>(s, h); }},
    {"AKL",
     {0.4, 0.2, 0.1, 0.05},
     true,
     [](const Start& s, double h) { return std::make_unique<Checkerboard>(s, h, false, false); }},
    {"Hirota",
     {0.4, 0.2, 0.1, 0.05},
     true,
     [](const Start& s, double h) { return std::make_unique<Checkerboard>(s, h, true, false); }},
    {"Hirota, k=tanh^2(h/2)",
     {0.4, 0.2, 0.1, 0.05},
     true,
     [](const Start& s, double h) { return std::make_unique<Checkerboard>(s, h, true, true); }},
    {"diamond 4",
     {0.6, 0.5, 0.4, 0.3, 0.2},
     false,
     [](const Start& s, double h) { return std::make_unique<Diamond>(s, h); }},
    {"library: diamond 4",
     {0.5, 0.4, 0.3, 0.2},
     false,
     [](const Start& s, double h) { return std::make_unique<Library>(s, h); }},
};

/// Processor time: others may use the machine.
double now_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void against_exact(const char* name, const Exact& u, double reach, double end) {
  std::printf("%s: max error at t = %g\n", name, end);
  for (const Entry& entry : entries) {
    std::printf("  %-24s", entry.name);
    for (const double h : {0.4, 0.2, 0.1, 0.05}) {
      auto s = entry.make({u, -reach, reach, 0}, h);
      const double per = entry.checkerboard ? 2 * s->dt : s->dt;
      while (s->time + per <= end) s->step();
      double error = 0;
      const auto got = s->u();
      for (std::size_t j = 0; j < got.size(); ++j)
        if (std::fabs(s->x[j]) < reach - 8) error = std::fmax(error, std::fabs(got[j] - u(s->x[j], s->time)));
      std::printf("  %.2e", error);
    }
    std::printf("\n");
  }
}

/// A train at rest near t = 0: Taylor in t with u_x by differences of the initial state.
Exact at_rest(const Exact& u0, double C) {
  return [u0, C](double x, double t) {
    if (t == 0) return u0(x, 0);
    const double d = std::fmax(std::fabs(t), 0.02);  // about the spacing of the grid
    const auto A = [&](double y) {
      const double c = u0(y, 0);
      return (16 * (u0(y + d, 0) + u0(y - d, 0)) - u0(y + 2 * d, 0) - u0(y - 2 * d, 0) - 30 * c) / (12 * d * d) -
             std::sin(c);
    };
    const double a = A(x), axx = (A(x + d) + A(x - d) - 2 * a) / (d * d), c = u0(x, 0);
    const double jerk = -C * a, snap = axx - std::cos(c) * a - C * jerk;
    return c + t * t / 2 * a + t * t * t / 6 * jerk + t * t * t * t / 24 * snap;
  };
}

/// Displacement averaged over one spacing of the train about x = 0, at 64 times, less that at t = 0.
std::vector<double> history(Scheme& s, double per, double end, double width, double* seconds) {
  std::vector<double> out;
  const auto mean = [&] {
    // Trapezoid over the window with interpolated ends, from a cubic through the sites.
    const auto u = s.u();
    const double h = s.x[1] - s.x[0];
    const auto at = [&](double y) {
      const double r = (y - s.x[0]) / h;
      const auto j = static_cast<std::size_t>(r);
      const double f = r - static_cast<double>(j), *p = &u[j - 2];
      double sum = 0;  // Lagrange, six points
      for (int a = 0; a < 6; ++a) {
        double w = 1;
        for (int b = 0; b < 6; ++b)
          if (b != a) w *= (f + 2 - b) / (a - b);
        sum += w * p[a];
      }
      return sum;
    };
    double sum = 0;
    for (int i = 0; i < 256; ++i) sum += at(width * ((i + 0.5) / 256 - 0.5));
    return sum / 256;
  };
  const double first = mean();
  *seconds = 0;
  double before_time = s.time, before = first;
  for (int i = 1; i <= 64; ++i) {
    const double target = end * i / 64;
    const double from = now_seconds();
    s.many(std::max(0L, static_cast<long>((target - s.time) / per - 1e-6)));
    *seconds += now_seconds() - from;
    // Cubic in time through four levels would do; slip is smooth on this scale: linear between two steps.
    before_time = s.time;
    before = mean();
    const double again = now_seconds();
    s.step();
    *seconds += now_seconds() - again;
    const double after = mean();
    out.push_back(before + (after - before) * (target - before_time) / (s.time - before_time) - first);
  }
  return out;
}

void target(double scale) {
  const double C = 0.5 / scale, end = 2 * pi * scale, k = 0.855, left = -4.2 * scale, right = 0.6 * scale;
  // The same initial state for every grid: the train in closed form, sampled finely once and then asked for by x.
  const auto stress = [k](double x) { return x < 0 ? k : 0.0; };
  const Exact u0 = [&](double x, double) {
    static std::function<double(double)> f = nullptr;
    return static_train(stress, {std::fmin(x, -1e-3), x < 0 ? -x : 1e-3, 2}).u[x < 0 ? 0 : 1];
  };
  const Exact start = [&](double x, double t) { return x > 30 ? 0 : at_rest(u0, C)(x, t); };
  const double width = 2 * pi / k;
  std::printf("damped train, scale %g: largest relative error of the slip history at x = 0, seconds\n", scale);
  double seconds = 0;
  std::vector<double> reference;
  {
    Diamond fine({start, left, right, C}, 0.1);
    reference = history(fine, fine.dt, end, width, &seconds);
    std::printf("  reference diamond h = 0.1: slip %.8f  %.2f s\n", reference.back() / scale, seconds);
  }
  for (const Entry& entry : entries)
    for (const double h : entry.spacings) {
      auto s = entry.make({start, left, right, C}, h);
      const auto got = history(*s, entry.checkerboard ? 2 * s->dt : s->dt, end, width, &seconds);
      double error = 0;
      for (std::size_t i = 0; i < got.size(); ++i)
        error = std::fmax(error, std::fabs(got[i] - reference[i]) / reference.back());
      std::printf("  %-24s h %.2f  slip %.8f  error %.2e  %.3f s\n", entry.name, h, got.back() / scale, error, seconds);
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  const double v = 0.5, g = 1 / std::sqrt(1 - v * v), w = 0.6, q = std::sqrt(1 - w * w);
  against_exact(
      "kink, U = 0.5", [=](double x, double t) { return 4 * std::atan(std::exp(-g * (x - v * t))); }, 40, 16);
  against_exact(
      "breather, omega = 0.6",
      [=](double x, double t) { return 4 * std::atan(q / w * std::sin(w * t) / std::cosh(q * x)); }, 40, 16);
  against_exact(
      "kink through kink, U = 0.5",
      [=](double x, double t) { return 4 * std::atan(v * std::sinh(g * x) / std::cosh(g * v * (t - 8))); }, 40, 16);
  against_exact(
      "kink through antikink, U = 0.5",
      [=](double x, double t) { return 4 * std::atan(std::sinh(g * v * (t - 8)) / (v * std::cosh(g * x))); }, 40, 16);
  target(argc > 1 ? std::atof(argv[1]) : 100);
}
