#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slipfront/error.hpp"

/// The state of a run as bytes, for checkpoints.
namespace slipfront::bytes {

/// Numbers as bytes in a row, little endian as every machine that this runs on.
class Writer {
 public:
  template <class T>
  void put(T value) {
    text_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::vector<double>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    text_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    text_.append(text);
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  template <class T>
  T get() {
    T value;
    take(&value, sizeof value);
    return value;
  }
  std::vector<double> vector() {
    const auto size = get<std::uint64_t>();
    if (size > text_.size() / sizeof(double)) refuse();
    std::vector<double> values(static_cast<std::size_t>(size));
    take(values.data(), values.size() * sizeof(double));
    return values;
  }
  std::string text() {
    const auto size = get<std::uint64_t>();
    if (size > text_.size()) refuse();
    std::string text(static_cast<std::size_t>(size), '\0');
    take(text.data(), text.size());
    return text;
  }
  bool at_end() const { return text_.empty(); }
  std::string_view rest() const { return text_; }
  void end() const {
    if (!text_.empty()) refuse();
  }

 private:
  [[noreturn]] static void refuse() {
    throw InputError({.key = "resume",
                      .problem = "the saved state is not that of such a run",
                      .allowed = "a file that the same subcommand wrote"});
  }
  void take(void* to, std::size_t size) {
    if (size > text_.size()) refuse();
    if (size > 0) std::memcpy(to, text_.data(), size);
    text_.remove_prefix(size);
  }
  std::string_view text_;
};

}  // namespace slipfront::bytes
