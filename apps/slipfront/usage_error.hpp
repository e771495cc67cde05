#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

/// The text of a CLI11 error on one line. If a subcommand or an option is unknown, the text names the nearest known
/// one; it ends with the command that prints the help.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);
