#pragma once
/// \file
/// A friction law is the force that opposes slip at a position (docs/theory/5_friction.md). To add a law, write one
/// file in src/friction/laws/ and add its line to src/friction/laws.cpp. The file gives the name, the parameters and
/// the force. A law with state variables also gives their StateEvolution. Averages over a train, implicit solves and
/// loops over many positions follow from the force, by quadrature and bracketing, unless the law knows closed forms.

#include <array>
#include <cassert>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "slipfront/theory/train.hpp"

namespace slipfront::friction {

/// How f enters the momentum law P_t + Q_x = F k - loss.
enum class Closure {
  consistent,  ///< loss = <f(w) sigma>, the exact average
  paper,       ///< loss = k <f(w)>, as in Eqs. (7) of the paper; understates friction
};

/// "consistent" or "paper", and back. \throws InputError (key "closure") for any other word.
const char* name_of(Closure closure);
Closure closure_named(std::string_view name);

/// The unit of F and f, as text.
inline constexpr std::string_view force_unit = "mu A^2 / (pi (1 - nu))";

/// The kind of a parameter. On a chain whose x and t are scaled up, forces are divided by the scale, and slips and
/// times are multiplied by it. Every factor of the force counts as a force, such as C of f = C w^n. `Friction` compares
/// these dimensions with the force of the law, and rejects a law that does not scale.
enum class Dimension { number, force, slip, time, velocity, pressure };  // pressure: over the normal stress

/// A number that a law takes, and the key of table [friction] that gives it.
struct Parameter {
  std::string_view name, symbol, unit;
  std::string_view meaning = {};  ///< in a few words, for the reference of keys
  double value = 0;               ///< if none is given
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool without_least = false;
  Dimension dimension = Dimension::number;
  std::vector<std::string_view> words = {};  ///< words accepted instead of a number; the value is the word's index
  std::string_view if_missing = {};          ///< a warning that explains the effect of its absence
  bool only_on_chain = false;                ///< averages over a train do not take it into account
};

/// C of a law whose force is proportional to C. `unit` is the unit of F divided by that of the factor of C.
Parameter coefficient_in(std::string_view unit);
/// "strength": the friction at rest, or at the reference velocity.
Parameter strength_in(std::string_view unit, std::string_view symbol, std::string_view meaning);
/// A force of any name.
Parameter force_named(std::string_view name, std::string_view symbol, std::string_view meaning, double value = 0);
/// A velocity > 0 of any name; 1 if none is given.
Parameter velocity_named(std::string_view name, std::string_view symbol, std::string_view meaning);
/// "characteristic_slip" > 0; 1 if none is given.
Parameter characteristic_slip();

/// f as a curve that the user gives: the force >= 0 at the speed |w| >= 0. Several threads may call it at once.
using Curve = std::function<double(double speed)>;

/// How a scenario gives a law its curve: not at all, by the key "formula", or by a table in the file that "file" names.
enum class CurveSource { none, formula, table };

/// A quantity that each position has and that changes as the position slips, such as the age of its contacts.
struct StateVariable {
  std::string_view name, symbol, unit;
};

/// Values of a law's state variables at one position, in the order of its definition; none for most laws.
using LocalState = std::span<const double>;

/// The largest number of state variables of a position, with its parameters that vary.
inline constexpr std::size_t most_variables = 16;

/// The values at one position, next to each other.
class LocalValues {
 public:
  explicit LocalValues(std::size_t size) : size_(size) { assert(size <= most_variables); }
  double& operator[](std::size_t v) { return values_[v]; }
  operator LocalState() const { return {values_.data(), size_}; }
  operator std::span<double>() { return {values_.data(), size_}; }

 private:
  std::array<double, most_variables> values_;
  std::size_t size_;
};

/// Values of a law's state variables at many positions: one position after the other, or one variable after the other.
template <class Number>
struct StatesOf {
  Number* values = nullptr;
  std::size_t each = 0;     ///< variables of a position
  std::size_t next = each;  ///< how far it is from a position to the next
  std::size_t apart = 1;    ///< how far it is from a variable to the next

