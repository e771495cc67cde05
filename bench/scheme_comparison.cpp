// Error against cost of the schemes that were weighed for the pulse solver (docs/pulse.md), in one run. Prints a table,
// or CSV with --csv.
//
// The problem is the hardest of the plain ones: a true step into an empty interface, Sigma- = 0.855, C = 0.5, closure
// consistent, to t = 2 pi; the number is the slip at x = 0, against 0.1696217 (the graded scheme with 1600 cells; three
// schemes agree on it).

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <vector>

#include "averages/pulse/solver.hpp"
#include "averages/pulse/space/semidiscrete.hpp"
#include "slipfront/theory/modulation/modulation.hpp"
#include "slipfront/theory/rupture/relations.hpp"
#include "theory/rupture/inverse.hpp"

namespace {

using namespace slipfront;
using std::numbers::pi;
constexpr double stress = 0.855, C = 0.5, end = 2 * pi, exact = 0.1696217;

double reach() { return 1.15 * rupture::from_stress(stress).rupture_velocity * end; }

/// Harten, Lax & van Leer's flux between two states, not both empty.
modulation::Pair hll_flux(const State& l, const State& r) {
  const auto sl = modulation::characteristic_speeds(l), sr = modulation::characteristic_speeds(r);
  // Towards an empty side the fastest wave is the edge, tanh(phi +- psi).
  const double low = l.empty() ? std::tanh(r.phi - r.psi) : r.empty() ? sl.minus : std::fmin(sl.minus, sr.minus);
  const double high = r.empty() ? std::tanh(l.phi + l.psi) : l.empty() ? sr.plus : std::fmax(sl.plus, sr.plus);
  const auto fl = modulation::flux(l), fr = modulation::flux(r), ul = modulation::density(l),
             ur = modulation::density(r);
  const auto hll = [&](double flux_l, double flux_r, double u_l, double u_r) {
    if (low >= 0) return flux_l;
    if (high <= 0) return flux_r;
    return (high * flux_l - low * flux_r + low * high * (u_r - u_l)) / (high - low);
  };
  return {hll(fl.number, fr.number, ul.number, ur.number), hll(fl.momentum, fr.momentum, ul.momentum, ur.momentum)};
}

/// Conservative finite volumes on a fixed grid in x: (k, P), minmod slopes, HLL flux, two-stage steps, friction exactly
/// by exp(-C dt). Empty cells are those whose spacing a double's psi cannot express.
double eulerian(int cells, bool second_order) {
  const double left = -reach(), right = 1.0, dx = (right - left) / cells;
  const auto n = static_cast<std::size_t>(cells);
  std::vector<double> k(n), P(n, 0.0), psi(n, 0.1);
  for (std::size_t i = 0; i < n; ++i) k[i] = left + (static_cast<double>(i) + 0.5) * dx < 0 ? stress : 0;
  double slip = 0;
  const auto rates = [&](const std::vector<double>& kk, const std::vector<double>& PP, std::vector<double>& dk,
                         std::vector<double>& dP, double& fastest, double& through_origin) {
    std::vector<State> s(n);
    fastest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (kk[i] > 0.0046) s[i] = modulation::state_of({2 * pi / kk[i], 2 * pi * PP[i] / kk[i]}, psi[i]);
      if (!s[i].empty()) psi[i] = s[i].psi;
      const auto speeds = modulation::characteristic_speeds(s[i]);
      fastest = std::fmax(fastest, std::fmax(std::fabs(speeds.minus), std::fabs(speeds.plus)));
    }
    const auto minmod = [](double a, double b) { return a * b <= 0 ? 0 : std::fabs(a) < std::fabs(b) ? a : b; };
    const auto slope = [&](std::size_t i, double State::*m) {
      if (!second_order || i == 0 || i + 1 == n || s[i].empty()) return 0.0;
      return minmod(s[i].*m - s[i - 1].*m, s[i + 1].*m - s[i].*m) / 2;
    };
    std::vector<modulation::Pair> flux(n + 1, {0, 0});
    for (std::size_t f = 0; f <= n; ++f) {
      const std::size_t a = f == 0 ? 0 : f - 1, b = f == n ? n - 1 : f;
      const State l{s[a].phi + (f == 0 ? 0 : slope(a, &State::phi)), s[a].psi + (f == 0 ? 0 : slope(a, &State::psi))};
      const State r{s[b].phi - (f == n ? 0 : slope(b, &State::phi)), s[b].psi - (f == n ? 0 : slope(b, &State::psi))};
      if (l.empty() && r.empty()) continue;
      flux[f] = hll_flux(l, r);
    }
    for (std::size_t i = 0; i < n; ++i) {
      dk[i] = (flux[i].number - flux[i + 1].number) / dx;
      dP[i] = (flux[i].momentum - flux[i + 1].momentum) / dx;
    }
    const double at = -left / dx;
    const auto f = static_cast<std::size_t>(at);
    through_origin = flux[f].number + (at - static_cast<double>(f)) * (flux[f + 1].number - flux[f].number);
  };
  std::vector<double> dk(n), dP(n), dk2(n), dP2(n), k1(n), P1(n);
  for (double t = 0; t < end * (1 - 1e-12);) {
    double fastest = 0, W = 0, W2 = 0, ignored = 0;
    rates(k, P, dk, dP, fastest, W);
    const double dt = std::fmin(0.45 * dx / fastest, end - t), fade = std::exp(-C * dt);
    for (std::size_t i = 0; i < n; ++i) {
      k1[i] = std::fmax(k[i] + dt * dk[i], 0.0);
      P1[i] = (P[i] + dt * dP[i]) * fade;
    }
    rates(k1, P1, dk2, dP2, ignored, W2);
    for (std::size_t i = 0; i < n; ++i) {
      k[i] = std::fmax(k[i] + dt / 2 * (dk[i] + dk2[i]), 0.0);
      P[i] = (P[i] + dt / 2 * dP[i]) * fade + dt / 2 * dP2[i];
    }
    slip += dt / 2 * (W + W2);
    t += dt;
  }
  return slip;
}

double graded(int cells) {
  pulse::Problem p{.stress = [](double x) { return x < 0 ? stress : 0.0; },
                   .forcing = {},
                   .friction = friction::viscous(C, friction::Closure::consistent),
                   .left = -reach(),
                   .right = 1,
                   .cells = cells};
  pulse::Solver solver(p);
  solver.advance_to(end);
  return solver.slip_at(solver.view(), 0);
}

template <class Scheme>
void row(const char* name, int cells, bool csv, Scheme&& scheme) {
  const auto begun = std::chrono::steady_clock::now();
  const double slip = scheme(cells);
  const double ms = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() * 1e3;
  std::printf(csv ? "\"%s\",%d,%.9f,%.3e,%.3f\n" : "%-28s %6d  %.7f  %9.1e  %9.2f\n", name, cells, slip,
              std::fabs(slip / exact - 1), ms);
}

}  // namespace

int main(int argc, char** argv) {
  const bool csv = argc > 1 && std::strcmp(argv[1], "--csv") == 0;
  std::printf(csv ? "scheme,cells,slip,error,ms\n"
                  : "scheme                        cells       slip      error         ms\n");
  for (const int n : {100, 200, 400, 800, 1600})
    row("fixed grid, first order", n, csv, [](int c) { return eulerian(c, false); });
  for (const int n : {100, 200, 400, 800, 1600})
    row("fixed grid, second order", n, csv, [](int c) { return eulerian(c, true); });
  for (const int n : {25, 50, 100, 200, 400}) row("dislocations, graded WENO", n, csv, graded);
}
