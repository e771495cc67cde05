#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace slipfront {
class Ranks;
}
namespace CLI {
class App;
}

/// What every subcommand takes.
struct CommonOptions {
  bool json = false;
  bool csv = false;
  bool quiet = false;
  int threads = 0;  ///< 0: as many as there are cores
};

/// Exit codes of the contract.
enum ExitCode { exit_done = 0, exit_input = 2, exit_file = 3, exit_numerics = 4, exit_interrupted = 130 };

/// Adds --json, --csv (where there are rows), --quiet and --threads.
void add_common_options(CLI::App& command, CommonOptions& options, bool with_csv = true);

/// One line on stderr, beginning with the program's name.
void complain(std::string_view line);

/// Runs a subcommand, once the command line has been parsed, and gives the exit code.
using Runner = std::function<int()>;
struct Command {
  const char* name;
  Runner run;
};
/// Adds all that are written in C++ (commands.cpp).
std::vector<Command> add_commands(CLI::App& app);

/// Lists the subcommands that are written in Python, in the help.
void add_python_commands(CLI::App& app);
/// Becomes the Python program if the first argument names one of these subcommands; else returns. \throws FileError
/// where the package or the interpreter is missing.
void become_python(int argc, char** argv);

/// The processes that run this program, of which the first prints and writes.
extern const slipfront::Ranks* the_ranks;

/// What `slipfront` does when asked for nothing: `reproduce` into ./reproduction.
int run_default();

/// cases/catalogue.csv, embedded.
extern const std::string_view shipped_catalogue;
