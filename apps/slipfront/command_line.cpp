#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <sstream>

#include "slipfront/error.hpp"
#include "system/files/whole_file.hpp"
#include "text/characters.hpp"

Option& Option::required() { return option_->required(), *this; }
Option& Option::repeatable() { return option_->allow_extra_args(false), *this; }
Option& Option::in_range(int least, int most) { return option_->check(CLI::Range(least, most)), *this; }
Option& Option::in_range(double least, double most) { return option_->check(CLI::Range(least, most)), *this; }
Option& Option::one_of(std::vector<std::string> values) {
  return option_->check(CLI::IsMember(std::move(values))), *this;
}
Option& Option::checked_by(std::function<std::string(const std::string&)> error) {
  return option_->check(std::move(error)), *this;
}
Option& Option::needs(const Option& other) { return option_->needs(other.option_), *this; }
Option& Option::excludes(const Option& other) { return option_->excludes(other.option_), *this; }

CommandLine CommandLine::command(const std::string& name, const std::string& help,
                                 const std::vector<std::string>& examples) {
  CLI::App* const command = app_->add_subcommand(name, help);
  std::string footer = examples.empty() ? "" : "Examples:";
  for (const std::string& example : examples) footer += "\n  " + example;
  command->footer(footer);
  return CommandLine(command);
}

Option CommandLine::flag(const std::string& names, bool& value, const std::string& help) {
  return Option(app_->add_flag(names, value, help));
}

template <class Value>
Option CommandLine::option(const std::string& names, const std::string& type, Value& value, const std::string& help) {
  return Option(app_->add_option(names, value, help)->type_name(type));
}
template Option CommandLine::option(const std::string&, const std::string&, std::string&, const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, int&, const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, double&, const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, std::uint64_t&, const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, std::optional<std::uint64_t>&,
                                    const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option CommandLine::option(const std::string&, const std::string&, std::vector<double>&, const std::string&);

Option CommandLine::arguments(const std::string& name, const std::function<void(const std::vector<std::string>&)>& take,
                              const std::string& help) {
  constexpr int most = 1000;
  return Option(
      app_->add_option_function<std::vector<std::string>>(name, take, help)->expected(1, most)->type_name(""));
}

void CommandLine::when_parsed(std::function<void()> action) { app_->parse_complete_callback(std::move(action)); }

std::vector<Option> CommandLine::given() const {
  std::vector<Option> all;
  for (CLI::Option* const option : app_->parse_order()) all.emplace_back(option);
  return all;
}

bool CommandLine::has(const std::string& subcommand) const { return app_->got_subcommand(subcommand); }

namespace {

/// Help as CLI11 prints it, but without "(1x)" after an argument of which one is enough.
class Help : public CLI::Formatter {
  std::string make_option_usage(const CLI::Option* option) const override {
    std::string usage = CLI::Formatter::make_option_usage(option);
    if (const auto at = usage.find("(1x)"); at != std::string::npos) usage.erase(at, 4);
    return usage;
  }
};

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

/// Refuses to write to a file that another word of the command names. A run may write to the file from which it
/// resumes.
void require_other_output(const CLI::App& command) {
  const CLI::Option* const output = command.get_option_no_throw("--output");
  if (!output || output->count() == 0) return;
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options())
    if (option != output && !option->check_lname("resume"))
      words.insert(words.end(), option->results().begin(), option->results().end());
  slipfront::record::require_other_file(output->results().back(), words);
}

/// If a subcommand or an option is unknown, the text names the nearest known one.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::string help = "slipfront";
  for (const CLI::App* command : app.get_subcommands()) help += " " + command->get_name();
  text += nearest(app);
  return text + (text.ends_with('?') ? " See " : "; see ") + help + " --help";
}

}  // namespace

ProgramLine::ProgramLine(const std::string& help) : app_(std::make_unique<CLI::App>(help, "slipfront")) {
  app_->formatter(std::make_shared<Help>());
  app_->require_subcommand(0, 1);
  app_->failure_message(CLI::FailureMessage::simple);
}

ProgramLine::~ProgramLine() = default;

CommandLine ProgramLine::top() const { return CommandLine(app_.get()); }

ProgramLine::Parsed ProgramLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    require_other_output(chosen(*app_));
    return {Parsed::Kind::arguments, {}};
  } catch (const slipfront::InputError& error) {
    return {Parsed::Kind::error, error.what()};
  } catch (const CLI::Success& request) {
    std::ostringstream text;
    app_->exit(request, text, text);
    return {Parsed::Kind::help, text.str()};
  } catch (const CLI::ParseError& error) {
    return {Parsed::Kind::error, usage_error(*app_, error)};
  }
}
