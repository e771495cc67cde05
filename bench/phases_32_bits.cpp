// Compares a chain with phases of 32 bits with the chain in doubles (docs/chain.md, "Phases in 32 bits"): differences,
// energy and speed. Usage: phases_32_bits [LARGEST_SCALE], by default 1000.
//
// Problems: a train at rest with a step of stress 0.855 into an empty interface, to t = 2 pi, and a kink with U = 0.5.

#include "phases_32_bits.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lattice/chain/explicit/explicit_chain.hpp"
#include "lattice/chain/model/initial_train.hpp"
#include "lattice/chain/observe/totals.hpp"
#include "math/constants.hpp"

namespace {

using namespace phases;

struct Candidate {
  const char* name;
  std::function<std::unique_ptr<Stepper>(const Levels&, const Scheme&)> make;
};
template <class S>
Candidate candidate(const char* name) {
  return {name, [](const Levels& s, const Scheme& r) { return std::make_unique<S>(s, r); }};
}
const std::vector<Candidate> candidates{candidate<Reals<double>>("double"),
                                        candidate<Phases<Steps::whole>>("integers"),
                                        candidate<Phases<Steps::measured>>("integers, work"),
                                        candidate<Phases<Steps::remainder>>("integers, remainder"),
                                        candidate<Phases<Steps::floating>>("integer z, float steps"),
                                        candidate<Reals<float>>("float")};

/// The sum of D^2 + B^2 / 12 over sites, with the step D of u, and B = D less the step before.
SLIPFRONT_CLONES double squares(const PeriodicForce& force, double eps, std::size_t n, const double* z, double* u,
                                double* step) {
  const PeriodicForce f = force;
  double sums[8] = {};
  for (std::size_t j = 0; j + 8 <= n; j += 8) {
    SLIPFRONT_INDEPENDENT
    for (std::size_t k = 0; k < 8; ++k) {
      const double to = z[j + k] - eps * f(z[j + k]), D = to - u[j + k], B = D - step[j + k];
      sums[k] += D * D + B * B / 12;
      u[j + k] = to;
      step[j + k] = D;
    }
  }
  return sums[0] + sums[1] + sums[2] + sums[3] + sums[4] + sums[5] + sums[6] + sums[7];
}

/// Work of viscous friction, as WorkMeter measures it, if `add` gets the phases at every level.
class Dissipation {
 public:
  Dissipation(const Problem& p, const Levels& l) : scheme_(scheme_of(p)), u_(l.now.size()), steps_(l.now.size()) {
    factor_ = p.friction.linear_coefficient().value_or(0) * p.grid.spacing * turn * turn / scheme_.dt;
    add(l.before);
    add(l.now);
    sum_ = 0;
  }
  bool acts() const { return factor_ > 0; }
  void add(const std::vector<double>& z) {
    sum_ += squares(scheme_.rule.f, scheme_.eps, z.size(), z.data(), u_.data(), steps_.data());
  }
  double energy() const { return energy(sum_); }
  double energy(double sum_of_squares) const { return factor_ * sum_of_squares; }

