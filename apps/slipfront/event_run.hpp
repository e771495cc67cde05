#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "runs/catalogue.hpp"
#include "slipfront/theory/medium/constants.hpp"

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
  bool fault_grid = false;
  std::string srf_version;               ///< "1.0" or "2.0"
  std::optional<double> damping_number;  ///< sets the shape of slip-rate functions
  std::string column_map;                ///< file of --columns
  bool strict = false;
};

/// Prints events, some at a time. Returns the exit code.
int print_events(const EventArguments& arguments);

/// Writes events to a file. Returns the exit code. \throws InputError, FileError.
int write_events(const EventArguments& arguments);

/// Whether the output file describes the fault of one finite-fault model, not events.
bool describes_fault(const EventArguments& arguments);
/// Whether the output file is a kinematic source, by its ending.
bool writes_source(const EventArguments& arguments);
/// Writes that file. Returns the exit code. \throws InputError, FileError.
int write_fault(const EventArguments& arguments, const slipfront::run::CatalogueScenario& scenario);
