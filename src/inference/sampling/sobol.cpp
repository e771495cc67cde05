#include "inference/sampling/sobol.hpp"

#include <boost/random/sobol.hpp>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

namespace slipfront::inference {
namespace {

/// Steele, Lea & Flood's mixer (splitmix64).
std::uint64_t mixed(std::uint64_t& state) {
  std::uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

/// The sequence without shift, made once for each number of points.
const std::vector<std::uint64_t>& sequence(std::size_t points) {
  static std::mutex mutex;
  static std::map<std::size_t, std::vector<std::uint64_t>> known;
  const std::scoped_lock lock(mutex);
  std::vector<std::uint64_t>& found = known[points];
  if (found.empty()) {
    boost::random::sobol engine(ShiftedSobol::dimensions);
    found.resize(points * ShiftedSobol::dimensions);
    for (std::uint64_t& x : found) x = engine();
  }
  return found;
}

}  // namespace

ShiftedSobol::ShiftedSobol(std::size_t points, std::uint64_t seed) : points_(&sequence(points)) {
  for (std::uint64_t& shift : shift_) shift = mixed(seed);
}

void ShiftedSobol::grow(std::size_t points) { points_ = &sequence(points); }

double ShiftedSobol::operator()(std::size_t point, std::size_t dimension) const {
  const std::uint64_t bits = (*points_)[point * dimensions + dimension] ^ shift_[dimension];
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

std::uint64_t seed_of(std::uint64_t seed, const catalogue::Observation& o) {
  std::uint64_t state = seed;
  const auto add = [&](double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    state ^= bits;
    state = mixed(state);
  };
  const auto add_measured = [&](const catalogue::Measured& m) {
    for (const double x : {m.low, m.high, m.spread, m.spread_below, static_cast<double>(m.shape)}) add(x);
  };
  const auto none = std::numeric_limits<double>::quiet_NaN();
  for (const auto* m : {&o.rupture_velocity_m_s, &o.slip_velocity_m_s, &o.slip, &o.rise_time, &o.duration,
                        &o.stress_drop, &o.friction_coefficient, &o.normal_stress, &o.hardness})
    *m ? add_measured(**m) : add(none);
  for (const medium::Constant& c : medium::constants()) add((o.*c.member).value_or(none));
  for (const catalogue::UncertainConstant& c : o.uncertain_constants) add_measured(c.measured);
  add(static_cast<double>(o.measure()));
  add(static_cast<double>(o.rupture_velocity_is));
  add(static_cast<double>(o.stress_drop_is));
  add(o.front_threshold);
  return mixed(state) >> 11;  // whole in a JSON number
}

}  // namespace slipfront::inference
