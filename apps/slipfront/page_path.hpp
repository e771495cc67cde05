#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// A request that is answered with an error. The text goes to the client.
class RefusedRequest : public std::runtime_error {
 public:
  RefusedRequest(unsigned status, const std::string& text) : std::runtime_error(text), status_(status) {}
  unsigned status() const { return status_; }

 private:
  unsigned status_;
};

/// Decodes the target of a request into the names of folders and of the file; index.html if the path is "/".
/// \throws RefusedRequest if it is not a path, or if a name in it is empty or begins with a dot.
std::vector<std::string> page_path(std::string_view target);
