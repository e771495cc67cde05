// A scenario is read with each of its allocations failing in turn. The answer is always that memory ran out, never that
// the text is bad. An exception from a function that is declared not to throw would end the whole test.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <string>
#include <utility>

#include "foundation/sanitized.hpp"
#include "record/table_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/medium/quantity.hpp"
#include "slipfront/scenario/scenario.hpp"

#if !SLIPFRONT_SANITIZED

namespace {

thread_local long left = -1;  ///< Allocations until one fails; none does below 0.

}  // namespace

void* operator new(std::size_t size) {
  if (left >= 0 && left-- == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using namespace slipfront;

/// Repeats `work` with its first, second ... allocation failed until none fails. Returns how many did. One may do no
/// harm: muParser tries names as numbers first, by streams that keep the failure to themselves.
template <class Work>
long fail_each(const Work& work) {
  for (long n = 0;; ++n) {
    std::string said;
    left = n;
    try {
      work();
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& error) {
      left = -1;
      said = error.what();
    }
    if (std::exchange(left, -1) >= 0) return n;
    EXPECT_EQ(said, "") << "allocation " << n;
  }
}

TEST(NoMemory, IsWhatIsSaidOfAScenario) {
  const std::string text =
      "title = 'a'\n[initial]\nprofile = 'formula'\nformula = '0.8 * (x < 0)'\n[friction]\nlaw = "
      "'viscous'\ncoefficient = "
      "0.25\n[forcing]\nformula = '0.1 * sin(x)'\n[medium]\nshear_modulus = '30 GPa'\n[domain]\nleft = -2.5\nright = "
      "3\n";
  EXPECT_GT(fail_each([&] {
              scenario::read_scenario(text, "scenario", {"friction.law=coulomb", "time.end=1.5"}, record::read_table);
            }),
            100);
}

TEST(NoMemory, IsWhatIsSaidOfAQuantity) {
  fail_each([] { medium::parse_quantity("0.000000000000000003 kilometres/day", medium::Dimension::velocity); });
}

}  // namespace

#endif
