#pragma once

#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace slipfront {

/// Starts up to `wanted` threads that call `body`, which must not throw. If the machine provides fewer, those that have
/// started are returned. `body` must exist until they have been joined.
std::vector<std::jthread> start_threads(std::size_t wanted, const std::function<void()>& body);

}  // namespace slipfront
