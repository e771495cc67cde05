#pragma once
/// \file
/// The answers of this module to the page: JSON objects, with their arrays of numbers as doubles in a separate array.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// A function that the page may call. It returns the address of a JSON text that is valid until the next call.
#define SLIPFRONT_EXPORT extern "C" __attribute__((used, visibility("default")))

namespace slipfront::explorer {

/// A JSON object. Numbers that are not finite become null. Arrays of numbers become {"$": [offset, count]}, a range of
/// `numbers()` of this call.
class Object {
 public:
  Object& put(std::string_view key, double value);
  Object& put(std::string_view key, const std::optional<double>& value);
  Object& put(std::string_view key, int value) { return put(key, static_cast<double>(value)); }
  Object& put(std::string_view key, long value) { return put(key, static_cast<double>(value)); }
  Object& put(std::string_view key, std::string_view value);
  Object& put(std::string_view key, const std::string& value) { return put(key, std::string_view(value)); }
  Object& put(std::string_view key, const char* value) { return put(key, std::string_view(value)); }
  Object& put(std::string_view key, bool value);
  Object& put(std::string_view key, const Object& value);
  Object& put(std::string_view key, const std::vector<Object>& values);
  Object& put(std::string_view key, const std::vector<std::string>& values);
  Object& numbers(std::string_view key, std::span<const double> values);
  std::string text() const { return "{" + text_ + "}"; }

 private:
  void key(std::string_view name);
  std::string text_;
};

/// The lines of a text that are not empty, such as changes of a scenario.
std::vector<std::string> lines_of(std::string_view text);

/// Calls `body` and returns its answer as text. An exception becomes {"error": {...}} with the parts of its message.
const char* answer(const std::function<Object()>& body);

}  // namespace slipfront::explorer
