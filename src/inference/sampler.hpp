#pragma once

#include <array>
#include <optional>

#include "inference/balance.hpp"
#include "inference/sobol.hpp"
#include "slipfront/inference/posterior.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::inference {

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

/// One state of the fault. weight = prior x likelihood / proposal density.
struct Sample {
  double weight, u;  ///< u = ln(1 + Gamma)
  FaultState state;
};

/// Chooses the observations of an event that matter, and draws its samples. The coordinates of the Sobol points are: 0
/// V, 1 slip velocity or slip, 2 T, 3 the observation that gives A, 4 hardness, 5 C, 6 and up the constants of the
/// medium, 12 the rise time if T is the duration.
class Sampler {
 public:
  Sampler(const catalogue::Observation& o, const medium::Defaults& defaults, const Sampling& sampling);

  bool knows_contact() const { return contact_from_ != ContactFrom::nothing; }
  bool knows_slip_velocity() const { return o_.has_slip_velocity(); }
  /// Whether C, spacing and duration are known, and therefore Gamma / A.
  bool knows_friction() const { return o_.friction_coefficient && o_.asperity_spacing && time_; }
  bool knows_duration() const { return time_ != nullptr; }
  /// Whether two of slip velocity, A and friction are known; they determine the third.
  bool fixes_friction() const {
    return o_.rupture_velocity_m_s && knows_slip_velocity() + knows_contact() + knows_friction() >= 2;
  }
  bool knows_anything() const { return o_.rupture_velocity_m_s || (knows_slip_velocity() && knows_contact()); }
  /// Whether samples differ at all.
  bool is_uncertain() const;

  /// Makes room for `samples` samples. It does not change those that were drawn already.
  void grow(std::size_t samples) { points_.grow(samples); }
  /// Draws sample i. A rejected sample has weight 0, and its refusal is counted.
  Sample draw(std::size_t i);
  const std::array<std::size_t, refusals>& refused() const { return refused_; }
  std::uint64_t seed() const { return seed_; }

 private:
  enum class ContactFrom { nothing, ratio, drop, strength };

  double at(const catalogue::Measured& m, std::size_t dimension) const {
    return m.is_exact() ? m.low : m.quantile(points_(point_, dimension));
  }
  bool draw_constants();
  bool draw_rupture_velocity(Sample& s);
  bool draw_contact(Sample& s);
  bool draw_times();
  /// Draws w in m/s. It is absent if it is not positive.
  std::optional<double> draw_slip_velocity(Sample& s);
  bool draw_friction(Sample& s, double w);
  bool find_friction(Sample& s, std::optional<double> w);
  bool find_bound(Sample& s, double w);
  bool agrees(Sample& s) const;
  bool refuse(Refusal why) {
    ++refused_[why];
    return false;
  }

  const catalogue::Observation& o_;
  const medium::Defaults& defaults_;
  Sampling sampling_;
  std::uint64_t seed_;
  ShiftedSobol points_;
  const catalogue::Measured* time_;                        ///< T of Gamma = C T; null: unknown
  const catalogue::Measured* slip_time_;                   ///< the time in slip / time; null: unknown, or not needed
  const catalogue::Measured* contact_measured_ = nullptr;  ///< contact_ratio if it has an error
  ContactFrom contact_from_ = ContactFrom::nothing;
  std::array<std::size_t, refusals> refused_{};

  // The present sample.
  std::size_t point_ = 0;
  medium::Constants constants_;
  medium::Elastic elastic_{};
  double plastic_ = 0, duration_ = 0, slipping_ = 0;
  Pulse pulse_{};
};

}  // namespace slipfront::inference
