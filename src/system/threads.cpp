#include "system/threads.hpp"

#include <new>
#include <system_error>

namespace slipfront {

std::vector<std::jthread> start_threads(std::size_t wanted, const std::function<void()>& body) {
  std::vector<std::jthread> started;
  try {
    started.reserve(wanted);
    for (std::size_t i = 0; i < wanted; ++i) started.emplace_back([&body] { body(); });
  } catch (const std::system_error&) {
  } catch (const std::bad_alloc&) {
  }
  return started;
}

}  // namespace slipfront
