#pragma once

#include <cstddef>
#include <string>
#include <vector>

struct StateValue {
  double value;
  std::size_t line;  ///< of stdin, 0 from the command line
};

/// The numbers meant by one value of --stress, --rupture-velocity or --slip-velocity: a number, a range `a:b:n` (n
/// values, both ends included, evenly spaced), `a:b:n:log` (evenly spaced in the logarithm), or `-` for one number a
/// line on stdin (blank lines and what follows a '#' are skipped). \throws InputError naming the option or the line.
std::vector<StateValue> state_values(const std::string& text, const std::string& option);
