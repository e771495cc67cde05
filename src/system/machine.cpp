#include "system/machine.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <locale>
#include <string>
#endif

namespace slipfront {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

#if defined(__linux__)

/// The number that a file holds; infinity for "max" and where there is no such file.
double limit_in(const std::string& path) {
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  double bytes = 0;
  file >> bytes;
  if (file.fail() || !(bytes > 0)) return unknown;
  return bytes;
}

/// The least limit of a control group and of those that it lies in.
double limit_along(const std::string& root, std::string group, const char* name) {
  double least = limit_in(root + "/" + name);
  while (group.size() > 1) {
    least = std::min(least, limit_in(root + group + "/" + name));
    group.resize(group.find_last_of('/'));
  }
  return least;
}

double limit_of_groups() {
  double least = unknown;
  std::ifstream groups("/proc/self/cgroup");  // lines such as 0::/user.slice or 9:memory:/job
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (controllers.empty()) least = std::min(least, limit_along("/sys/fs/cgroup", group, "memory.max"));
    if (controllers == "memory")
      least = std::min(least, limit_along("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

double limit_of_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  return static_cast<double>(limit.rlim_cur);
}

double memory_of_machine() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

#endif

}  // namespace

double usable_memory() {
#if defined(__linux__)
  return std::min({memory_of_machine(), limit_of_groups(), limit_of_process()});
#else
  return unknown;
#endif
}

namespace {

int cores() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

}  // namespace

int usable_cores() {
  const char* const allowed = std::getenv("OMP_NUM_THREADS");
  int most = 0;
  if (allowed != nullptr) std::from_chars(allowed, allowed + std::strlen(allowed), most);
  return most > 0 ? std::min(most, cores()) : cores();
}

int sensible_threads(int wanted) { return std::min(wanted, std::max(16, 2 * cores())); }

}  // namespace slipfront
