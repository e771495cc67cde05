#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <new>
#include <string>

#include "batch.hpp"
#include "build_facts.hpp"
#include "commands.hpp"
#include "foundation/machine.hpp"
#include "foundation/ranks.hpp"
#include "foundation/text/printable.hpp"
#include "interrupts.hpp"
#include "slipfront/error.hpp"
#include "usage_error.hpp"

const slipfront::Ranks* the_ranks = nullptr;

void complain(std::string_view line) { std::fprintf(stderr, "slipfront: %s\n", slipfront::printable(line).c_str()); }

void add_common_options(CLI::App& command, CommonOptions& options, bool with_csv) {
  auto* json = command.add_flag("--json", options.json, "One JSON object on stdout, nothing else");
  if (with_csv) command.add_flag("--csv", options.csv, "One CSV row each, full precision")->excludes(json);
  command.add_flag("--quiet", options.quiet, "No notes, no warnings");
  command.add_option("--threads", options.threads, "Threads; results do not depend on it (default: all cores)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  command.parse_complete_callback([&options] {
    options.threads = slipfront::sensible_threads(options.threads);
    if (options.threads > 0) return;  // else the cores of this machine, shared by the ranks on it
    const long ranks = std::lround(the_ranks->size() * the_ranks->share_of_machine());
    options.threads = std::max(1, omp_get_max_threads() / static_cast<int>(std::max(1L, ranks)));
  });
}

namespace {

/// Help as CLI11 prints it, but without "(1x)" after an argument of which one is enough.
class Help : public CLI::Formatter {
  std::string make_option_usage(const CLI::Option* option) const override {
    std::string usage = CLI::Formatter::make_option_usage(option);
    if (const auto at = usage.find("(1x)"); at != std::string::npos) usage.erase(at, 4);
    return usage;
  }
};

int run(int argc, char** argv) {
  CLI::App app{
      "slipfront: how an interface goes from stuck to sliding. Without a subcommand: `reproduce`, the paper "
      "in ./reproduction."};
  app.name("slipfront");
  app.formatter(std::make_shared<Help>());
  bool version = false, json = false;
  CLI::Option* const asked = app.add_flag("--version", version, "Print the version");
  app.add_flag("--json", json, "With --version: the versions of the compiler and the libraries of this build")
      ->needs(asked);
  app.require_subcommand(0, 1);
  app.failure_message(CLI::FailureMessage::simple);
  Runner chosen = run_default;
  const std::vector<Command> commands = add_commands(app);
  add_python_commands(app);
  if (the_ranks->rank() == 0) become_python(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    if (the_ranks->rank() == 0) app.exit(help);
    if (!std::cout.flush()) throw slipfront::FileError("stdout: cannot be written");
    return exit_done;
  } catch (const CLI::ParseError& error) {
    if (the_ranks->rank() == 0) complain(usage_error(app, error));
    return exit_input;
  }
  if (version) {
    if (the_ranks->rank() == 0) put(json ? text_of(build_facts()) + "\n" : SLIPFRONT_VERSION "\n");
    finish_stdout();
    return exit_done;
  }
  for (const Command& command : commands)
    if (app.got_subcommand(command.name)) chosen = command.run;
  // Only chains and planes are shared; of anything else the first rank does it all.
  if (the_ranks->rank() > 0 && !app.got_subcommand("chain") && !app.got_subcommand("plane")) return exit_done;
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
      return ranks.code_of(run(argc, argv));
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
