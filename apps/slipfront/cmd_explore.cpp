#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "batch.hpp"
#include "commands.hpp"
#include "installed.hpp"
#include "json.hpp"
#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"

/// The page that shows the theory. It is one file, which the browser reads from the disk.

namespace {

struct ExploreArguments {
  CommonOptions common;
  std::string output;
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

int explore(const ExploreArguments& a) {
  const std::string page = shipped_page();
  if (page.empty()) throw slipfront::FileError("the page has not been built; ./run explore builds and opens it");
  if (!a.output.empty()) slipfront::record::write_text(a.output, slipfront::record::read_text(page));
  const std::string& file = !a.output.empty() ? a.output : page;
  const bool opened = a.output.empty() && open_in_browser(file);
  if (a.common.json)
    put(text_of({{"file", file}}) + "\n");
  else if (!a.common.quiet)
    put(fmt::format("The explorer is in {}{}\n", file, opened ? "" : "; open this file in a browser"));
  return exit_done;
}

}  // namespace

Runner add_explore(CommandLine& program) {
  auto arguments = std::make_shared<ExploreArguments>();
  CommandLine command = program.command(
      "explore", "The theory in the browser: opens a page, one file that needs neither a server nor a network",
      {"slipfront explore", "slipfront explore -o explorer.html"});
  command.option("-o,--output", "FILE", arguments->output, "Only write the page to this file (.html)")
      .checked_by([](const std::string& path) { return path.empty() ? "the file name is empty" : ""; });
  add_common_options(command, arguments->common, false);
  return [arguments] { return explore(*arguments); };
}
