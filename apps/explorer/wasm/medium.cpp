/// \file
/// SI units of every panel, and the answer to a typed event.

#include "slipfront/theory/medium/medium.hpp"

#include "answer.hpp"
#include "slipfront/error.hpp"
#include "slipfront/text/quantity.hpp"
#include "slipfront/theory/medium/constants.hpp"

namespace slipfront::explorer {
namespace {

double quantity(const char* key, const char* text, medium::Dimension dimension) {
  try {
    const medium::Span span = medium::parse_quantity(text, dimension);
    if (span.low < span.high || !(span.low > 0))
      throw InputError({.value = text,
                        .problem = span.low < span.high ? "a range" : "not positive",
                        .allowed = std::string(medium::example(dimension))});
    return span.low;
  } catch (const InputError& error) {
    Complaint complaint = error.complaint();
    complaint.key = key;
    throw InputError(complaint);
  }
}

}  // namespace

/// The units of the dimensionless quantities for texts such as "30 GPa", "6 km/s", "0.3", "0.003" and "1 cm".
SLIPFRONT_EXPORT const char* units(const char* shear_modulus, const char* p_wave_speed, const char* poisson_ratio,
                                   const char* contact_ratio, const char* asperity_spacing) {
  return answer([=] {
    using medium::Dimension;
    medium::Constants constants;
    constants.shear_modulus = quantity("medium.shear_modulus", shear_modulus, Dimension::pressure);
    constants.p_wave_speed = quantity("medium.p_wave_speed", p_wave_speed, Dimension::velocity);
    constants.poisson_ratio = quantity("medium.poisson_ratio", poisson_ratio, Dimension::ratio);
    const medium::Elastic elastic = medium::elastic(constants, {});
    const double A = quantity("medium.contact_ratio", contact_ratio, Dimension::ratio);
    const double b = quantity("medium.asperity_spacing", asperity_spacing, Dimension::length);
    const medium::Units u = medium::units(elastic.shear_modulus, elastic.speed, A, b);
    return Object()
        .put("speed", elastic.speed)
        .put("slip", u.slip)
        .put("length", u.length)
        .put("time", u.time)
        .put("stress", u.stress)
        .put("slip_velocity", u.slip_velocity)
        .put("velocity", u.velocity);
  });
}

}  // namespace slipfront::explorer
