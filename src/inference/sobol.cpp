#include "inference/sobol.hpp"

#include <boost/random/sobol.hpp>
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

std::uint64_t seed_of(std::uint64_t seed, std::string_view words, std::size_t line) {
  std::uint64_t state = seed;
  for (const char c : words) {
    state ^= static_cast<unsigned char>(c);
    state = mixed(state);
  }
  state ^= line;
  return mixed(state) >> 11;  // whole in a JSON number
}

}  // namespace slipfront::inference
