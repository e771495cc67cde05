#pragma once
/// \file
/// Values for the parameters of any friction law, so that a test can walk through friction::laws(): a law that is added
/// there is tested without a line of its own.

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "slipfront/friction/friction.hpp"

namespace slipfront::friction {

/// The law of friction `name` with values of its parameters.
inline Friction law_of(const std::string& name, std::vector<double> values) {
  for (const Definition* definition : laws())
    if (definition->name == name) return {*definition, std::move(values)};
  throw std::invalid_argument(name);
}

/// The sizes of forces, slips, times and velocities among the parameters.
struct Sizes {
  double force, slip, time, velocity;
};

/// A value of each parameter that is neither 0 nor 1, so that a wrong power of it shows. `word` chooses among the words
/// of parameters that take words.
inline std::vector<double> law_values(const Definition& law, std::size_t word, const Sizes& sizes) {
  std::vector<double> values;
  for (const Parameter& p : law.parameters) {
    const double step = 1 + 0.1 * static_cast<double>(values.size());
    double value = 0;
    switch (p.dimension) {
      case Dimension::number:
        value = p.words.empty() ? std::fmax(p.value, 0.3) * step : static_cast<double>(word % p.words.size());
        break;
      case Dimension::force:
        value = sizes.force / (step * step);
        break;
      case Dimension::slip:
        value = sizes.slip * step;
        break;
      case Dimension::time:
        value = sizes.time * step;
        break;
      case Dimension::velocity:
        value = sizes.velocity * step;
        break;
      case Dimension::pressure:
        value = 0.03 * step;
        break;
    }
    values.push_back(std::clamp(value, p.least, p.most));
  }
  return values;
}

/// How many values of `word` there are to try.
inline std::size_t law_words(const Definition& law) {
  std::size_t most = 1;
  for (const Parameter& p : law.parameters) most = std::max(most, p.words.size());
  return most;
}

}  // namespace slipfront::friction
