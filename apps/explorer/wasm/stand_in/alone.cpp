/// \file
/// The machine functions of the library for a web page, which has one thread, limited memory and no files.

#include "system/machine.hpp"
#include "system/parallel.hpp"
#include "text/file_kind.hpp"

namespace slipfront {

double usable_memory() { return 0.8e9; }
int sensible_threads(int) { return 1; }
void refuse_other_kinds(std::string_view, const std::string&, ReadAs) {}

void for_each_parallel(std::size_t count, int, const std::function<void(std::size_t)>& body, std::size_t) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace slipfront
