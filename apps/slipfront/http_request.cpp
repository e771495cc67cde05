#include "http_request.hpp"

#include <algorithm>

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t";
  const std::size_t first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

/// Removes the next line from the text and returns it.
std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find("\r\n");
  if (end == std::string_view::npos) throw RefusedRequest(400, "The request is not HTTP.");
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end + 2);
  return line;
}

int hex_digit(char c) {
  c = lower(c);
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  throw RefusedRequest(400, "The path has a '%' without two hexadecimal digits.");
}

std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    if (text.size() - i < 3) throw RefusedRequest(400, "The path ends within a '%' escape.");
    result += static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2]));
    i += 2;
  }
  return result;
}

/// A dot at the beginning covers "..", "." and files that are hidden.
bool is_served_name(const std::string& name) {
  if (name.empty() || name[0] == '.') return false;
  for (const char c : name)
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20) return false;
  return true;
}

std::vector<std::string> names_of(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  if (target.empty() || target[0] != '/') throw RefusedRequest(400, "The path does not begin with '/'.");
  if (target == "/") return {"index.html"};
  std::vector<std::string> names;
  while (!target.empty()) {
    target.remove_prefix(1);
    const std::size_t end = std::min(target.find('/'), target.size());
    names.push_back(decoded(target.substr(0, end)));
    if (!is_served_name(names.back())) throw RefusedRequest(404, "There is no such file.");
    target.remove_prefix(end);
  }
  return names;
}

/// The host without its port. An IPv6 address keeps its brackets.
std::string host_name(std::string_view host) {
  const std::size_t begin = host.empty() || host[0] != '[' ? 0 : std::min(host.find(']'), host.size());
  return lower(host.substr(0, host.find(':', begin)));
}

std::string_view target_of(std::string_view line, bool& head_only) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) throw RefusedRequest(400, "The request is not HTTP.");
  if (line.substr(last + 1, 7) != "HTTP/1.") throw RefusedRequest(505, "Only HTTP/1 is supported.");
  const std::string_view method = line.substr(0, first);
  if (method != "GET" && method != "HEAD") throw RefusedRequest(405, "Only GET and HEAD are allowed.");
  head_only = method == "HEAD";
  return line.substr(first + 1, last - first - 1);
}

struct Fields {
  std::string host, origin;
  int hosts = 0, origins = 0;
};

Fields fields_of(std::string_view text) {
  Fields fields;
  for (std::string_view line = next_line(text); !line.empty(); line = next_line(text)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) throw RefusedRequest(400, "A header field has no ':'.");
    const std::string name = lower(line.substr(0, colon));
    const std::string value = lower(trimmed(line.substr(colon + 1)));
    if (name == "host" && ++fields.hosts) fields.host = value;
    if (name == "origin" && ++fields.origins) fields.origin = value;
  }
  return fields;
}

}  // namespace

HttpRequest parse_request(std::string_view text) {
  HttpRequest request;
  const std::string_view target = target_of(next_line(text), request.head_only);
  const Fields fields = fields_of(text);
  request.host = host_name(fields.host);
  if (fields.hosts != 1 || request.host.empty()) throw RefusedRequest(400, "The request needs one Host header.");
  const bool is_own = fields.origin == "http://" + fields.host || fields.origin == "https://" + fields.host;
  if (fields.origins > 1 || (fields.origins == 1 && !is_own))
    throw RefusedRequest(403, "Pages of other origins may not ask here.");
  request.path = names_of(target);
  return request;
}
