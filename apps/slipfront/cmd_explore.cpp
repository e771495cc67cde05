#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>
#include <string>

#include "batch.hpp"
#include "commands.hpp"
#include "installed.hpp"
#include "json.hpp"
#include "record/files/text_file.hpp"
#include "slipfront/error.hpp"

/// The page that shows the theory. It is one file, which the browser reads from the disk.

namespace {

struct Arguments {
  CommonOptions common;
  std::string output;
  bool has_output = false;
};

/// Opens a file in the browser of the desktop. Its own messages are not ours. Returns false if there is no desktop.
bool open_in_browser(const std::string& file) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return false;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open", argument = file;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const bool started = posix_spawnp(&child, "xdg-open", &actions, nullptr, arguments, environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  return started;
}

int explore(const Arguments& a) {
  const std::string page = shipped_page();
  if (page.empty()) throw slipfront::FileError("the page has not been built; ./run explore builds and opens it");
  if (a.has_output) slipfront::record::write_text(a.output, slipfront::record::read_text(page));
  const std::string& file = a.has_output ? a.output : page;
  const bool opened = !a.has_output && open_in_browser(file);
  if (a.common.json)
    put(text_of({{"file", file}}) + "\n");
  else if (!a.common.quiet)
    put(fmt::format("The explorer is in {}{}\n", file, opened ? "" : "; open this file in a browser"));
  return exit_done;
}

}  // namespace

Runner add_explore(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "explore", "The theory in the browser: opens a page, one file that needs neither a server nor a network");
  command->footer(
      "Examples:"
      "\n  slipfront explore"
      "\n  slipfront explore -o explorer.html");
  CLI::Option* output =
      command->add_option("-o,--output", arguments->output, "Only write the page to this file (.html)")
          ->type_name("FILE");
  add_common_options(*command, arguments->common, false);
  return [arguments, output] {
    arguments->has_output = output->count() > 0;
    return explore(*arguments);
  };
}
