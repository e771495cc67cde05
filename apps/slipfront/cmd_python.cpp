#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.hpp"
#include "installed.hpp"
#include "slipfront/error.hpp"

/// Subcommands of the Python package. They receive their arguments unchanged.

namespace {

struct PythonCommand {
  const char* name;
  const char* help;
};
constexpr std::array<PythonCommand, 7> python_commands = {{
    {"sweep", "A scenario at every point of a grid of settings"},
    {"fronts", "Fronts of a run: path, velocity, and the stress ahead"},
    {"laboratory", "Hardness over modulus from the velocities of fronts in the laboratory"},
    {"population", "Stress, normal stress and friction of many events at once"},
    {"reproduce", "Every number and figure of the paper, as a page that opens in a browser"},
    {"plot", "Figures of the files that slipfront writes"},
    {"animate", "A slip pulse as a moving picture"},
}};

/// The program that Python runs. Signals that ask it to end are blocked until it can handle them.
constexpr const char* launch =
    "import os, signal, sys\n"
    "ending = {signal.SIGINT, signal.SIGTERM, signal.SIGHUP}\n"
    "def interrupted(*_):\n"
    "    os.write(2, b'slipfront: interrupted\\n')\n"
    "    os._exit(130)\n"
    "for number in ending:\n"
    "    if signal.getsignal(number) != signal.SIG_IGN:\n"
    "        signal.signal(number, interrupted)\n"
    "signal.pthread_sigmask(signal.SIG_UNBLOCK, ending)\n"
    "try:\n"
    "    from slipfront.__main__ import end, main\n"
    "except ImportError as error:\n"
    "    print(f'slipfront: {error}', file=sys.stderr)\n"
    "    sys.exit(3)\n"
    "end(main())\n";

/// Python handles signals only some time after its start, so we block them first. exec keeps the signal mask.
void block_interrupts() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, number);
  sigprocmask(SIG_BLOCK, &ending, nullptr);
}

/// Becomes the Python interpreter that runs a subcommand with these arguments. Does not return.
[[noreturn]] void hand_over(std::string name, char** first, char** last) {
  const std::filesystem::path folder = package_folder();
  if (folder.empty())
    throw slipfront::FileError(name +
                               ": the Python package slipfront is missing next to this program; install the Debian "
                               "package python3-slipfront, or pybind11-dev and python3-dev, and build again");
  std::string path = folder.string();
  if (const char* others = std::getenv("PYTHONPATH"); others && *others) path += std::string(":") + others;
  setenv("PYTHONPATH", path.c_str(), 1);
  setenv("PYTHONSAFEPATH", "1", 1);  // else a folder `slipfront` in the working directory would hide the package
  std::string interpreter = python_interpreter(), option = "-c", code = launch;
  std::vector<char*> arguments = {interpreter.data(), option.data(), code.data(), name.data()};
  arguments.insert(arguments.end(), first, last);
  arguments.push_back(nullptr);
  block_interrupts();
  execv(interpreter.c_str(), arguments.data());
  throw slipfront::FileError(interpreter + ": " + std::strerror(errno) + "; install the Debian package python3");
}

}  // namespace

void add_python_commands(CommandLine program) {
  for (const PythonCommand& command : python_commands) program.command(command.name, command.help);
}

void become_python(int argc, char** argv) {
  if (argc < 2) return;
  for (const PythonCommand& command : python_commands)
    if (std::strcmp(argv[1], command.name) == 0) hand_over(command.name, argv + 2, argv + argc);
}

int run_default() { hand_over("reproduce", nullptr, nullptr); }
