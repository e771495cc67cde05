#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// A request that is answered with an error. The text goes to the client.
class RefusedRequest : public std::runtime_error {
 public:
  RefusedRequest(int status, const std::string& text) : std::runtime_error(text), status_(status) {}
  int status() const { return status_; }

 private:
  int status_;
};

/// A request for a file of the page.
struct HttpRequest {
  std::vector<std::string> path;  ///< names of folders and of the file, decoded; index.html if the path is "/"
  std::string host;               ///< name or address in the Host header, in lower case and without the port
  bool head_only = false;         ///< HEAD instead of GET
};

/// Reads the request line and the header fields, up to the empty line that ends them. Ranges are ignored, which
/// RFC 9110 allows: the whole file is sent. \throws RefusedRequest where the method is not GET or HEAD, a page of
/// another origin asks, a name in the path is empty or begins with a dot, or the text is not HTTP/1.
HttpRequest parse_request(std::string_view text);
