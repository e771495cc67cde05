// A chain of scale s solves the same problem with friction divided by s. Every law that a scenario can name must scale
// like this. The test covers each law that is added to friction::laws(), and it fails if a parameter has a wrong
// Dimension.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "friction/state/contacts.hpp"
#include "law_values.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

constexpr double scales[] = {0.3, 7, 1000};

double curve(double speed) { return 0.2 + speed / (1 + speed * speed); }

/// A law and its scaled version for a chain, each with the state variables at a few positions.
class Pair {
 public:
  static constexpr std::size_t positions = 5;
  static constexpr double speed[positions] = {0, 1e-6, 0.02, 0.4, 3}, share[positions] = {0.3, 0.5, 0.7, 0.9, 1};

  Pair(const Friction& friction, double scale)
      : one(friction), many(friction.scaled_by(scale)), scale_(scale), each_(friction.state_size()) {
    one_state_.resize(positions * each_);
    for (std::size_t i = 0; i < positions; ++i) one.evolution().start(std::span(one_state_).subspan(i * each_, each_));
    many_state_.resize(positions * each_);
    for (std::size_t i = 0; i < positions; ++i)
      many.evolution().start(std::span(many_state_).subspan(i * each_, each_));
  }

  /// Lets every position slip at its own speed for a time.
  void slip(double time) {
    one.evolution().advance_all(positions, Slips::at(speed), time, {one_state_.data(), each_});
    many.evolution().advance_all(positions, Slips::at(speed), scale_ * time, {many_state_.data(), each_});
  }
  void slip_in_trains(double time) {
    const double typical[] = {0, 2e-6, 0.03, 0.3, 4};
    one.evolution().advance_all(positions, {speed, typical}, time, {one_state_.data(), each_});
    many.evolution().advance_all(positions, {speed, typical}, scale_ * time, {many_state_.data(), each_});
  }

  void expect_equal_forces(const std::string& when) const {
    const LocalStates a{one_state_.data(), each_}, b{many_state_.data(), each_};
    for (std::size_t i = 0; i < positions; ++i) {
      const State train{0.1 + 0.2 * static_cast<double>(i), 0.7};
      near(many.force(speed[i], b.at(i)), one.force(speed[i], a.at(i)) / scale_, "force " + when);
      near(many.velocity_after(speed[i], 0.7 * scale_, b.at(i)), one.velocity_after(speed[i], 0.7, a.at(i)),
           "velocity_after " + when);
      near(many.mean_strength(train, 0.8, b.at(i)), one.mean_strength(train, 0.8, a.at(i)) / scale_,
           "mean_strength " + when);
      near((*many.relaxation_rate())(train, 0.8, b.at(i)), (*one.relaxation_rate())(train, 0.8, a.at(i)) / scale_,
           "relaxation_rate " + when);
    }
    expect_equal_arrays(a, b, when);
  }

  void expect_equal_numbers() const {
    EXPECT_EQ(many.acts(), one.acts());
    EXPECT_EQ(many.steep_at_rest(), one.steep_at_rest());
    near(many.strength_at_rest(), one.strength_at_rest() / scale_, "strength_at_rest");
    near(many.linear_coefficient().value_or(0), one.linear_coefficient().value_or(0) / scale_, "linear_coefficient");
    near(many.constant_strength().value_or(0), one.constant_strength().value_or(0) / scale_, "constant_strength");
    near(many.contact_at_start(0), one.contact_at_start(0), "contact_at_start");
    near(many.contact_growth(scale_ * 3), one.contact_growth(3), "contact_growth");
    near(many.contacts().strength(2 * scale_, 0.01), one.contacts().strength(2, 0.01), "contacts' strength");
    near(many.contacts().excess_after(0.3 * scale_, 0.01, 2 * scale_, 0.7 * scale_),
         one.contacts().excess_after(0.3, 0.01, 2, 0.7), "pore pressure");
  }

  const Friction one, many;

 private:
  void near(double value, double wanted, const std::string& what) const {
    EXPECT_NEAR(value, wanted, 1e-9 * std::fabs(wanted)) << one.name() << ", scale " << scale_ << ": " << what;
  }

  void expect_equal_arrays(LocalStates a, LocalStates b, const std::string& when) const {
    const double s[positions] = {0.1, 0.2, 0.3, 0.5, 0.9}, fastest[positions] = {1e-6, 0.02, 0.1, 0.4, 3};
    using Call = std::function<void(const Law&, LocalStates, double scale, double* out)>;
    const auto compare = [&](const char* name, bool is_force, const Call& call) {
      double of_one[positions], of_many[positions];
      call(one.law(), a, 1, of_one);
      call(many.law(), b, scale_, of_many);
      for (std::size_t i = 0; i < positions; ++i)
        near(of_many[i], is_force ? of_one[i] / scale_ : of_one[i], name + (" " + when));
    };
    compare("strengths", true, [&](const Law& law, LocalStates state, double, double* out) {
      law.loops().strengths(positions, speed, state, out);
    });
    compare("speeds_after", false, [&](const Law& law, LocalStates state, double scale, double* out) {
      law.loops().speeds_after(positions, speed, 0.7 * scale, state, out);
    });
    compare("speeds_after_under", false, [&](const Law& law, LocalStates state, double scale, double* out) {
      law.loops().speeds_after_under(positions, share, speed, 0.7 * scale, state, out);
    });
    compare("mean_strengths", true, [&](const Law& law, LocalStates state, double, double* out) {
      law.average().mean_strengths({positions, fastest, s, state}, one.closure(), out, nullptr);
    });
  }

  double scale_;
  std::size_t each_;
  std::vector<double> one_state_, many_state_;
};

