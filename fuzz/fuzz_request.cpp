// libFuzzer target: no target of a request may crash the server of the explorer, nor name a file outside the page.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "page_path.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::vector<std::string> path = page_path({reinterpret_cast<const char*>(data), size});
    if (path.empty()) std::abort();
    for (const std::string& name : path)
      if (name.empty() || name[0] == '.' || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
        std::abort();
  } catch (const RefusedRequest&) {
  }
  return 0;
}