  StatesOf from(std::size_t i) const { return {values + i * next, each, next, apart}; }
  /// The first variables of each position.
  StatesOf first(std::size_t count) const { return {values, count, next, apart}; }
  Number& operator()(std::size_t i, std::size_t v) const { return values[i * next + v * apart]; }
  LocalValues at(std::size_t i) const {
    LocalValues here(each);
    for (std::size_t v = 0; v < each; ++v) here[v] = (*this)(i, v);
    return here;
  }
  /// A variable of `size` positions next to each other: in place, or as a copy in `room`.
  Number* column(std::size_t v, std::size_t size, std::remove_const_t<Number>* room) const {
    if (next == 1) return values + v * apart;
    for (std::size_t i = 0; i < size; ++i) room[i] = (*this)(i, v);
    return room;
  }
  operator StatesOf<const double>() const { return {values, each, next, apart}; }
};
using LocalStates = StatesOf<const double>;
using EvolvingStates = StatesOf<double>;

/// The slip of a position during a time step. `mean` is its mean velocity. `typical` is exp(<ln |w|>), where <> is the
/// mean over slip. If dislocations of a train pass, `typical` is a sinh |phi| e^psi.
struct Slip {
  double mean, typical;
  static Slip at(double velocity) { return {velocity, velocity}; }
};

/// The slip of many positions.
struct Slips {
  const double *mean, *typical;
  static Slips at(const double* velocity) { return {velocity, velocity}; }
};

/// How the state variables of a law change.
class StateEvolution {
 public:
  virtual ~StateEvolution() = default;
  /// Sets the state of a position at t = 0, before any slip.
  virtual void start(std::span<double> state) const = 0;
  /// Advances the state over a time in which the position slips.
  virtual void advance(const Slip& slip, double time, std::span<double> state) const = 0;
  /// Calls `advance` for `size` positions.
  virtual void advance_all(std::size_t size, const Slips& slips, double time, EvolvingStates states) const;
};

/// Steps of equal length in time from `from` to `next`, in a unit of displacement of which one a step is the speed
/// `per_step`.
struct Steps {
  double per_step;
  const double* from;
  double* next;
};

class Law;

/// The force at many positions at once. By default, each function calls that of the law for one position after the
/// other. A law with vectorised loops derives from this class.
class ForceLoops {
 public:
  explicit ForceLoops(const Law& law) : law_(law) {}
  virtual ~ForceLoops() = default;
  /// `strength` at each speed.
  virtual void strengths(std::size_t size, const double* speed, LocalStates states, double* force) const;
  /// `speed_after` of each speed.
  virtual void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                            double* speed) const;
  /// Like `speeds_after`, but the normal stress on each position is a fraction `share` > 0 of the one that the
  /// parameters of the law assume: v + weight share f(v) = free.
  virtual void speeds_after_under(std::size_t size, const double* share, const double* free, double weight,
                                  LocalStates states, double* speed) const;
  /// Shortens steps to those at the speed that friction leaves, under a fraction `share` of the normal stress unless it
  /// is null. A step may count as 0 if it is a rounding error of `from`, or of 0.001. `applied`, if it is not null,
  /// gets the force with the sign of the step. NaN stays NaN.
  virtual void slow_steps(std::size_t size, const Steps& steps, const double* share, double weight, LocalStates states,
                          double* applied) const;
  /// The power w f(w) of each step D.
  virtual void powers(std::size_t size, double per_step, const double* D, LocalStates states, double* power) const;

 protected:
  const Law& law_;
};

/// Many uniform trains at once. Each array has one entry per train.
struct Trains {
  std::size_t size = 0;
  const double* fastest = nullptr;  ///< largest slip velocity in the train, 2 a sinh |phi| cosh psi
  const double* s = nullptr;        ///< smallest slip velocity over the largest, tanh psi, 0 < s < 1
  LocalStates states = {};
};

