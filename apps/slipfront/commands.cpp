#include "commands.hpp"

using AddCommand = Runner(CommandLine& program);

// One line a subcommand, in the order of --help; each is defined in cmd_<name>.cpp.
#define SLIPFRONT_COMMANDS(COMMAND) \
  COMMAND(relations)                \
  COMMAND(riemann)                  \
  COMMAND(event)                    \
  COMMAND(columns)                  \
  COMMAND(pulse)                    \
  COMMAND(chain)                    \
  COMMAND(compare)                  \
  COMMAND(plane)                    \
  COMMAND(keys)                     \
  COMMAND(units)                    \
  COMMAND(doctor)                   \
  COMMAND(explore)

#define DECLARE(name) AddCommand add_##name;
SLIPFRONT_COMMANDS(DECLARE)

std::vector<Command> add_commands(CommandLine program) {
#define ADD(name) {#name, add_##name(program)},
  return {SLIPFRONT_COMMANDS(ADD)};
}
