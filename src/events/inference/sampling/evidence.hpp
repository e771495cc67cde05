#pragma once
/// \file
/// A proposal density in three dimensions that is constant in each of some cells.
/// The observations that say something about the contact ratio A. For a given pulse, each predicts its own value x as
/// ln x = exponent ln A + offset.

#include <cstddef>
#include <optional>
#include <vector>

#include "events/inference/sampling/proposal.hpp"
#include "slipfront/events/catalogue/measured.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::inference {

/// Cells along one coordinate. A coordinate that is known exactly has one cell of no width.
struct Axis {
  std::vector<double> edges;

  static Axis exact(double x) { return {{x}}; }
  static Axis uniform(double low, double high, std::size_t cells);

  bool is_exact() const { return edges.size() == 1; }
  std::size_t cells() const { return is_exact() ? 1 : edges.size() - 1; }
  double centre(std::size_t i) const { return is_exact() ? edges[0] : (edges[i] + edges[i + 1]) / 2; }
  /// Width of a cell; 1 if the coordinate is exact.
  double width(std::size_t i) const { return is_exact() ? 1 : edges[i + 1] - edges[i]; }
};

/// Cells in ln x for a measured quantity x with low <= x <= high. They are narrow where its likelihood changes, and
/// reach six standard deviations. A normal error has further cells down to `low`, because its likelihood does not
/// vanish there. There are no cells if the likelihood vanishes between `low` and `high`.
enum class Fineness { coarse, fine };
Axis axis_of(const catalogue::MeasuredValue& measured, double low, double high, Fineness fineness);

/// The density on the cells of three axes.
class Cells {
 public:
  Cells(Axis first, Axis second, Axis third);

  const Axis& axis(std::size_t i) const { return axes_[i]; }
  /// The value of the target density in a cell, at its middle.
  double& target(std::size_t i, std::size_t j, std::size_t k) {
    return share_[(i * axes_[1].cells() + j) * axes_[2].cells() + k];
  }
  /// New edges of an axis, such that its cells have similar shares of the target.
  Axis refined(std::size_t axis, std::size_t cells) const;
  /// Turns the target into a proposal density. Every cell keeps a part of `defence` (which must be below 1), shared out
  /// by `first_base` and `third_base`, the densities of these coordinates. The target must not vanish everywhere.
  void finish(double defence, const std::vector<double>& first_base, const std::vector<double>& third_base);

  struct Point {
    double first, second, third;
    double density;
  };
  /// The point for three uniformly distributed numbers between 0 and 1.
  Point at(double p, double q, double r) const;

 private:
  Axis axes_[3];
  std::vector<double> share_;                   ///< the target, then the share of each cell
  std::vector<double> first_, second_, third_;  ///< cumulative shares; the second and third within those before
};

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
  catalogue::MeasuredValue measured;
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
double log_spread(const catalogue::MeasuredValue& measured);

/// Sorts evidence: first exact numbers in the present order, then the others, most precise first.
void sort_by_precision(std::vector<Evidence>& evidence);

/// All evidence of an observation: first exact numbers in the order of Source, then the others, most precise first.
std::vector<Evidence> evidence_of(const catalogue::Observation& observation);

}  // namespace slipfront::inference
