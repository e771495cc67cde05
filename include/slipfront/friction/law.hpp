#pragma once
/// \file
/// A friction law: the force that opposes slip at one place, and its averages over a uniform train
/// (docs/theory.md 3.3). To add a law, write one file in src/friction/ and add its line to src/friction/laws.cpp. The
/// file must give the name, the parameters and the force; averages and implicit solves follow by quadrature and
/// bisection unless the law knows closed forms.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "slipfront/train/train.hpp"

namespace slipfront::friction {

/// How f enters the momentum law P_t + Q_x = F k - loss.
enum class Closure {
  consistent,  ///< loss = <f(w) sigma>, the exact average
  paper,       ///< loss = k <f(w)>, as the paper's Eqs. (7) have it; understates friction
};

/// "consistent" or "paper", and back. \throws InputError (key "closure") for any other word.
const char* name_of(Closure closure);
Closure closure_named(std::string_view name);

/// The unit of F and f, as text.
inline constexpr std::string_view force_unit = "mu A^2 / (pi (1 - nu))";

/// What a parameter is. On a chain whose x and t are scaled up, forces are divided by the scale, slips and times
/// multiplied by it. A factor of the force is a force, whatever it multiplies: C of f = C w^n too. `Friction` compares
/// what is stated here with the force of the law, and refuses a law that does not scale.
enum class Dimension { number, force, slip, time, velocity, pressure };  // pressure: over the normal stress

/// A number that a law takes, and the key of table [friction] that gives it.
struct Parameter {
  std::string_view name, symbol, unit;
  double value = 0;  ///< if none is given
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool without_least = false;
  Dimension dimension = Dimension::number;
  std::vector<std::string_view> words = {};  ///< what may be given instead of a number; the value is the word's place
  std::string_view if_missing = {};          ///< a warning that says what its absence means
  bool on_chain_alone = false;               ///< averages over a train do not know it
};

/// C of a law whose force is proportional to it. `unit` is that of F, over what C stands before.
Parameter coefficient_in(std::string_view unit);
/// "strength": the friction at rest, or at the reference velocity.
Parameter strength_in(std::string_view unit, std::string_view symbol);

/// f as a curve that the user draws: the force >= 0 at the speed |w| >= 0. May be called by several threads at once.
using Curve = std::function<double(double speed)>;

/// How a scenario gives a law its curve: not at all, by the key "formula", or by a table in the file that "file" names.
enum class CurveSource { none, formula, table };

/// A quantity that each place remembers, such as the age of its contacts.
struct Variable {
  std::string_view name, symbol, unit;
};

/// Values of a law's variables at one place, in the order of its definition; none for most laws.
using Memory = std::span<const double>;

/// Values of a law's variables at many places, one place after the other: `each` numbers a place.
struct Memories {
  const double* values = nullptr;
  std::size_t each = 0;
  Memory of(std::size_t i) const { return {values + i * each, each}; }
  Memories from(std::size_t i) const { return {values + i * each, each}; }
};

/// Many uniform trains at once, an entry of each array for each.
struct Trains {
  std::size_t size = 0;
  const double* fastest = nullptr;  ///< the largest slip velocity in it, 2 a sinh |phi| cosh psi
  const double* s = nullptr;        ///< the least slip velocity over the largest, tanh psi, 0 < s < 1
  Memories memory = {};
};

/// Rate at which friction relaxes the momentum of uniform trains, loss / P, with its limit at rest. The train lies in a
/// contact ratio a; its state is that in the local units a x, a t. An object may keep tables that fill as they are
/// used: it serves one thread.
class RelaxationRate {
 public:
  virtual ~RelaxationRate() = default;
  virtual double operator()(const State& state, double contact, Memory memory) const = 0;
  /// The same in many trains, of these largest slip velocities 2 a sinh |phi| cosh psi, without memory.
  virtual void rates(std::size_t size, const double* fastest, const double* psi, double* rate) const;
};

/// A law with its numbers.
class Law {
 public:
  virtual ~Law() = default;

