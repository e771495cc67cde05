#pragma once
/// \file
/// FNV-1a, 64 bits. Each step is a bijection of the sum: one changed byte always changes the result. It finds damage,
/// not malice.
/// A seal at the end of a file: a magic number, and the length and checksum of all bytes before it. HDF5 ignores bytes
/// after its own, so every NetCDF reader can still open the file. The NetCDF library trusts the bytes that it reads.
/// The seal lets us reject a file that was truncated, damaged or changed before the library sees it.

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
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

/// Returns the seal to append to `content`.
std::string seal(std::string_view content);

/// Returns the content before the seal. \throws FileError with `name` if the seal is missing or broken.
std::string_view sealed_content(std::string_view file, const std::string& name);

/// Like `sealed_content`, but for files that other programs may have written. A file without a seal is accepted whole.
std::string_view without_broken_seal(std::string_view file, const std::string& name);

/// Checks the seal of the file `path`, if it has one. \throws FileError if the file cannot be read or was changed.
void require_unbroken_seal(const std::string& path);

}  // namespace slipfront::record