/// Rate at which friction relaxes the momentum of uniform trains, loss / P, with its limit at rest. An object may fill
/// tables when it is called, so that each thread needs its own.
class RelaxationRate {
 public:
  virtual ~RelaxationRate() = default;
  /// The rate of one train, in the local units a x and a t, where the relative contact ratio is `contact` = a.
  virtual double operator()(const State& train, double contact, LocalState state) const = 0;
  /// The rates of many trains, for a law without state. `fastest` are their largest slip velocities,
  /// 2 a sinh |phi| cosh psi.
  virtual void rates(std::size_t size, const double* fastest, const double* psi, double* rate) const;
  /// Whether the rate comes from a table or a closed form.
  virtual bool tabulated() const { return false; }
};

/// Averages of the force over a uniform train. The positions that one dislocation spans have equal states.
class TrainAverage {
 public:
  virtual ~TrainAverage() = default;
  /// Mean of f >= 0; the loss of momentum is k times this. The mean is over slip (consistent) or length (paper).
  virtual double mean_strength(const State& train, double contact, Closure closure, LocalState state) const = 0;
  /// `mean_strength` of each train. Unless `slope` is null, also its derivative with respect to ln(fastest). The
  /// relative error is 3e-10 if the force is smooth in ln w.
  virtual void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const = 0;
  virtual std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const = 0;
};

/// The averages of any law, by numerical integration of its force.
class QuadratureAverage : public TrainAverage {
 public:
  explicit QuadratureAverage(const Law& law) : law_(law) {}
  double mean_strength(const State& train, double contact, Closure closure, LocalState state) const override;
  void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const override;
  std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const override;

 protected:
  const Law& law_;
};

/// Properties of a force that solvers use.
struct ForceFacts {
  std::optional<double> linear_coefficient = {};  ///< C if f = C w; the time steps of pulse and chain use it
  std::optional<double> constant_strength = {};   ///< f_0 if f = f_0 sign(w)
  std::optional<double> square_coefficient = {};  ///< C if f = C w^2 sign(w)
  bool steep_at_rest = false;  ///< f rises so steeply, without a jump, that a step through rest would reverse slip
};

/// A law with its parameters: the force at a position, and the loops, averages and state evolution that follow from it.
class Law {
 public:
  explicit Law(const ForceFacts& facts = {}) : facts_(facts) {}
  virtual ~Law() = default;
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;

  /// f at the slip velocity |w| = `speed` >= 0. Its limit at 0 is the largest force that holds a position at rest.
  virtual double strength(double speed, LocalState state) const = 0;
  /// The speed v >= 0 at the end of an implicit time step, v + weight f(v) = free; 0 if friction holds the position.
  /// `free` >= 0 is the speed without friction.
  virtual double speed_after(double free, double weight, LocalState state) const;

  virtual const ForceLoops& loops() const { return loops_; }
  virtual const TrainAverage& average() const { return average_; }
  /// Does nothing for a law without state.
  virtual const StateEvolution& evolution() const;

  const ForceFacts& facts() const { return facts_; }

 private:
  ForceFacts facts_;
  ForceLoops loops_{*this};
  QuadratureAverage average_{*this};
};

/// Parameters that vary along the interface. Each position has their values after the `own` state variables of its law.
struct Varying {
  std::size_t own = 0;
  std::vector<std::size_t> parameters = {};  ///< their indices in Definition::parameters
  std::vector<double> least = {};            ///< all parameters, where those that vary have their least values
};

/// The properties of a law that do not depend on its parameters.
struct Definition {
  std::string_view name;       ///< the value of friction.law in a scenario
  std::string_view adjective;  ///< precedes "friction" in a sentence
  std::string_view equation;
  std::string_view source;
  std::vector<Parameter> parameters = {};
  std::vector<StateVariable> state = {};
  CurveSource curve = CurveSource::none;
  /// Makes the law from the values of its parameters, in their order, and from the curve if the law takes one. A law
  /// that takes a curve has no parameters that vary.
  std::shared_ptr<const Law> (*make)(const std::vector<double>& values, const Curve& curve, const Varying& varying);

