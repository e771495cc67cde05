#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "events/inference/sampling/evidence.hpp"
#include "events/inference/sampling/proposal.hpp"
#include "slipfront/events/inference/posterior.hpp"

namespace slipfront::inference {

/// Misfit, in standard deviations squared, above which the observations exclude each other.
inline constexpr double hopeless_misfit = 25;

/// Why a sample was rejected.
enum Refusal : std::size_t {
  too_fast,
  off_table,
  slips_too_fast,
  slips_too_slowly,
  bad_contact,
  bad_constants,
  contradicted,
  refusals
};

/// One state of the fault, with its weight in the posterior.
struct Sample {
  double weight = 0;
  FaultState state;
  /// The logarithm of the value that the state predicts for each observation, in the order of Sampler::evidence().
  std::array<double, 6> predicted{};
};

/// The unknowns of the samples of an event, in addition to the rupture velocity.
enum class Mode {
  nothing,   ///< the observations determine nothing
  friction,  ///< A and the damping number
  contact,   ///< A only: the observations do not depend on friction
  bounds,    ///< the bounds that hold because friction can only slow slip and front
};

/// Draws the states of the fault that agree with the observations of one event. First it evaluates the likelihood on
/// cells over the observed velocity, the damping number and the observation that fixes A best. The samples are then
/// points of a shifted Sobol sequence in these cells. Sobol coordinates: 0 to 2 the cells, 3 T, 4 hardness, 5 the time
/// that divides slip, 6 and up the constants of the medium.
class Sampler {
 public:
  /// `without` is the key of an observation to leave out; the samples then predict it. It may be empty. With a range
  /// `within`, only states that predict a value in that range count.
  Sampler(const catalogue::Observation& o, const medium::Defaults& defaults, const Sampling& sampling,
          std::string_view without = {}, const std::optional<catalogue::MeasuredValue>& within = {});

  Mode mode() const { return mode_; }
  bool knows_contact() const { return knows_contact_; }
  bool knows_slip_velocity() const { return o_.has_slip_velocity(); }
  bool knows_friction() const { return o_.friction_coefficient && o_.asperity_spacing && o_.damping_time(); }
  bool knows_duration() const { return o_.damping_time() != nullptr; }
  /// Whether two observations of A agree at one damping number only.
  bool fixes_friction() const { return mode_ == Mode::friction && fixes_friction_; }
  /// Whether only the damping number is uncertain: every observation is exact. A few samples then suffice.
  bool knows_all_but_damping() const {
    return mode_ == Mode::friction && !solves_damping_ && !has_errors_ && velocity_->is_exact() && used_.size() == 1 &&
           used_[0].measured.is_exact();
  }
  /// Whether samples differ at all.
  bool is_uncertain() const { return uncertain_; }

  /// The observations of A, and that which is left out. Their order is that of Sample::predicted.
  const std::vector<Evidence>& evidence() const { return all_; }
  /// Keys of exact observations that were not used, because others determine the state already.
  const std::vector<std::string>& unused() const { return unused_; }
  /// Least sum of squared distances, in standard deviations, at which a state of the fault agrees with the observations
  /// (on the cells). It is infinite if none agrees.
  double least_misfit() const { return least_misfit_; }

  /// Makes room for `samples` samples. It does not change those that were drawn already.
  void grow(std::size_t samples) { points_.grow(samples); }
  /// Draws sample i. A rejected sample has weight 0, and its refusal is counted.
  Sample draw(std::size_t i);
  /// Draws `count` states from the prior, at points of the same sequence. Call it after the last draw.
  std::vector<FaultState> draw_prior(std::size_t count);
  const std::array<std::size_t, refusals>& refused() const { return refused_; }
  std::uint64_t seed() const { return seed_; }

 private:
  void choose_mode(bool predicts);
  void make_cells();
  void make_cell_of_damping(const Axis& first, const Axis& third);
  /// Cells with their target, and the largest likelihood in them.
  struct Filled {
    Cells cells;
    double best;
    bool off_table;  ///< a velocity has no pulse in the table of friction
  };
  Filled filled(const Axis& first, const Axis& second, const Axis& third) const;
  double change_of_W_in(const Axis& velocities, std::size_t i) const;
  void fill_row(Filled& filled, std::size_t i, const std::vector<double>& of_third) const;
  class AlongThird;

  double at(const catalogue::MeasuredValue& m, std::size_t dimension) const {
    return m.is_exact() ? m.low : m.quantile(points_(point_, dimension));
  }
  bool draw_surroundings();
  bool refuse(Refusal why) {
    ++refused_[why];
    return false;
  }
  /// Damping numbers at which two exact observations agree, and their weights.
  struct Root {
    double u, weight;
  };
  std::vector<Root> roots(double seen);
  std::optional<double> draw_damping(Sample& s, double seen, double share, double most_u);
  bool draw_pulse(Sample& s, const Cells::Point& point);
  bool draw_without_velocity(Sample& s, const Cells::Point& point);
  bool weigh(Sample& s, const PulseState& p, double u, double ln_x);
  void fill(Sample& s, const PulseState& p, double u, double ln_A) const;
  void set_friction(FaultState& state, const PulseState& p, double u, double A) const;

  const catalogue::Observation& o_;
  const medium::Defaults& defaults_;
  std::optional<catalogue::MeasuredValue> velocity_;  ///< rupture velocity, m/s; a wide range if it is left out
  PulseModel model_;
  std::vector<Evidence> all_, used_;  ///< all evidence; and that which is used, the first of which gives A
  std::vector<std::string> unused_;
  Mode mode_ = Mode::nothing;
  bool knows_contact_ = false, fixes_friction_ = false, uncertain_ = false, solves_damping_ = false,
       has_errors_ = false;
  bool predicts_range_;  ///< only states that predict a value in a range count
  std::uint64_t seed_;
  ShiftedSobol points_;
  Surroundings middle_;
  std::optional<Cells> cells_;
  double least_misfit_ = 0, most_ln_A_ = 0;
  std::array<std::size_t, refusals> refused_{};

  // The present sample.
  std::size_t point_ = 0;
  medium::Constants constants_;
  Surroundings around_;
};

}  // namespace slipfront::inference
