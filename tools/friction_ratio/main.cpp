// Makes the tables in src/friction_ratio with the pulse solver, and compares them with the solver at random points.
//   friction_ratio_table make > src/friction_ratio/coefficients.cpp
//   friction_ratio_table make-front > src/friction_ratio/front_coefficients.cpp
//   friction_ratio_table check POINTS        exit code 1 if an error exceeds the stated one

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "commands.hpp"

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "make") return slipfront::friction_ratio::make();
  if (argc == 2 && std::string_view(argv[1]) == "make-front") return slipfront::friction_ratio::make_front();
  if (argc == 3 && std::string_view(argv[1]) == "check" && std::atol(argv[2]) > 0)
    return slipfront::friction_ratio::check(std::atol(argv[2])) |
           slipfront::friction_ratio::check_front(std::atol(argv[2]));
  std::fputs("friction_ratio_table make | make-front | check POINTS\n", stderr);
  return 2;
}
