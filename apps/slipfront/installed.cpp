#include "installed.hpp"

#include <cstdlib>
#include <system_error>

namespace {

/// The folder above that of this executable; empty if the system does not report it.
std::filesystem::path prefix() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path().parent_path();
}

}  // namespace

std::filesystem::path package_folder() {
  const std::filesystem::path above = prefix();
  std::error_code error;
  if (above.empty()) return {};
  for (const char* folder : {"python", SLIPFRONT_PYTHON_DIR})
    if (std::filesystem::exists(above / folder / "slipfront" / "__main__.py", error))
      return (above / folder).lexically_normal();
  return {};
}

std::string shipped_page() {
  const std::filesystem::path page = prefix() / "share" / "slipfront" / "explorer" / "index.html";
  std::error_code error;
  return std::filesystem::is_regular_file(page, error) ? page.string() : std::string();
}

std::string python_interpreter() {
  const char* chosen = std::getenv("SLIPFRONT_PYTHON");
  return chosen && *chosen ? chosen : SLIPFRONT_PYTHON_INTERPRETER;
}
