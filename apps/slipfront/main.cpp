#include <algorithm>
#include <cmath>
#include <cstdio>
#include <new>
#include <string>

#include "batch.hpp"
#include "build_facts.hpp"
#include "commands.hpp"
#include "interrupts.hpp"
#include "slipfront/error.hpp"
#include "system/machine.hpp"
#include "system/ranks.hpp"
#include "terminal_table.hpp"
#include "text/characters.hpp"

const slipfront::Ranks* the_ranks = nullptr;

void complain(std::string_view line) {
  std::fputs(fitted_message("slipfront: " + slipfront::printable_message(line)).c_str(), stderr);
}

void add_wide(CommandLine& command, bool& wide) {
  command.flag("--wide", wide, "All columns side by side, all rows and digits (default: what fits the terminal)");
}

void add_common_options(CommandLine& command, CommonOptions& options, bool with_csv) {
  const Option json = command.flag("--json", options.json, "One JSON object on stdout, nothing else");
  if (with_csv) command.flag("--csv", options.csv, "One CSV row each, full precision").excludes(json);
  command.flag("--quiet", options.quiet, "No notes, no warnings");
  add_wide(command, options.wide);
  command.option("--threads", "N", options.threads, "Threads; results do not depend on it (default: all cores)")
      .in_range(1, 4096);
  command.when_parsed([&options] {
    if (options.wide) print_whole_lines();
    options.threads = slipfront::sensible_threads(options.threads);
    if (options.threads > 0) return;  // else the cores of this machine, shared by the ranks on it
    const long ranks = std::lround(the_ranks->size() * the_ranks->share_of_machine());
    options.threads = std::max(1, slipfront::usable_cores() / static_cast<int>(std::max(1L, ranks)));
  });
}

namespace {

int run_command(int argc, char** argv) {
  ProgramLine line(
      "slipfront: how an interface goes from stuck to sliding. Without a subcommand: `reproduce`, the paper "
      "in ./reproduction.");
  CommandLine program = line.top();
  bool version = false, json = false;
  const Option asked = program.flag("--version", version, "Print the version");
  program.flag("--json", json, "With --version: the versions of the compiler and the libraries of this build")
      .needs(asked);
  const std::vector<Command> commands = add_commands(program);
  add_python_commands(program);
  const bool first = the_ranks->rank() == 0;
  if (first) become_python(argc, argv);
  const auto [kind, text] = line.parse(argc, argv);
  if (kind == ProgramLine::Parsed::Kind::error) {
    if (first) complain(text);
    return exit_input;
  }
  if (version || kind == ProgramLine::Parsed::Kind::help) {
    if (first) put(!version ? fitted_help(text) : json ? text_of(build_facts()) + "\n" : SLIPFRONT_VERSION "\n");
    finish_stdout();
    return exit_done;
  }
  Runner chosen = run_default;
  for (const Command& command : commands)
    if (program.has(command.name)) chosen = command.run;
  // Only chains and planes are shared; of anything else the first rank does it all.
  if (!first && !program.has("chain") && !program.has("plane")) return exit_done;
  const int code = chosen();
  finish_stdout();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  end_on_interrupts();
  try {
    const slipfront::Ranks ranks = slipfront::Ranks::of_mpirun();
    the_ranks = &ranks;
    const auto failed = [&](int code, const char* text) { return ranks.failed(code, [text] { complain(text); }); };
    try {
      std::string arguments;
      for (int i = 1; i < argc; ++i) arguments.append(argv[i]).append(1, '\0');
      ranks.require_same("command line", arguments);
      return ranks.code_of(run_command(argc, argv));
    } catch (const slipfront::InputError& error) {
      return ranks.failed(exit_input, [&] {
        for (const slipfront::Complaint& complaint : error.complaints()) complain(slipfront::one_line(complaint));
      });
    } catch (const slipfront::FileError& error) {
      return failed(exit_file, error.what());
    } catch (const std::bad_alloc&) {
      return failed(exit_numerics, "out of memory");
    } catch (const std::exception& error) {
      return failed(exit_numerics, error.what());
    }
  } catch (const std::exception& error) {  // MPI that is not there
    complain(error.what());
    return exit_input;
  }
}
