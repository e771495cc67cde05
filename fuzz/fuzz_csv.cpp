// libFuzzer target: no text may crash the catalogue reader.

#include <cstddef>
#include <cstdint>

#include "check.hpp"
#include "slipfront/events/catalogue/read.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    slipfront::catalogue::read_csv({reinterpret_cast<const char*>(data), size}, "fuzz.csv",
                                   [](slipfront::catalogue::Entry&& entry) {
                                     if (!entry.error) check_observation(entry.observation);
                                   });
  } catch (const slipfront::InputError&) {
  }
  return 0;
}
