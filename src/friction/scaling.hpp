#pragma once

#include <memory>
#include <vector>

#include "slipfront/friction/friction.hpp"
#include "slipfront/friction/law.hpp"

namespace slipfront::friction {

/// Checks that `scaled` is the friction `original` on a chain whose x and t are stretched by `scale`: its force is that
/// of `original` divided by `scale`, at every speed and after every history of slip. A law whose parameters state a
/// wrong Dimension fails. Drawn curves are replaced by one that is defined at every speed.
/// \throws InputError (key "friction") that names the speed at which the forces differ most.
void check_scaling(const Friction& original, const Friction& scaled, double scale);

/// Checks a law none of whose parameters is a force > 0: it has to have no force.
/// \throws InputError (key "friction")
void check_no_force(const Definition& definition, const std::vector<double>& values);

/// A law whose force at each position is a share of that of another law, as where the normal stress or the only
/// coefficient of a law varies. The share is the last value in the state of a position.
std::shared_ptr<const Law> scaled_law(std::shared_ptr<const Law> law);

}  // namespace slipfront::friction
