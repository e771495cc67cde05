#include "answer.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

#include "math/digits.hpp"
#include "slipfront/error.hpp"

namespace slipfront::explorer {
namespace {

/// The arrays of the present call, one after the other.
std::vector<double>& pool() {
  static std::vector<double> all;
  return all;
}

std::string quoted(std::string_view text) {
  static constexpr char hex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (byte < 0x20)
      (out += byte < 0x10 ? "\\u000" : "\\u001") += hex[byte % 16];
    else
      out += c;
  }
  return out + '"';
}

std::string number(double value) { return std::isfinite(value) ? digits(value, 17) : "null"; }

Object error_object(std::string_view kind, const char* message) {
  return Object().put("error", Object().put("kind", kind).put("message", message));
}

Object error_object(const InputError& error) {
  const Complaint& c = error.complaint();
  return Object().put("error", Object()
                                   .put("kind", "input")
                                   .put("message", error.what())
                                   .put("line", static_cast<double>(c.line))
                                   .put("key", c.key)
                                   .put("value", c.value)
                                   .put("problem", c.problem)
                                   .put("allowed", c.allowed));
}

Object caught(const std::function<Object()>& body) {
  try {
    return body();
  } catch (const InputError& error) {
    return error_object(error);
  } catch (const NumericsError& error) {
    return error_object("numerics", error.what());
  } catch (const std::bad_alloc&) {
    return error_object("memory", "this needs more memory than a page may use; choose fewer cells or dislocations");
  } catch (const std::exception& error) {
    return error_object("numerics", error.what());
  }
}

}  // namespace

void Object::key(std::string_view name) { text_ += (text_.empty() ? "" : ",") + quoted(name) + ":"; }

Object& Object::put(std::string_view name, double value) {
  key(name);
  text_ += number(value);
  return *this;
}
Object& Object::put(std::string_view name, const std::optional<double>& value) {
  key(name);
  text_ += value ? number(*value) : "null";
  return *this;
}
Object& Object::put(std::string_view name, std::string_view value) {
  key(name);
  text_ += quoted(value);
  return *this;
}
Object& Object::put(std::string_view name, bool value) {
  key(name);
  text_ += value ? "true" : "false";
  return *this;
}
Object& Object::put(std::string_view name, const Object& value) {
  key(name);
  text_ += value.text();
  return *this;
}
Object& Object::put(std::string_view name, const std::vector<Object>& values) {
  key(name);
  text_ += '[';
  for (std::size_t i = 0; i < values.size(); ++i) text_ += (i > 0 ? "," : "") + values[i].text();
  text_ += ']';
  return *this;
}
Object& Object::put(std::string_view name, const std::vector<std::string>& values) {
  key(name);
  text_ += '[';
  for (std::size_t i = 0; i < values.size(); ++i) text_ += (i > 0 ? "," : "") + quoted(values[i]);
  text_ += ']';
  return *this;
}
Object& Object::numbers(std::string_view name, std::span<const double> values) {
  key(name);
  text_ += "{\"$\":[" + std::to_string(pool().size()) + "," + std::to_string(values.size()) + "]}";
  pool().insert(pool().end(), values.begin(), values.end());
  return *this;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    if (end > 0) lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

const char* answer(const std::function<Object()>& body) {
  static std::string text;
  pool().clear();
  text = caught(body).text();
  return text.c_str();
}

/// The address of the arrays of the last answer.
SLIPFRONT_EXPORT const double* numbers() { return pool().data(); }

}  // namespace slipfront::explorer
