#include "usage_error.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "foundation/text/nearest.hpp"

namespace {

/// The subcommand that was given; the program itself if there is none.
const CLI::App& chosen(const CLI::App& app) {
  const std::vector<CLI::App*> given = app.get_subcommands();
  return given.empty() ? app : chosen(*given.front());
}

/// Names that the user can have meant by `word`: options if it begins with a dash, otherwise subcommands.
std::vector<std::string> candidates(const CLI::App& command, const std::string& word) {
  std::vector<std::string> names;
  if (word.starts_with('-')) {
    for (const CLI::Option* option : command.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  } else {
    for (const CLI::App* sub : command.get_subcommands({})) names.push_back(sub->get_name());
  }
  return names;
}

std::string nearest(const CLI::App& app) {
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return {};
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : candidates(chosen(app), word)) {
    const std::size_t distance = slipfront::edit_distance(word, name);
    if (distance < least) {
      best = name;
      least = distance;
    }
  }
  return best.empty() ? "" : "; did you mean " + best + "?";
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = error.what();
  for (char& c : text)
    if (c == '\n') c = ' ';
  std::string help = "slipfront";
  for (const CLI::App* command : app.get_subcommands()) help += " " + command->get_name();
  text += nearest(app);
  return text + (text.ends_with('?') ? " See " : "; see ") + help + " --help";
}
