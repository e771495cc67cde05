#pragma once
/// \file
/// FNV-1a, 64 bits. Each step is a bijection of the sum: one changed byte always changes the result. It finds damage,
/// not malice.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace slipfront::record {

class Fnv {
 public:
  Fnv& bytes(std::string_view data) {
    for (const char c : data) byte(static_cast<unsigned char>(c));
    return *this;
  }
  /// Eight bytes at a time: another sum than that of `bytes`, eight times as fast.
  Fnv& words(std::string_view data) {
    for (; data.size() >= sizeof(std::uint64_t); data.remove_prefix(sizeof(std::uint64_t))) {
      std::uint64_t word = 0;
      std::memcpy(&word, data.data(), sizeof word);
      sum_ = (sum_ ^ word) * 0x100000001b3ULL;
    }
    return bytes(data);
  }
  /// Least significant byte first, on every machine.
  Fnv& number(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) byte(static_cast<unsigned char>(value >> shift));
    return *this;
  }
  /// With its length, so that two texts in a row cannot be told apart wrongly.
  Fnv& text(std::string_view data) { return number(data.size()).bytes(data); }
  Fnv& real(double value) { return number(std::bit_cast<std::uint64_t>(value)); }
  Fnv& reals(std::span<const double> values) {
    number(values.size());
    for (const double value : values) real(value);
    return *this;
  }
  std::uint64_t sum() const { return sum_; }

 private:
  void byte(unsigned char value) { sum_ = (sum_ ^ value) * 0x100000001b3ULL; }
  std::uint64_t sum_ = 0xcbf29ce484222325ULL;
};

}  // namespace slipfront::record