TEST(FrictionScaling, DividesTheForceOfEveryLawByTheScale) {
  for (const Definition* law : laws())
    for (std::size_t word = 0; word < law_words(*law); ++word)
      for (const Closure closure : {Closure::consistent, Closure::paper})
        for (const double scale : scales) {
          const Friction friction(*law,
                                  law_values(*law, word, {.force = 0.3, .slip = 2.3, .time = 1.7, .velocity = 0.05}),
                                  closure, law->curve == CurveSource::none ? Curve() : Curve(curve));
          if (!friction.defined_by(closure)) continue;
          EXPECT_EQ(friction.acts(), !law->parameters.empty()) << law->name;
          Pair pair(friction, scale);
          pair.expect_equal_numbers();
          pair.expect_equal_forces("at the start");
          pair.slip(0.8);
          pair.expect_equal_forces("after slip");
          pair.slip_in_trains(1.3);
          pair.expect_equal_forces("after slip in trains");
        }
}

/// The law f = f_0 (1 + s / D) + eta w, whose strength rises with the slip s. Each test chooses the dimensions of the
/// parameters.
class Example final : public Law {
 public:
  explicit Example(const std::vector<double>& v) : f0_(v[0]), eta_(v[1]), D_(v[2]) {}
  double strength(double speed, LocalState slip) const override { return f0_ * (1 + slip[0] / D_) + eta_ * speed; }
  const StateEvolution& evolution() const override { return evolution_; }

 private:
  class PathLength final : public StateEvolution {
    void start(std::span<double> path) const override { path[0] = 0; }
    void advance(const Slip& slip, double time, std::span<double> path) const override {
      path[0] += std::fabs(slip.mean) * time;
    }
  };
  PathLength evolution_;
  double f0_, eta_, D_;
};

Definition example(Dimension strength, Dimension viscosity, Dimension slip) {
  return {.name = "example",
          .adjective = "example",
          .equation = "f = f_0 (1 + s / D) + eta w",
          .source = "",
          .parameters = {{.name = "strength", .symbol = "f_0", .unit = force_unit, .dimension = strength},
                         {.name = "viscosity", .symbol = "eta", .unit = "1", .dimension = viscosity},
                         {.name = "distance", .symbol = "D", .unit = "b / (2 pi)", .dimension = slip}},
          .state = {{.name = "slipped", .symbol = "s", .unit = "b / (2 pi)"}},
          .make = make_law<Example>};
}

std::string refusal_of(const Definition& law, const std::vector<double>& values) {
  try {
    EXPECT_NO_THROW((void)Friction(law, values).scaled_by(1));
    (void)Friction(law, values).scaled_by(100);
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().key, "friction");
    EXPECT_EQ(error.complaint().value, "example");
    return error.complaint().problem;
  }
  return "";
}

TEST(FrictionScaling, RejectsALawWithAWrongDimension) {
  const std::vector<double> values = {0.1, 0.5, 2};
  const Definition right = example(Dimension::force, Dimension::force, Dimension::slip);
  EXPECT_EQ(refusal_of(right, values), "");
  Pair(Friction(right, values), 100).expect_equal_forces("with the right dimensions");
  // If the viscosity is declared as a number, the chain has 0.1 / 100 + 0.5 w instead of (0.1 + 0.5 w) / 100.
  const Definition number = example(Dimension::force, Dimension::number, Dimension::slip);
  EXPECT_EQ(refusal_of(number, values),
            "on a chain of scale 100 its force at w = 10 is 5.001 in place of f / scale = 0.051");
  for (const Dimension wrong : {Dimension::number, Dimension::velocity, Dimension::force})
    EXPECT_NE(refusal_of(example(Dimension::force, Dimension::force, wrong), values), "");
  for (const Dimension wrong : {Dimension::number, Dimension::velocity, Dimension::time})
    EXPECT_NE(refusal_of(example(wrong, Dimension::force, Dimension::slip), values), "");
}

/// A law that takes a curve is checked with one.
TEST(FrictionScaling, RejectsACurveWithoutAForceParameter) {
  for (const Definition* known : laws()) {
    if (known->curve == CurveSource::none) continue;
    Definition law = *known;
    EXPECT_NO_THROW(Friction(law, {0.5}, Closure::consistent, curve));
    law.parameters[0].dimension = Dimension::number;
    EXPECT_THROW(Friction(law, {0.5}, Closure::consistent, curve), InputError) << law.name;
  }
}

/// The law f = eta w, with a strength at rest.
class Sticking final : public Law {
 public:
  explicit Sticking(const std::vector<double>& v) : strength_(v[0]), eta_(v[1]) {}
  double strength(double speed, LocalState) const override { return speed == 0 ? strength_ : eta_ * speed; }

 private:
  double strength_, eta_;
};

TEST(FrictionScaling, RejectsALawWithAWrongDimensionAtRest) {
  Definition law = example(Dimension::force, Dimension::force, Dimension::slip);
  law.make = make_law<Sticking>;
  EXPECT_EQ(refusal_of(law, {0.1, 0.5, 2}), "");
  law.parameters[0].dimension = Dimension::number;
  EXPECT_EQ(refusal_of(law, {0.1, 0.5, 2}),
            "on a chain of scale 100 its force at w = 0 is 0.1 in place of f / scale = 0.001");
}

/// Without a positive parameter that is a force, the solvers would ignore friction, as if the law were "none".
TEST(FrictionScaling, RejectsAForceWithoutAForceParameter) {
  const Definition law = example(Dimension::number, Dimension::number, Dimension::slip);
  EXPECT_THROW(Friction(law, {0, 0.5, 2}), InputError);
  EXPECT_THROW(Friction(law, {0.1, 0, 2}), InputError);
  EXPECT_NO_THROW(Friction(law, {0, 0, 2}));
}

}  // namespace
}  // namespace slipfront::friction