 private:
  Scheme scheme_;
  std::vector<double> u_, steps_;
  double factor_ = 0, sum_ = 0;
};

/// The state of a chain at one time.
struct Seen {
  double slip, energy;
  std::vector<double> positions;  ///< positions of dislocations, from the left
};

Seen see(const Problem& p, const Levels& levels, double width) {
  const ExplicitChain chain(p, levels);
  Seen seen{0, totals(chain).energy(), {}};
  const Window w = chain.window(0, p.grid.sites);
  std::size_t sites = 0;
  for (std::size_t j = 0; j + 1 < w.u.size(); ++j) {
    if (std::fabs(w.x[j]) <= width / 2) {
      seen.slip += w.u[j];
      ++sites;
    }
    const double a = w.u[j] / turn - 0.5, b = w.u[j + 1] / turn - 0.5, wall = std::fmax(std::floor(a), std::floor(b));
    if (std::floor(a) != std::floor(b)) seen.positions.push_back(w.x[j] + p.grid.spacing * (a - wall) / (a - b));
  }
  seen.slip /= static_cast<double>(std::max<std::size_t>(sites, 1));
  return seen;
}

struct Course {
  std::vector<Seen> seen;
  double drift = 0;  ///< largest |energy + dissipated - energy at the start| over the latter
};

Course follow(const Problem& p, const Levels& start, Stepper& stepper, long steps, double width) {
  Dissipation dissipation(p, start);
  Course c;
  std::vector<double> z;
  c.seen.push_back(see(p, start, width));
  constexpr long outputs = 32;
  for (long i = 1, done = 0; i <= outputs; ++i) {
    const long until = steps * i / outputs;
    if (dissipation.acts() && !stepper.squares())
      for (; done < until; ++done) {
        stepper.advance(1);
        stepper.phases(z);
        dissipation.add(z);
      }
    stepper.advance(until - std::exchange(done, until));
    c.seen.push_back(see(p, stepper.levels(), width));
    const double first = c.seen[0].energy,
                 work = stepper.squares() ? dissipation.energy(*stepper.squares()) : dissipation.energy();
    c.drift = std::fmax(c.drift, std::fabs((c.seen.back().energy + work) / first - 1));
  }
  return c;
}

/// Largest differences over all outputs.
void print_row(const char* problem, const char* name, const Course& c, const Course& reference, double scale) {
  double slip = 0, energy = 0, front = 0, any = 0;
  const double final_slip = std::fabs(reference.seen.back().slip - reference.seen[0].slip);
  for (std::size_t i = 0; i < c.seen.size(); ++i) {
    const Seen &a = c.seen[i], &b = reference.seen[i];
    slip = std::fmax(slip, std::fabs(a.slip - b.slip) / final_slip);
    energy = std::fmax(energy, std::fabs(a.energy / b.energy - 1));
    if (a.positions.size() != b.positions.size()) any = front = INFINITY;
    if (std::isinf(any)) continue;
    front = std::fmax(front, std::fabs(a.positions.back() - b.positions.back()) / scale);
    for (std::size_t k = 0; k < a.positions.size(); ++k)
      any = std::fmax(any, std::fabs(a.positions[k] - b.positions[k]) / scale);
  }
  std::printf("%-28s %-23s %8.1e %8.1e %8.1e %8.1e %9.1e\n", problem, name, slip, front, any, energy, c.drift);
  std::fflush(stdout);
}

void compare(const std::string& name, const Problem& p, const Levels& start, long steps, double width, double scale) {
  Course reference;
  for (const Candidate& candidate : candidates) {
    const auto stepper = candidate.make(start, scheme_of(p));
    if (stepper->squares() && !p.friction.acts()) continue;
    const Course c = follow(p, start, *stepper, steps, width);
    if (&candidate == candidates.data()) reference = c;
    print_row(name.c_str(), candidate.name, c, reference, scale);
  }
}

Problem problem(double left, double right, double C) {
  Problem p;
  const auto vectors = static_cast<std::size_t>((right - left) / default_spacing / lanes_32) + 1;
  p.grid = {left, default_spacing, vectors * lanes_32};
  p.boundary.left = p.boundary.right = End::fixed;
  if (C > 0) p.friction = friction::viscous(C);
  return p;
}

void step_of_stress(double scale, double C) {
  const Problem p = problem(-6 * scale, 6 * scale, C / scale);
  const ExplicitChain chain(p, StaticTrain([](double x) { return x < 0 ? 0.855 : 0.0; }, p.grid));
  const long steps = std::lround(turn * scale / chain.dt());
  const std::string name = "step, scale " + std::to_string(std::lround(scale)) + (C > 0 ? ", viscous" : "");
  compare(name, p, chain.levels(), steps, turn / 0.855, scale);
}

void kink(long steps) {
  constexpr double U = 0.5;
  const double path = U * default_spacing * static_cast<double>(steps), g = 1 / std::sqrt(1 - U * U);
  const Problem p = problem(-100, path + 100, 0);
  Motion m;
  for (std::size_t j = 0; j < p.grid.sites; ++j) {
    const double x = p.grid.x(j);
    m.u.push_back(4 * std::atan(std::exp(-g * x)));
    m.velocity.push_back(2 * g * U / std::cosh(g * x));
  }
  compare("kink, " + std::to_string(steps) + " steps", p, ExplicitChain(p, m).levels(), steps, 10, path);
}

double seconds(const std::function<void()>& task) {
  const auto start = std::chrono::steady_clock::now();
  task();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Site updates a second, without and with viscous friction. All take turns; the least time of each counts.
void speeds(std::size_t sites, double C) {
  const double reach = default_spacing * static_cast<double>(sites) / 2;
  const Problem p = problem(-reach, reach, C);
  ExplicitChain chain(p, StaticTrain([](double x) { return x < 0 ? 0.855 : 0.0; }, p.grid));
  const long steps = 32 * (1000000 / static_cast<long>(sites));
  std::vector<std::unique_ptr<Stepper>> steppers;
  for (const Candidate& c : candidates) steppers.push_back(c.make(chain.levels(), scheme_of(p)));
  std::vector<double> least(candidates.size() + 1, 1e9);
  for (int run = 0; run < 41; ++run) {
    for (std::size_t i = 0; i < steppers.size(); ++i)
      least[i] = std::min(least[i], seconds([&] { steppers[i]->advance(steps); }));
    least.back() = std::min(least.back(), seconds([&] { chain.advance(steps); }));
  }
  std::printf("%6zu sites, %-9s", sites, C > 0 ? "viscous" : "");
  for (const double time : least)
    std::printf(" %8.2f (%4.2f)", static_cast<double>(steps) * static_cast<double>(sites) / time / 1e9,
                least[0] / time);
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const double largest = argc > 1 ? std::atof(argv[1]) : 1000;
  std::printf("G site updates a second, and the ratio to doubles\n%-23s", "");
  for (const char* name : {"double", "integers", "with work", "remainder", "float steps", "float", "the library"})
    std::printf(" %15s", name);
  std::printf("\n");
  for (const std::size_t sites : {1400u, 10000u})
    for (const double C : {0.0, 1e-3}) speeds(sites, C);
  std::printf(
      "\nLargest differences from doubles over 32 outputs: slip over the final slip, position of the leading and of\n"
      "any dislocation over the scale, energy; and the largest error of the energy budget\n%-52s %8s %8s %8s %8s %9s\n",
      "", "slip", "front", "any", "energy", "budget");
  for (const double scale : {100.0, 300.0, 1000.0, 3000.0})
    for (const double C : {0.0, 0.5})
      if (scale <= largest) step_of_stress(scale, C);
  for (const long steps : {1000, 10000, 100000}) kink(steps);
}
