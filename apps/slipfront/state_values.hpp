#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

struct StateValue {
  double value;
  std::size_t line;  ///< line of stdin; 0 for the command line
};

/// The numbers that one value of --stress, --rupture-velocity or --slip-velocity stands for. It may be a number or a
/// range `a:b:n` of n evenly spaced values that includes both ends. The values of `a:b:n:log` are evenly spaced in the
/// logarithm. `-` reads one number per line from stdin, without blank lines and comments after '#'. A number with a
/// unit goes to `in_model`. \throws InputError that names the option or the line.
std::vector<StateValue> state_values(const std::string& text, const std::string& option,
                                     const std::function<double(const std::string&)>& in_model);
