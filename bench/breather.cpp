// Error and time of a breather of Eq. 3 with slipfront's chain and with leapfrog as a plain loop, for
// peers/breather.py. Each row has the method, the spacing of sites, the largest error of u, and the least seconds of
// the time steps, separated by tabs.
//
// The breather is that of the program step-25 of deal.II: it starts at rest and swings for 3/2 times its half period.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"

namespace {

using namespace slipfront::chain;

constexpr double m = 0.5, reach = 40;
const double omega = std::sqrt(1 - m * m), start = -1.5 * std::numbers::pi / omega,
             end = 0.75 * std::numbers::pi / omega;

double breather(double x, double t) { return -4 * std::atan(m / omega * std::sin(omega * t) / std::cosh(m * x)); }

double seconds(const std::function<void()>& task) {
  const auto begun = std::chrono::steady_clock::now();
  task();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

Problem problem(double h) {
  Problem p;
  p.grid = {-reach, h, static_cast<std::size_t>(std::lround(2 * reach / h)) + 1};
  p.boundary.left = p.boundary.right = End::fixed;
  return p;
}

std::vector<double> at_start(const Grid& grid) {
  std::vector<double> u;
  for (std::size_t j = 0; j < grid.sites; ++j) u.push_back(breather(grid.x(j), start));
  return u;
}

void print_row(const char* method, const Grid& grid, const std::vector<double>& u, double least) {
  double error = 0;
  for (std::size_t j = 0; j < u.size(); ++j) error = std::fmax(error, std::fabs(u[j] - breather(grid.x(j), end)));
  std::printf("%s\t%.6g\t%.4e\t%.4e\n", method, grid.spacing, error, least);
}

void chain(double h) {
  const Problem p = problem(h);
  double least = 1e9;
  std::vector<double> u;
  for (int run = 0; run < 100; ++run) {
    ExplicitChain chain(p, Motion{at_start(p.grid), {}});
    const long steps = std::lround((end - start) / chain.dt());
    least = std::fmin(least, seconds([&] { chain.advance(steps); }));
    u = chain.window(0, p.grid.sites, end - start).u;
  }
  print_row("slipfront", p.grid, u, least);
}

void leapfrog(double h) {
  const Grid grid = problem(h).grid;
  const long steps = std::lround((end - start) / (0.95 * h));
  const double dt = (end - start) / static_cast<double>(steps), lambda2 = dt * dt / (h * h);
  const std::size_t n = grid.sites;
  double least = 1e9;
  std::vector<double> u;
  for (int run = 0; run < 10; ++run) {
    u = at_start(grid);
    std::vector<double> velocity(n);
    const auto kick = [&](double time) {
      for (std::size_t j = 1; j + 1 < n; ++j)
        velocity[j] += time / dt * (lambda2 * (u[j + 1] - 2 * u[j] + u[j - 1]) - dt * dt * std::sin(u[j]));
    };
    kick(dt / 2);
    least = std::fmin(least, seconds([&] {
                        for (long i = 0; i < steps; ++i) {
                          for (std::size_t j = 0; j < n; ++j) u[j] += velocity[j];
                          kick(dt);
                        }
                      }));
  }
  print_row("plain leapfrog", grid, u, least);
}

}  // namespace

int main() {
  for (const double h : {0.64, 0.5, 0.4, 0.32, 0.25, 0.2, 0.16, 0.125, 0.1, 0.08}) chain(h);
  for (const double h : {0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625}) leapfrog(h);
}
