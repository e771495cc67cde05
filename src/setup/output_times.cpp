#include "setup/output_times.hpp"

namespace slipfront::setup {

std::vector<double> output_times(const scenario::Scenario& s) {
  std::vector<double> times = {0};
  for (const double t : s.output.times)
    if (t > 0 && t < s.end) times.push_back(t);
  if (s.output.every)
    for (double i = 1; i * *s.output.every < s.end * (1 - 1e-12); ++i) times.push_back(i * *s.output.every);
  times.push_back(s.end);
  return times;
}

}  // namespace slipfront::setup
