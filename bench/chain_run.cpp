// Runs the lattice of Eq. (1) from a given state, for peers/lammps_chain.py: with slipfront's chain, or with leapfrog
// as a plain loop with the sine of the C library. Usage: chain_run FILE SPACING STEP STEPS chain|single|plain, where
// single means phases of 32 bits. FILE contains u, then u_t, of every site as binary doubles. The program writes u at
// the end to FILE.out, and prints the processor time of the steps in seconds.

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/explicit/levels/kernel.hpp"

namespace {

constexpr double turn = 2 * std::numbers::pi;

double acceleration(const std::vector<double>& u, std::size_t j, double spacing) {
  return ((u[j + 1] - u[j]) - (u[j] - u[j - 1])) / (spacing * spacing) - std::sin(u[j]);
}

std::vector<double> read(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(double)));
  return values;
}

/// Advances `u` by a plain loop. Returns the processor time in seconds.
double plain(std::vector<double>& u, std::vector<double>& velocity, double spacing, double dt, long steps) {
  const std::size_t n = u.size();
  const std::clock_t begun = std::clock();
  for (long k = 0; k < steps; ++k) {
    for (std::size_t j = 1; j + 1 < n; ++j) velocity[j] += dt * acceleration(u, j, spacing);
    for (std::size_t j = 1; j + 1 < n; ++j) u[j] += dt * velocity[j];
  }
  return static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
}

/// Advances `u` with the library. Returns the processor time in seconds.
double by_library(std::vector<double>& u, const std::vector<double>& velocity, double spacing, double dt, long steps,
                  bool phases_of_32_bits) {
  using namespace slipfront::chain;
  const std::size_t n = u.size();
  Problem problem;
  problem.grid = {0, spacing, n};
  problem.model = Model::lattice;
  problem.boundary.left = problem.boundary.right = End::fixed;
  problem.step = dt;
  problem.phases_of_32_bits = phases_of_32_bits;
  Levels levels{0, u, u};
  for (std::size_t j = 0; j < n; ++j) {
    levels.now[j] = u[j] / turn;
    levels.before[j] = (u[j] - (j > 0 && j + 1 < n ? dt * velocity[j] : 0)) / turn;
  }
  slipfront::chain::ExplicitChain run(problem, levels);
  const std::clock_t begun = std::clock();
  run.advance(steps);
  const double seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
  u = run.levels().now;
  for (double& value : u) value *= turn;
  return seconds;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  const std::string path = argv[1];
  const double spacing = std::stod(argv[2]), dt = std::stod(argv[3]);
  const long steps = std::stol(argv[4]);
  std::vector<double> u = read(path);
  const std::size_t n = u.size() / 2;
  std::vector<double> velocity(std::next(u.begin(), static_cast<std::ptrdiff_t>(n)), u.end());
  u.resize(n);

  // With velocities half a step before the start, leapfrog does the same steps as velocity Verlet. The ends are fixed.
  for (std::size_t j = 1; j + 1 < n; ++j) velocity[j] -= dt / 2 * acceleration(u, j, spacing);

  const double seconds = argv[5] == std::string("plain")
                             ? plain(u, velocity, spacing, dt, steps)
                             : by_library(u, velocity, spacing, dt, steps, argv[5] == std::string("single"));
  std::ofstream(path + ".out", std::ios::binary)
      .write(reinterpret_cast<const char*>(u.data()), static_cast<std::streamsize>(n * sizeof(double)));
  std::printf("%.9g\n", seconds);
}
