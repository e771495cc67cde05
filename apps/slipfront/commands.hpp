#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"

namespace slipfront {
class Ranks;
}

/// Options of every subcommand.
struct CommonOptions {
  bool json = false;
  bool csv = false;
  bool quiet = false;
  bool wide = false;
  int threads = 0;  ///< 0 means the number of cores
};

/// Exit codes of the program (docs/scenario.md).
enum ExitCode { exit_done = 0, exit_input = 2, exit_file = 3, exit_numerics = 4, exit_interrupted = 130 };

/// Adds --json, --csv (if the output has rows), --quiet, --wide and --threads.
void add_common_options(CommandLine& command, CommonOptions& options, bool with_csv = true);

/// Adds --wide.
void add_wide(CommandLine& command, bool& wide);

/// Prints one line on stderr that begins with the name of the program.
void complain(std::string_view line);

/// Runs a subcommand after the command line was parsed. Returns the exit code.
using Runner = std::function<int()>;
struct Command {
  const char* name;
  Runner run;
};
/// Adds the subcommands that are written in C++ (commands.cpp).
std::vector<Command> add_commands(CommandLine program);

/// Adds the subcommands that are written in Python to the help.
void add_python_commands(CommandLine program);
/// Replaces this process by Python if the first argument names one of these subcommands. Otherwise it returns.
/// \throws FileError if the package or the interpreter is missing.
void become_python(int argc, char** argv);

/// The processes that run this program together. Only the first one prints and writes.
extern const slipfront::Ranks* the_ranks;

/// Runs `slipfront` without arguments: `reproduce` into ./reproduction.
int run_default();

/// The contents of cases/catalogue.csv.
extern const std::string_view shipped_catalogue;
