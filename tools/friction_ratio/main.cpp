// Makes the tables in src/friction/ratio with the pulse solver, and compares them with the solver at random points.
//   friction_ratio_table make                in the folder src/friction/ratio: writes coefficients.csv, corners.csv
//   friction_ratio_table make-front          likewise front_coefficients.csv, drop_coefficients.csv
//   friction_ratio_table check POINTS        exit code 1 if an error exceeds the stated one

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "commands.hpp"

namespace slipfront::friction_ratio {

std::FILE* table_file(const std::string& name) {
  std::FILE* const file = std::fopen((name + ".csv").c_str(), "w");
  if (file != nullptr) return file;
  std::perror(name.c_str());
  std::exit(3);
}

}  // namespace slipfront::friction_ratio

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "make") return slipfront::friction_ratio::make();
  if (argc == 2 && std::string_view(argv[1]) == "make-front") return slipfront::friction_ratio::make_front();
  if (argc == 3 && std::string_view(argv[1]) == "check" && std::atol(argv[2]) > 0)
    return slipfront::friction_ratio::check(std::atol(argv[2])) |
           slipfront::friction_ratio::check_front(std::atol(argv[2]));
  std::fputs("friction_ratio_table make | make-front | check POINTS\n", stderr);
  return 2;
}
