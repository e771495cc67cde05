// Compares error and cost of the schemes that were considered for the chain (docs/chain.md), in one run.
//
// Problems: exact solutions of Eq. 3 (travelling kink, breather, kink through kink, kink through antikink), and a
// damped train, step 0.855 into an empty interface. Schemes: chain_schemes.hpp.

#include "chain_schemes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lattice/chain/model/initial_train.hpp"

namespace {

using namespace schemes;

using Make = std::function<std::unique_ptr<schemes::Scheme>(const Start&, double h)>;

struct Entry {
  const char* name;
  std::vector<double> spacings;  ///< for the damped train
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

/// Processor time in seconds, which other programs on the machine hardly change.
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

/// A train at rest near t = 0: a Taylor series in t, with derivatives in x from differences of the initial state.
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

/// Displacement averaged over a window of this width about x = 0, by interpolation between the sites.
double mean_over(schemes::Scheme& s, double width) {
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
}

/// Displacement averaged over one spacing of the train about x = 0, at 64 times, less that at t = 0.
std::vector<double> history(schemes::Scheme& s, double per, double end, double width, double* seconds) {
  std::vector<double> out;
  const auto mean = [&] { return mean_over(s, width); };
  const double first = mean();
  *seconds = 0;
  double before_time = s.time, before = first;
  for (int i = 1; i <= 64; ++i) {
    const double target = end * i / 64;
    const double from = now_seconds();
    s.many(std::max(0L, static_cast<long>((target - s.time) / per - 1e-6)));
    *seconds += now_seconds() - from;
    // Linear interpolation between two steps suffices, because slip is smooth on this scale.
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
  // All grids have the same initial state, the train in closed form. It is evaluated at each x.
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
