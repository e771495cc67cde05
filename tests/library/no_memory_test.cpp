// A scenario is read with each of its allocations failing in turn. The answer is always that memory ran out, never that
// the text is bad. An exception from a function that is declared not to throw would end the whole test.
#include <gtest/gtest.h>

#include <new>
#include <string>
#include <utility>

#include "allocations.hpp"
#include "runs/record/netcdf/table_file.hpp"
#include "slipfront/error.hpp"
#include "slipfront/scenario/scenario.hpp"
#include "slipfront/text/quantity.hpp"
#include "system/machine.hpp"

#if !SLIPFRONT_SANITIZED

namespace {

using namespace slipfront;

/// Repeats `work` with its first, second ... allocation failed until none fails. Returns how many did.
template <class Work>
long fail_each(const Work& work) {
  for (long n = 0;; ++n) {
    std::string said;
    allocations::until_failure = n;
    try {
      work();
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& error) {
      allocations::until_failure = -1;
      said = error.what();
    }
    if (std::exchange(allocations::until_failure, -1) >= 0) return n;
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