  /// Null if the law has no such parameter.
  const Parameter* find(std::string_view parameter) const;
};

/// The law L with parameters that vary. At each position it is the law L with the values there.
template <class L>
class VaryingLaw : public Law {
 public:
  VaryingLaw(const std::vector<double>& values, const Varying& varying)
      : Law({.steep_at_rest = L(values).facts().steep_at_rest || L(varying.least).facts().steep_at_rest}),
        values_(values),
        varying_(varying) {}
  double strength(double speed, LocalState state) const override { return law_at(state).strength(speed, own(state)); }
  double speed_after(double free, double weight, LocalState state) const override {
    return law_at(state).speed_after(free, weight, own(state));
  }
  const ForceLoops& loops() const override { return loops_; }
  const TrainAverage& average() const override { return average_; }
  const StateEvolution& evolution() const override { return evolution_; }

 protected:
  const std::vector<double>& values() const { return values_; }
  const Varying& varying() const { return varying_; }
  L law_at(LocalState state) const {
    thread_local std::vector<double> values;  // kept between calls, which then allocate nothing
    values = values_;
    for (std::size_t i = 0; i < varying_.parameters.size(); ++i)
      values[varying_.parameters[i]] = state[varying_.own + i];
    return L(values);
  }
  template <class Values>
  Values own(Values state) const {
    return state.first(varying_.own);
  }

  class Average : public QuadratureAverage {
   public:
    explicit Average(const VaryingLaw& law) : QuadratureAverage(law), varying_(law) {}
    double mean_strength(const State& train, double contact, Closure closure, LocalState state) const override {
      return varying_.law_at(state).average().mean_strength(train, contact, closure, varying_.own(state));
    }

   private:
    const VaryingLaw& varying_;
  };
  class Evolution : public StateEvolution {
   public:
    explicit Evolution(const VaryingLaw& law) : law_(law) {}
    void start(std::span<double> state) const override { law_.law_at(state).evolution().start(law_.own(state)); }
    void advance(const Slip& slip, double time, std::span<double> state) const override {
      if (law_.varying_.own > 0) law_.law_at(state).evolution().advance(slip, time, law_.own(state));
    }

   private:
    const VaryingLaw& law_;
  };

 private:
  class Loops final : public ForceLoops {
   public:
    explicit Loops(const VaryingLaw& law) : ForceLoops(law) {}
    void speeds_after(std::size_t size, const double* free, double weight, LocalStates states,
                      double* speed) const override {
      for (std::size_t i = 0; i < size; ++i) speed[i] = law_.speed_after(free[i], weight, states.at(i));
    }
  };
  std::vector<double> values_;
  Varying varying_;
  Loops loops_{*this};
  Average average_{*this};
  Evolution evolution_{*this};
};

/// Definition::make for a law whose constructor takes the values, or the values and the curve. L::WhereItVaries, if L
/// names one, is a VaryingLaw<L> with vector code.
template <class L>
std::shared_ptr<const Law> make_law(const std::vector<double>& values, const Curve& curve, const Varying& varying) {
  if constexpr (std::is_constructible_v<L, const std::vector<double>&, const Curve&>) {
    return std::make_shared<L>(values, curve);
  } else {
    if constexpr (requires { typename L::WhereItVaries; }) {
      if (!varying.parameters.empty()) return std::make_shared<typename L::WhereItVaries>(values, varying);
    }
    if (!varying.parameters.empty()) return std::make_shared<VaryingLaw<L>>(values, varying);
    return std::make_shared<L>(values);
  }
}

/// All laws that a scenario can name.
const std::vector<const Definition*>& laws();

}  // namespace slipfront::friction
