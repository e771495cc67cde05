#pragma once

#include <vector>

#include "slipfront/inference/quantities.hpp"

namespace slipfront::inference {

struct Weighted {
  double value, weight;  ///< weight > 0
};

/// 5, 50 and 95 % of weighted values, at least one, ascending: linear between the middles of their steps.
inline Quantiles weighted_quantiles(const std::vector<Weighted>& values) {
  double total = 0;
  for (const Weighted& v : values) total += v.weight;
  const auto at = [&](double share) {
    double below = 0, last_middle = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double middle = below + values[i].weight / 2;
      if (middle >= share * total) {
        if (i == 0) return values[0].value;
        const double s = (share * total - last_middle) / (middle - last_middle);
        return values[i - 1].value + s * (values[i].value - values[i - 1].value);
      }
      below += values[i].weight;
      last_middle = middle;
    }
    return values.back().value;
  };
  return {at(0.05), at(0.5), at(0.95)};
}

}  // namespace slipfront::inference
