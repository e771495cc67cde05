#pragma once
/// \file
/// The observations that say something about the contact ratio A. For a given pulse, each predicts its own value x as
/// ln x = exponent ln A + offset.

#include <optional>
#include <vector>

#include "inference/sampling/pulse_state.hpp"
#include "slipfront/medium/constants.hpp"

namespace slipfront::inference {

/// The quantity that an observation measures.
enum class Source {
  slip,      ///< slip velocity, or slip over a time
  contact,   ///< contact ratio
  drop,      ///< stress drop
  strength,  ///< normal stress, with the hardness
  friction,  ///< friction coefficient C, with asperity spacing and duration
};

/// Quantities that are not observations of the pulse. Each sample draws them from their own distributions.
struct Surroundings {
  medium::Elastic elastic{};
  double plastic = 0;   ///< contact ratio of plastic contact
  double spacing = 0;   ///< b, m
  double duration = 0;  ///< T of Gamma = C T, s
  double slipping = 0;  ///< time that divides slip, s; 1 for a slip velocity
  double hardness = 0;  ///< Pa
};

struct Evidence {
  Source source;
  const char* name;  ///< key of the observation in a file
  catalogue::Measured measured;
  double blur;  ///< standard deviation in ln that the surroundings add to its error

  double exponent() const { return source == Source::friction ? -1 : 1; }
  double offset(const PulseState& pulse, double u, const Surroundings& around) const;
  /// ln A at which the pulse agrees with the observed value exp(ln_x).
  double contact(double ln_x, double offset) const { return (ln_x - offset) / exponent(); }
  double predicted(double ln_A, double offset) const { return exponent() * ln_A + offset; }
  /// Approximate likelihood of the value exp(ln_x), with the blur and with a further standard deviation `resolution`.
  /// A relative blur leaves some likelihood far above the observed value of a normal error. With `falls` there is none.
  double blurred_likelihood(double ln_x, double resolution, bool falls) const;
  /// Likelihood of the value exp(ln_x); 1 for an exact observation.
  double likelihood(double ln_x) const { return measured.is_exact() ? 1 : measured.likelihood_of_log(ln_x); }
  /// Approximate standard deviation in ln, with the blur.
  double spread() const;
};

/// Standard deviation of ln x, approximately.
double log_spread(const catalogue::Measured& measured);

/// Sorts evidence: first exact numbers in the present order, then the others, most precise first.
void sort_by_precision(std::vector<Evidence>& evidence);

/// All evidence of an observation: first exact numbers in the order of Source, then the others, most precise first.
std::vector<Evidence> evidence_of(const catalogue::Observation& observation);

}  // namespace slipfront::inference
