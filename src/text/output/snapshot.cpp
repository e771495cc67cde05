#include "slipfront/text/output/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "slipfront/text/output/run.hpp"
#include "system/archive.hpp"

namespace slipfront::output {

void sort(std::vector<Dislocation>& dislocations) {
  std::sort(dislocations.begin(), dislocations.end(), [](const Dislocation& a, const Dislocation& b) {
    return std::tie(a.x, a.level, a.sign) < std::tie(b.x, b.level, b.sign);
  });
}

Observed observed_fronts(const std::vector<double>& x, const std::vector<double>& speed, double level, double left,
                         double right) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = x.size();
  std::size_t first = 0, last = n;
  while (first < n && !(speed[first] >= level)) ++first;
  if (!(level > 0) || first == n) return {none, none};
  while (!(speed[last - 1] >= level)) --last;
  const auto crossing = [&](std::size_t slow, std::size_t fast) {
    return std::lerp(x[slow], x[fast], (level - speed[slow]) / (speed[fast] - speed[slow]));
  };
  return {first > 0 ? crossing(first - 1, first) : left, last < n ? crossing(last, last - 1) : right};
}

std::string Run::saved() const { return slipfront::saved(*this); }

}  // namespace slipfront::output
