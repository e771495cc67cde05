// libFuzzer target: no text may crash the TOML event reader.

#include <cstddef>
#include <cstdint>

#include "check.hpp"
#include "slipfront/events/catalogue/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check_observation(slipfront::catalogue::read_toml({reinterpret_cast<const char*>(data), size}, "fuzz.toml"));
  } catch (const slipfront::InputError&) {
  }
  return 0;
}
