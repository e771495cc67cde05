// libFuzzer target: no .fsp text may crash the reader or make it return a velocity that is none.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "check.hpp"
#include "slipfront/catalogue/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto o = slipfront::catalogue::read_fsp({reinterpret_cast<const char*>(data), size}, "fuzz.fsp");
    if (o.line == 0) std::abort();
    if (o.poisson_ratio && !(*o.poisson_ratio > 0 && *o.poisson_ratio < 0.5)) std::abort();
    check_observation(o);
  } catch (const slipfront::InputError&) {
  }
  return 0;
}
