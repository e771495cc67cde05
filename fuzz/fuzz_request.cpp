// libFuzzer target: no request may crash the server of the explorer, nor name a file outside the page.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "http_request.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const HttpRequest request = parse_request({reinterpret_cast<const char*>(data), size});
    if (request.path.empty() || request.host.empty()) std::abort();
    for (const std::string& name : request.path)
      if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
        std::abort();
  } catch (const RefusedRequest&) {
  }
  return 0;
}