  /// f at the slip velocity |w| = `speed` >= 0. Its limit at 0 is the largest force that holds a place at rest.
  virtual double strength(double speed, Memory memory) const = 0;

  /// C where f = C w. Such friction is built into the time steps of pulse and chain.
  virtual std::optional<double> linear_coefficient() const { return std::nullopt; }
  /// f_0 where f = f_0 sign(w), the same at every speed.
  virtual std::optional<double> constant_strength() const { return std::nullopt; }
  /// Whether f rises so steeply from rest, without a jump, that a step which is centred on it would reverse the slip.
  virtual bool steep_at_rest() const { return false; }

  /// The speed v >= 0 that friction leaves of `free` >= 0 in a time step: v + weight f(v) = free; 0 where friction
  /// holds the place.
  virtual double speed_after(double free, double weight, Memory memory) const;

  /// Mean of f over a uniform train, >= 0; the loss of momentum is k times this. The mean is over slip (consistent) or
  /// over length (paper). The places that a dislocation spans have the same memory.
  virtual double mean_strength(const State& state, double contact, Closure closure, Memory memory) const;
  virtual std::unique_ptr<RelaxationRate> relaxation_rate(Closure closure) const;
  /// Whether that has a table, or a closed form.
  virtual bool tabulates_rate() const { return false; }

  // The same for many places or trains at once. A law that can, has vector loops for them.

  /// `strength` at each speed.
  virtual void strengths(std::size_t size, const double* speed, Memories memory, double* force) const;
  /// `speed_after` of each speed.
  virtual void speeds_after(std::size_t size, const double* free, double weight, Memories memory, double* speed) const;
  /// The same where the normal stress on each place is a share > 0 of what the law's numbers are for: v + weight
  /// share f(v) = free.
  virtual void speeds_after_under(std::size_t size, const double* share, const double* free, double weight,
                                  Memories memory, double* speed) const;
  /// `mean_strength` of each train, to 3e-10 of itself where it is smooth in ln w; and, unless `slope` is null, what it
  /// changes by with ln(fastest).
  virtual void mean_strengths(const Trains& trains, Closure closure, double* mean, double* slope) const;
  /// `advance` and `advance_in_train` of `size` places of `each` variables.
  virtual void advance_all(std::size_t size, const double* velocity, double time, std::size_t each,
                           double* memory) const;
  virtual void advance_in_trains(std::size_t size, const double* mean, const double* typical, double time,
                                 std::size_t each, double* memory) const;

  /// Sets a place's variables at t = 0, where nothing has slipped.
  virtual void start(std::span<double> memory) const;
  /// Changes them over a time in which the place slips at a constant velocity.
  virtual void advance(double velocity, double time, std::span<double> memory) const;
  /// The same over a time in which many dislocations of a train pass, of the given mean velocity; the logarithm of
  /// their velocity has over slip the mean ln `typical` (which is a sinh |phi| e^psi).
  virtual void advance_in_train(double mean, double typical, double time, std::span<double> memory) const;
};

/// What is known of a law before its numbers are.
struct Definition {
  std::string_view name;       ///< of friction.law in a scenario
  std::string_view adjective;  ///< stands before "friction" in a sentence
  std::string_view equation;
  std::string_view source;
  std::vector<Parameter> parameters = {};
  std::vector<Variable> variables = {};
  CurveSource curve = CurveSource::none;
  /// From the parameters' values, in their order, and the curve if the law takes one.
  std::shared_ptr<const Law> (*make)(const std::vector<double>& values, const Curve& curve);

  /// Null if the law has no such parameter.
  const Parameter* find(std::string_view parameter) const;
};

/// All laws that a scenario can name.
const std::vector<const Definition*>& laws();

}  // namespace slipfront::friction
