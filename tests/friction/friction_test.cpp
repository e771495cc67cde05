#include "slipfront/friction/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "reference_table.hpp"
#include "slipfront/error.hpp"
#include "slipfront/theory/train.hpp"

namespace {

using namespace slipfront;
using namespace slipfront::friction;

/// The test computes <f(w) sigma> and <f(w)> by quadrature over the fields.
TEST(Friction, AveragesTheForceOverTheFields) {
  const State states[] = {{0.3, 0.2}, {-0.7, 0.9}, {1.1, 0.02}, {0.05, 2.5}};
  for (const State& s : states)
    for (const double n : {0.5, 1.0, 2.0, 3.3}) {
      const double length = train::spacing(s);
      constexpr int points = 4000;
      double f_sigma = 0, f = 0, k = 0;
      for (int i = 0; i < points; ++i) {
        const train::Fields at = train::fields(s, length * i / points);
        const double force = 0.7 * std::copysign(std::pow(std::fabs(at.w), n), at.w);
        f_sigma += force * at.sigma / points;
        f += force / points;
        k += at.sigma / points;
      }
      const auto law = [n](Closure c) { return n == 1 ? viscous(0.7, c) : power(0.7, n, c); };
      EXPECT_NEAR(law(Closure::consistent).momentum_loss(s) / f_sigma, 1, 1e-10) << n << " " << s.psi;
      EXPECT_NEAR(law(Closure::paper).momentum_loss(s) / (k * f), 1, 1e-10) << n << " " << s.psi;
      EXPECT_NEAR(coulomb(0.7).momentum_loss(s), std::copysign(0.7 * k, s.phi), 1e-10 * k);
    }
}

TEST(Friction, ReducesPowersOneAndTwoToClosedForms) {
  for (const double psi : {1e-200, 1e-9, 0.01, 0.5, 4.0}) {
    const State s{0.4, psi};
    for (const Closure closure : {Closure::consistent, Closure::paper}) {
      const double linear = viscous(1, closure).momentum_loss(s);
      EXPECT_NEAR(power(1, 1, closure).momentum_loss(s) / linear, 1, 1e-13) << psi;
    }
    const train::Averages a = train::averages(s);
    const double U = std::tanh(0.4);
    EXPECT_NEAR(power(1, 2, Closure::consistent).momentum_loss(s) / (U * U * a.sigma3), 1, 1e-13) << psi;
  }
}

TEST(Friction, OpposesMotionAndVanishesAtRest) {
  for (const Friction& friction : {viscous(2), coulomb(2), power(2, 2)}) {
    EXPECT_EQ(friction.momentum_loss({0, 0.3}), 0);
    EXPECT_EQ(friction.momentum_loss({1, 0}), 0);
    EXPECT_EQ(friction.momentum_loss({-0.3, 0.3}), -friction.momentum_loss({0.3, 0.3}));
    EXPECT_EQ(friction.force(-0.3), -friction.force(0.3));
    EXPECT_EQ(friction.force(0), 0);
  }
}

/// The ratio of the closures is I / W = 4 E K / pi^2 (docs/theory/3_modulation.md 3.3).
TEST(Friction, LosesLessMomentumWithTheClosureOfThePaper) {
  const State s{0.2, 1e-3};
  const train::Averages a = train::averages(s);
  EXPECT_NEAR(viscous(1, Closure::consistent).momentum_loss(s) / viscous(1, Closure::paper).momentum_loss(s), a.I / a.W,
              1e-14);
}

/// The relaxation rate from the loss of momentum, where P / k = 8 sinh phi cosh psi E / (2 pi).
double rate_of(const Friction& f, const State& s, double contact) {
  return f.momentum_loss(s, contact) / train::averages(s, contact).P;
}

TEST(Friction, TabulatesTheRelaxationRateOfAPower) {
  for (const double n : {0.3, 0.7, 1.0, 1.5, 2.0, 5.0})
    for (const Closure closure : {Closure::consistent, Closure::paper}) {
      const Friction friction = power(0.7, n, closure);
      const auto rate = friction.relaxation_rate();
      for (const double psi : {1e-250, 1e-20, 1e-6, 1e-3, 0.011, 0.3, 0.97, 1.7, 4.3, 12.0, 25.0})
        for (const double phi : {-2.0, 1e-3, 0.4})
          for (const double a : {1.0, 0.4})
            EXPECT_NEAR((*rate)({phi, psi}, a, {}) / rate_of(friction, {phi, psi}, a), 1, 1e-9)
                << n << " " << psi << " " << phi;
    }
}

TEST(Friction, FindsTheRelaxationRatesOfManyTrains) {
  constexpr std::size_t size = 150;  // more than the loops treat at once
  for (const double n : {0.6, 2.0})
    for (const Closure closure : {Closure::consistent, Closure::paper}) {
      const auto rate = power(0.7, n, closure).relaxation_rate();
      std::vector<double> fastest, psi, rates(size);
      for (std::size_t i = 0; i < size; ++i) {
        psi.push_back(std::exp(-5 + 0.05 * static_cast<double>(i)));
        fastest.push_back(2 * std::sinh(0.01 * static_cast<double>(i)) * std::cosh(psi[i]));
      }
      ASSERT_TRUE(rate->tabulated());
      rate->rates(size, fastest.data(), psi.data(), rates.data());
      EXPECT_EQ(rates[0], 0);
      for (std::size_t i = 1; i < size; ++i)
        EXPECT_NEAR(rates[i] / (*rate)({0.01 * static_cast<double>(i), psi[i]}, 1, {}), 1, 1e-12) << n << " " << i;
    }
}

/// The law f = C |w|^n, which defines only its force. The library must compute all the rest numerically.
class Bare : public Law {
 public:
  explicit Bare(const std::vector<double>& values) : C_(values[0]), n_(values[1]) {}
  double strength(double speed, LocalState) const override { return C_ * std::pow(speed, n_); }

