// A chain of scale s is the same problem with friction divided by s. Every law that a scenario can name has to scale
// so: a law that is added to friction::laws() is tested here as it is, and a parameter with a wrong Dimension fails.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "law_values.hpp"
#include "slipfront/error.hpp"
#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {
namespace {

constexpr double scales[] = {0.3, 7, 1000};

double curve(double speed) { return 0.2 + speed / (1 + speed * speed); }

/// A law and the same on a chain of some scale, each with the state of a few places.
class Pair {
 public:
  static constexpr std::size_t places = 5;
  static constexpr double speed[places] = {0, 1e-6, 0.02, 0.4, 3}, share[places] = {0.3, 0.5, 0.7, 0.9, 1};

  Pair(const Friction& friction, double scale)
      : one(friction), many(friction.scaled_by(scale)), scale_(scale), each_(friction.variables()) {
    one_state_.resize(places * each_);
    for (std::size_t i = 0; i < places; ++i) one.law().start(std::span(one_state_).subspan(i * each_, each_));
    many_state_.resize(places * each_);
    for (std::size_t i = 0; i < places; ++i) many.law().start(std::span(many_state_).subspan(i * each_, each_));
  }

  /// Slips every place at its own speed for a time.
  void slip(double time) {
    one.law().advance_all(places, speed, time, each_, one_state_.data());
    many.law().advance_all(places, speed, scale_ * time, each_, many_state_.data());
  }
  void slip_in_trains(double time) {
    const double typical[] = {0, 2e-6, 0.03, 0.3, 4};
    one.law().advance_in_trains(places, speed, typical, time, each_, one_state_.data());
    many.law().advance_in_trains(places, speed, typical, scale_ * time, each_, many_state_.data());
  }

  void expect_equal_forces(const std::string& when) const {
    const Memories a{one_state_.data(), each_}, b{many_state_.data(), each_};
    for (std::size_t i = 0; i < places; ++i) {
      const State train{0.1 + 0.2 * static_cast<double>(i), 0.7};
      near(many.force(speed[i], b.of(i)), one.force(speed[i], a.of(i)) / scale_, "force " + when);
      near(many.velocity_after(speed[i], 0.7 * scale_, b.of(i)), one.velocity_after(speed[i], 0.7, a.of(i)),
           "velocity_after " + when);
      near(many.mean_strength(train, 0.8, b.of(i)), one.mean_strength(train, 0.8, a.of(i)) / scale_,
           "mean_strength " + when);
      near((*many.relaxation_rate())(train, 0.8, b.of(i)), (*one.relaxation_rate())(train, 0.8, a.of(i)) / scale_,
           "relaxation_rate " + when);
    }
    expect_equal_arrays(a, b, when);
  }

  void expect_equal_numbers() const {
    EXPECT_EQ(many.acts(), one.acts());
    EXPECT_EQ(many.steep_at_rest(), one.steep_at_rest());
    near(many.strength_at_rest(), one.strength_at_rest() / scale_, "strength_at_rest");
    near(many.linear_coefficient().value_or(0), one.linear_coefficient().value_or(0) / scale_, "linear_coefficient");
    near(many.law().constant_strength().value_or(0), one.law().constant_strength().value_or(0) / scale_,
         "constant_strength");
    near(many.contact_at_start(), one.contact_at_start(), "contact_at_start");
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

  void expect_equal_arrays(Memories a, Memories b, const std::string& when) const {
    const double s[places] = {0.1, 0.2, 0.3, 0.5, 0.9}, fastest[places] = {1e-6, 0.02, 0.1, 0.4, 3};
    using Call = std::function<void(const Law&, Memories, double scale, double* out)>;
    const auto compare = [&](const char* name, bool is_force, const Call& call) {
      double of_one[places], of_many[places];
      call(one.law(), a, 1, of_one);
      call(many.law(), b, scale_, of_many);
      for (std::size_t i = 0; i < places; ++i)
        near(of_many[i], is_force ? of_one[i] / scale_ : of_one[i], name + (" " + when));
    };
    compare("strengths", true,
            [&](const Law& law, Memories state, double, double* out) { law.strengths(places, speed, state, out); });
    compare("speeds_after", false, [&](const Law& law, Memories state, double scale, double* out) {
      law.speeds_after(places, speed, 0.7 * scale, state, out);
    });
    compare("speeds_after_under", false, [&](const Law& law, Memories state, double scale, double* out) {
      law.speeds_after_under(places, share, speed, 0.7 * scale, state, out);
    });
    compare("mean_strengths", true, [&](const Law& law, Memories state, double, double* out) {
      law.mean_strengths({places, fastest, s, state}, one.closure(), out, nullptr);
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
          ASSERT_NO_THROW(friction.check()) << law->name;
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

/// f = f_0 + eta w, rising with slip: f_0 (1 + s / D). The dimensions of eta and D are those that a test gives.
class Example final : public Law {
 public:
  explicit Example(const std::vector<double>& v) : f0_(v[0]), eta_(v[1]), D_(v[2]) {}
  double strength(double speed, Memory slip) const override { return f0_ * (1 + slip[0] / D_) + eta_ * speed; }
  void start(std::span<double> slip) const override { slip[0] = 0; }
  void advance(double velocity, double time, std::span<double> slip) const override {
    slip[0] += std::fabs(velocity) * time;
  }

 private:
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
          .variables = {{.name = "slipped", .symbol = "s", .unit = "b / (2 pi)"}},
          .make = [](const std::vector<double>& values, const Curve&) -> std::shared_ptr<const Law> {
            return std::make_shared<Example>(values);
          }};
}

std::string refusal_of(const Definition& law, const std::vector<double>& values) {
  try {
    EXPECT_NO_THROW((void)Friction(law, values).scaled_by(1));
    (void)Friction(law, values).scaled_by(100);
  } catch (const InputError& error) {
    EXPECT_EQ(error.complaint().key, "friction.law");
    EXPECT_EQ(error.complaint().value, "example");
    return error.complaint().problem;
  }
  return "";
}

TEST(FrictionScaling, RefusesALawWithAWrongDimension) {
  const std::vector<double> values = {0.1, 0.5, 2};
  const Definition right = example(Dimension::force, Dimension::force, Dimension::slip);
  EXPECT_EQ(refusal_of(right, values), "");
  Pair(Friction(right, values), 100).expect_equal_forces("with the right dimensions");
  // A viscous term that is declared a number: the chain has 0.1 / 100 + 0.5 w in place of (0.1 + 0.5 w) / 100.
  const Definition number = example(Dimension::force, Dimension::number, Dimension::slip);
  EXPECT_EQ(refusal_of(number, values),
            "on a chain of scale 100 its force at w = 10 is 5.001 in place of f / scale = 0.051");
  for (const Dimension wrong : {Dimension::number, Dimension::velocity, Dimension::force})
    EXPECT_NE(refusal_of(example(Dimension::force, Dimension::force, wrong), values), "");
  for (const Dimension wrong : {Dimension::number, Dimension::velocity, Dimension::time})
    EXPECT_NE(refusal_of(example(wrong, Dimension::force, Dimension::slip), values), "");
}

/// Such friction would be left out, as if the law were "none".
TEST(FrictionScaling, RefusesAForceWithoutAParameterThatIsAForce) {
  const Definition law = example(Dimension::number, Dimension::number, Dimension::slip);
  EXPECT_THROW(Friction(law, {0, 0.5, 2}), InputError);
  EXPECT_THROW(Friction(law, {0.1, 0, 2}), InputError);
  EXPECT_NO_THROW(Friction(law, {0, 0, 2}));
}

}  // namespace
}  // namespace slipfront::friction
