#include "slipfront/output/further_scalars.hpp"

#include <cstddef>
#include <limits>

namespace slipfront::output {
namespace {

constexpr Description declared[] = {
    {"potency", "slip since time 0, integrated along the interface", "b^2 / (2 pi A)", "Eq. 4"},
};

}  // namespace

std::span<const Description> further_scalars() { return declared; }

double further_scalar(const Snapshot& snapshot, std::string_view name) {
  const auto found = snapshot.further.find(name);
  return found == snapshot.further.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

double integral(const std::vector<double>& values, const std::vector<double>& x_edges) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * (x_edges[i + 1] - x_edges[i]);
  return sum;
}

}  // namespace slipfront::output
