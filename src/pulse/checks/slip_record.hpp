#pragma once

#include <optional>

#include "foundation/bytes.hpp"
#include "pulse/solver.hpp"
#include "slipfront/output/self_check.hpp"

namespace slipfront::pulse {

/// Slip at x = 0 by the two routes that should agree. Nothing where x = 0 is not within the domain or the run is too
/// short to tell.
struct SlipTwice {
  double by_place;     ///< from where the dislocations are
  double by_velocity;  ///< the integral of the slip velocity
  double sampling;     ///< how far the integral may be off for the samples that it is made of
  double of_velocity;  ///< and for what the slip velocity is in the cells around
  /// Their difference, as far as it does not come from sampling or is no more than the cells around leave open.
  double error() const;
};

/// The integral of the slip velocity at x = 0, sampled during a run.
class SlipRecord {
 public:
  void sample(const Solver& solver);
  std::optional<SlipTwice> compare(const Solver& solver) const;
  /// Integral of the size of the slip velocity.
  double size() const { return size_; }

  void save(bytes::Writer& writer) const;
  void restore(bytes::Reader& reader);

 private:
  /// The numbers of a checkpoint, in their order.
  template <class Record, class Each>
  static void for_each_number(Record& record, const Each& each);

  output::SampledIntegral integral_;
  double size_ = 0;
  double doubt_ = 0;  ///< integral of how wrong the slip velocity may be, from its values in the cells around
};

}  // namespace slipfront::pulse
