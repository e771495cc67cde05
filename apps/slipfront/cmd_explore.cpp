#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "batch.hpp"
#include "commands.hpp"
#include "installed.hpp"
#include "interrupts.hpp"
#include "json.hpp"
#include "page_server.hpp"
#include "slipfront/error.hpp"

/// The page that shows the theory, served to the browser of this machine.

namespace {

using slipfront::FileError;
using slipfront::InputError;

constexpr int usual_port = 8757;

struct ExploreArguments {
  CommonOptions common;
  std::string folder, address = "127.0.0.1";
  int port = 0;
  bool no_open = false, anyone = false;
};

std::filesystem::path page(const ExploreArguments& a) {
  std::filesystem::path folder = a.folder.empty() ? shipped_page() : std::filesystem::path(a.folder);
  std::error_code error;
  if (std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / "index.html", error))) return folder;
  if (!a.folder.empty()) throw FileError(a.folder + ": the folder contains no page (index.html is missing)");
  throw FileError("the page has not been built; ./run explore builds it and serves it");
}

void check(const ExploreArguments& a) {
  if (a.port < 0 || a.port > 65535)
    throw InputError({.file = "command line",
                      .key = "--port",
                      .value = std::to_string(a.port),
                      .problem = "out of range",
                      .allowed = "1 to 65535, or 0 for any that is free"});
}

/// Opens the browser of the desktop, if there is one. Its own messages are not ours.
void open_browser(const std::string& url) {
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open", argument = url;
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  posix_spawnp(&child, "xdg-open", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
}

void announce(const ExploreArguments& a, const std::string& folder, int port) {
  const std::string host = a.address.find(':') == std::string::npos ? a.address : "[" + a.address + "]";
  const std::string url = fmt::format("http://{}:{}/", host, port);
  interrupted_means("; the page is no longer served");
  if (a.common.json)
    put(text_of({{"url", url}, {"folder", folder}}) + "\n");
  else if (!a.common.quiet)
    put(fmt::format("The explorer is at {}  (Ctrl-C ends it)\n", url));
  std::fflush(stdout);
  if (!a.no_open) open_browser(url);
}

int serve(const ExploreArguments& a, bool asked_port) {
  check(a);
  const std::string folder = page(a).string();
  const std::vector<int> ports = asked_port ? std::vector{a.port} : std::vector{usual_port, 0};
  serve_page(folder, {.address = a.address, .ports = ports, .anyone = a.anyone},
             [&](int port) { announce(a, folder, port); });
}

}  // namespace

Runner add_explore(CommandLine& program) {
  auto arguments = std::make_shared<ExploreArguments>();
  CommandLine command =
      program.command("explore", "The theory in the browser: serves the page on this machine, and opens it",
                      {"slipfront explore --port 0 --no-open"});
  const Option port = command.option("--port", "PORT", arguments->port,
                                     fmt::format("Port (default: {}, or any that is free)", usual_port));
  command.flag("--no-open", arguments->no_open, "Do not open a browser");
  command.option("--folder", "DIR", arguments->folder,
                 "Serve the page in this folder (default: the one next to the program)");
  command.option("--address", "ADDRESS", arguments->address,
                 "Address to serve on (default: 127.0.0.1, this machine only)");
  command.flag("--anyone", arguments->anyone, "Allow an address that other machines reach");
  add_common_options(command, arguments->common, false);
  return [arguments, port, command] {
    const std::vector<Option> given = command.given();
    return serve(*arguments, std::find(given.begin(), given.end(), port) != given.end());
  };
}
