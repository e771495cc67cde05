#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "slipfront/medium/constants.hpp"

/// Options of the command line.
struct EventArguments {
  CommonOptions common;
  std::vector<std::string> files;
  slipfront::medium::StatedDefaults medium;
  std::optional<std::size_t> samples;
  std::uint64_t seed = 1;
  std::string closure = "consistent";
  bool pulse = false, population = false;
  std::string output, resume;
  std::size_t draws = 0;
  std::string column_map;  ///< file of --columns
  bool strict = false;
};

/// Prints events, some at a time. Returns the exit code.
int print_events(const EventArguments& arguments);

/// Writes events to a file. Returns the exit code. \throws InputError, FileError.
int write_events(const EventArguments& arguments);