 private:
  double C_, n_;
};

const Definition& bare_law() {
  static const Definition definition{
      .name = "bare",
      .adjective = "bare",
      .equation = "f = C |w|^n",
      .source = "",
      .parameters = {{.name = "coefficient", .symbol = "C", .unit = "", .dimension = friction::Dimension::force},
                     {.name = "exponent", .symbol = "n", .unit = ""}},
      .make = make_law<Bare>};
  return definition;
}

TEST(Friction, AveragesAnyLawLikeTheClosedForms) {
  for (const Closure closure : {Closure::consistent, Closure::paper})
    for (const double n : {0.0, 0.5, 1.0, 2.0, 3.3}) {
      const Friction any(bare_law(), {0.7, n}, closure);
      const Friction known = n == 0 ? coulomb(0.7, closure) : n == 1 ? viscous(0.7, closure) : power(0.7, n, closure);
      EXPECT_EQ(any.sticks(), n == 0);
      // The closed form cuts off the tails of powers below 1.
      const double tolerance = n > 0 && n < 1 ? 1e-8 : 1e-12;
      const auto rate = any.relaxation_rate();
      for (const double psi : {1e-250, 1e-20, 1e-6, 0.011, 0.97, 4.3, 25.0, 30.0})
        for (const double phi : {1e-12, 0.4, 2.0})
          for (const double a : {1.0, 0.4}) {
            const State s{phi, psi};
            EXPECT_NEAR(any.mean_strength(s, a) / known.mean_strength(s, a), 1, tolerance)
                << n << " " << psi << " " << phi;
            EXPECT_NEAR((*rate)(s, a, {}) / rate_of(known, s, a), 1, tolerance) << n << " " << psi << " " << phi;
          }
    }
  const Friction linear(bare_law(), {0.7, 1});
  EXPECT_NEAR((*linear.relaxation_rate())({0, 1e-9}, 1, {}), 0.7, 1e-12);  // the limit at rest
}

TEST(Friction, SolvesAnyLawLikeTheClosedForms) {
  for (const double n : {0.0, 0.5, 1.0, 2.0, 3.3})
    for (const double weight : {1e-6, 0.1, 30.0})
      for (const double free : {-2.0, 0.0, 1e-9, 0.04, 7.0}) {
        const Friction any(bare_law(), {0.7, n});
        const Friction known = n == 0 ? coulomb(0.7) : n == 1 ? viscous(0.7) : power(0.7, n);
        const double want = known.velocity_after(free, weight);
        EXPECT_NEAR(any.velocity_after(free, weight), want, 4e-16 * std::fabs(free) + 1e-15 * std::fabs(want))
            << n << " " << weight << " " << free;
      }
}

TEST(Friction, DividesForcesByTheScale) {
  const Friction scaled = power(3, 1.5, Closure::paper).scaled_by(2);
  EXPECT_EQ(scaled.parameter("coefficient"), 1.5);
  EXPECT_EQ(scaled.parameter("exponent"), 1.5);
  EXPECT_EQ(scaled.closure(), Closure::paper);
  EXPECT_FALSE(Friction().acts());
  EXPECT_FALSE(viscous(0).acts());
}

const Definition& law_named(const std::string& name) {
  for (const Definition* law : laws())
    if (law->name == name) return *law;
  throw std::runtime_error("no law " + name);
}

/// The reference values are means over slip by mpmath, for random laws and random trains.
TEST(Friction, AgreesWithMeansOfHighPrecision) {
  for (const auto& row : reference_table("friction.csv")) {
    const Definition& law = law_named(row.text("law"));
    std::vector<double> values;
    for (const Parameter& p : law.parameters)
      values.push_back(values.size() < 5 ? row["v" + std::to_string(values.size())] : p.value);
    const Friction friction(law, values);
    const double theta[] = {row["theta"]};
    const LocalState state = friction.state_size() > 0 ? LocalState(theta) : LocalState();
    EXPECT_NEAR(friction.mean_strength({row["phi"], row["psi"]}, 1, state) / row["mean"], 1, 1e-10)
        << row.text("law") << " phi " << row["phi"] << " psi " << row["psi"];
  }
}

/// f = a asinh((w / 2 w_0) exp((f_0 + b ln(theta w_0 / D_c)) / a)).
Friction rate_and_state(double f0, double a, double b, double D, double w0, bool slip_law = false) {
  return {law_named("rate-and-state"), {f0, a, b, D, w0, 0, slip_law ? 1.0 : 0.0}};
}

/// If w is not small, the force is linear in ln w, and <ln w>_u = ln sinh phi + psi. So the mean is the force at the
/// speed sinh phi exp psi.
TEST(Friction, MeanOfRateAndStateIsTheForceAtOneSpeed) {
  const Friction friction = rate_and_state(0.6, 0.01, 0.015, 0.1, 0.05);
  const double theta[] = {3.0};
  for (const double psi : {0.01, 0.3, 2.0})
    for (const double phi : {0.01, 0.5, 2.0})
      EXPECT_NEAR(friction.mean_strength({phi, psi}, 1, theta) / friction.force(std::sinh(phi) * std::exp(psi), theta),
                  1, 1e-14);
}

TEST(Friction, AgesAtRestAndTendsToTheSteadyState) {
  double theta[] = {0.2};
  const Friction ageing = rate_and_state(0.05, 0.01, 0.015, 0.1, 0.05);
  ageing.evolution().advance(Slip::at(0), 3, theta);
  EXPECT_DOUBLE_EQ(theta[0], 3.2);
  for (const bool slip_law : {false, true}) {
    const Friction friction = rate_and_state(0.05, 0.01, 0.015, 0.1, 0.05, slip_law);
    double once[] = {0.7}, twice[] = {0.7};
    friction.evolution().advance(Slip::at(-0.3), 0.5, once);  // exact, so two steps equal one
    friction.evolution().advance(Slip::at(-0.3), 0.2, twice);
    friction.evolution().advance(Slip::at(-0.3), 0.3, twice);
    EXPECT_NEAR(once[0] / twice[0], 1, 1e-14);
    friction.evolution().advance(Slip::at(0.3), 100, once);
    EXPECT_NEAR(once[0] / (0.1 / 0.3), 1, 1e-13);
    double still[] = {0.7};
    friction.evolution().advance(Slip::at(0), 5, still);
    EXPECT_EQ(still[0], slip_law ? 0.7 : 5.7);
  }
}

/// The reference lets one dislocation pass after the other. D_c is the slip of many dislocations, so theta hardly
/// changes while one passes.
TEST(Friction, AdvancesStateInATrainAsTheMeanOverDislocations) {
  const State train{0.4, 0.3};
  const double D = 500, typical = std::sinh(train.phi) * std::exp(train.psi), W = train::averages(train).W;
  const double length = train::spacing(train), passage = length / std::tanh(train.phi);
  for (const bool slip_law : {false, true}) {
    const Friction friction = rate_and_state(0.05, 0.01, 0.015, D, 0.05, slip_law);
    double every[] = {200}, mean[] = {200};
    constexpr int steps = 400, passages = 40;
    for (int i = 0; i < steps * passages; ++i) {
      const double w = train::fields(train, length * (i % steps + 0.5) / steps).w;
      friction.evolution().advance(Slip::at(w), passage / steps, every);
    }
    friction.evolution().advance({W, typical}, passage * passages, mean);
    EXPECT_GT(std::fabs(every[0] / 200 - 1), 0.05) << slip_law;
    EXPECT_NEAR(every[0] / mean[0], 1, 1e-3) << slip_law;
  }
}

TEST(Friction, SolvesRateAndStateForTheSpeedAfterAStep) {
  const Friction friction = rate_and_state(0.5, 0.01, 0.015, 0.1, 0.05);
  const double theta[] = {2.0};
  for (const double weight : {1e-6, 0.1, 30.0})
    for (const double free : {-2.0, 1e-9, 0.04, 7.0}) {
      const double v = friction.velocity_after(free, weight, theta);
      EXPECT_NEAR(v + weight * friction.force(v, theta), free, 1e-9 * std::fabs(free)) << weight << " " << free;
      EXPECT_GE(v / free, 0);
    }
}

TEST(Friction, WeakensStrengthWithSlip) {
  const Friction friction(law_named("slip-weakening"), {0.4, 0.1, 2});
  double slip[] = {0};
  friction.evolution().start(slip);
  EXPECT_TRUE(friction.sticks());
  EXPECT_EQ(friction.force(1, slip), 0.4);
  friction.evolution().advance(Slip::at(-0.5), 2, slip);
  EXPECT_DOUBLE_EQ(friction.force(1, slip), 0.25);
  friction.evolution().advance(Slip::at(0.5), 20, slip);
  EXPECT_DOUBLE_EQ(friction.force(1, slip), 0.1);
}

/// The tails of dislocations are so slow that v = (free / C)^2 is too small for a double.
TEST(Friction, StopsTheSlowestMotionIfTheExponentIsBelowOne) {
  for (const double free : {1e-300, 1e-170, 1e-160}) {
    const double v = power(0.1, 0.5).velocity_after(free, 1, {});
    EXPECT_GE(v, 0) << free;
    EXPECT_LT(v, free);
  }
}

TEST(Friction, ScalesForcesSlipsAndTimes) {
  const Friction scaled =
      Friction(law_named("rate-and-state"), {8, 4, 2, 1, 3, 5, 0, 0.1, 6, 0.2, 8, 0.3}).scaled_by(2);
  const double want[] = {4, 2, 1, 2, 3, 10, 0, 0.1, 12, 0.2, 16, 0.3};
  std::size_t i = 0;
  for (const Parameter& p : scaled.definition().parameters) EXPECT_EQ(scaled.parameter(p.name), want[i++]) << p.name;
}

TEST(Friction, DescribesEveryLaw) {
  for (const Definition* law : laws()) {
    EXPECT_FALSE(law->name.empty());
    EXPECT_FALSE(law->equation.empty()) << law->name;
    std::vector<double> values;
    for (const Parameter& p : law->parameters) {
      EXPECT_FALSE(p.unit.empty()) << law->name << " " << p.name;
      values.push_back(p.dimension == Dimension::force ? 1 : p.value);
    }
    const Friction friction(*law, values);
    EXPECT_EQ(friction.acts(), !values.empty());
  }
}

}  // namespace
