// Makes src/friction_ratio/coefficients.cpp with the pulse solver, and compares the table with the solver at random
// points.
//   friction_ratio_table make > src/friction_ratio/coefficients.cpp
//   friction_ratio_table check POINTS        exit code 1 if an error exceeds the stated one

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "commands.hpp"

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "make") return slipfront::friction_ratio::make();
  if (argc == 3 && std::string_view(argv[1]) == "check" && std::atol(argv[2]) > 0)
    return slipfront::friction_ratio::check(std::atol(argv[2]));
  std::fputs("friction_ratio_table make | check POINTS\n", stderr);
  return 2;
}
