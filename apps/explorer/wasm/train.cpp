/// \file
/// One uniform train of dislocations, as in the paper's Fig. 2: its fields and their averages (Eqs. 4-5).

#include "slipfront/theory/train.hpp"

#include <algorithm>
#include <cmath>

#include "answer.hpp"
#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::explorer {

/// `stress` is that of the train at rest with the same psi; `velocity` that of its dislocations.
SLIPFRONT_EXPORT const char* train(double stress, double velocity, double periods, int points) {
  return answer([=] {
    if (!(stress >= 0.02 && stress <= 100))
      throw InputError(
          {.key = "stress", .value = digits(stress), .problem = "out of range", .allowed = "0.02 ... 100"});
    if (!(std::fabs(velocity) <= 0.999))
      throw InputError(
          {.key = "velocity", .value = digits(velocity), .problem = "out of range", .allowed = "-0.999 ... 0.999"});
    const State state{std::atanh(velocity), train::psi_of_stress(stress)};
    const double length = train::spacing(state);
    std::vector<double> xi, u, sigma, w;
    const int count = std::clamp(points, 2, 20000);
    for (int i = 0; i < count; ++i) {
      xi.push_back(length * periods * (static_cast<double>(i) / (count - 1) - 0.5));
      const train::Fields f = train::fields(state, xi.back());
      u.push_back(f.u);
      sigma.push_back(f.sigma);
      w.push_back(f.w);
    }
    const train::Averages a = train::averages(state);
    Object object;
    object.put("spacing", length).put("k", a.k).put("W", a.W).put("psi", state.psi).put("phi", state.phi);
    return object.numbers("xi", xi).numbers("u", u).numbers("sigma", sigma).numbers("w", w);
  });
}

}  // namespace slipfront::explorer
