// libFuzzer target: no text of a finite-fault model, in any format, may crash the reader or make it return a velocity
// that is none, and none may become a source whose slip rates miss its slip.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "check.hpp"
#include "events/catalogue/fault_model.hpp"
#include "events/finite_fault/source/source.hpp"

namespace {

using namespace slipfront::finite_fault;

void check_source(const FiniteSource& source) {
  for (const SourceSegment& segment : source.segments)
    for (const SourcePoint& p : segment.points) {
      double released = 0;
      for (const double rate : slip_rates(source, p)) released += rate * source.time_step;
      if (!(std::fabs(released - p.slip) <= 1e-9 * std::fabs(p.slip))) std::abort();
      if (!std::isfinite(p.rupture_time) || !(p.rupture_time >= 0) || !(p.rise_time > 0)) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto model = slipfront::catalogue::read_fault_model({reinterpret_cast<const char*>(data), size}, "fuzz.fsp");
    const auto& o = model.observation;
    if (o.line == 0) std::abort();
    if (o.poisson_ratio && !(*o.poisson_ratio > 0 && *o.poisson_ratio < 0.5)) std::abort();
    check_observation(o);
    check_source(finite_source(model, {}, {}));
  } catch (const slipfront::InputError&) {
  }
  return 0;
}
