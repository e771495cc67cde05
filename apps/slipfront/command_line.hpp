#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// \file
/// What the command line of the program can contain. Only command_line.cpp includes the parser, CLI11, which takes ten
/// seconds to compile.

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// An option or a flag of a command. Each function restricts what is allowed.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  /// The option takes one value, and may be given several times.
  Option& repeatable();
  Option& in_range(int least, int most);
  Option& in_range(double least, double most);
  Option& one_of(std::vector<std::string> values);
  /// `error` returns what is wrong with a value, or an empty text.
  Option& checked_by(std::function<std::string(const std::string&)> error);
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

  bool operator==(const Option&) const = default;

 private:
  CLI::Option* option_;
};

/// A command such as `slipfront pulse`, or the program itself. What a parsed value is stored in must outlive it.
class CommandLine {
 public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  /// Adds a subcommand. `examples` has one command in a line.
  CommandLine command(const std::string& name, const std::string& help, const std::vector<std::string>& examples = {});

  Option flag(const std::string& names, bool& value, const std::string& help);
  /// Adds an option `names`, such as "-o,--output", or an argument with a name without dashes. The help shows the value
  /// as `type`, such as "OUT.nc". `Value` is one of std::string, int, double, unsigned long long, std::optional of int
  /// or double, and std::vector of std::string or double.
  template <class Value>
  Option option(const std::string& names, const std::string& type, Value& value, const std::string& help);
  /// Adds one or more arguments, which are given to `take` together.
  Option arguments(const std::string& name, const std::function<void(const std::vector<std::string>&)>& take,
                   const std::string& help);
  /// Calls `action` when the whole command line was read.
  void when_parsed(std::function<void()> action);

  /// The options that were given, in their order; one that was given twice occurs twice.
  std::vector<Option> given() const;
  bool has(const std::string& subcommand) const;

 private:
  CLI::App* app_;
};

/// The command line of the program, which owns all its commands.
class ProgramLine {
 public:
  explicit ProgramLine(const std::string& help);
  ~ProgramLine();

  CommandLine top() const;
  /// The command line gave arguments, or asked for help, which is `text`, or has an error. Then `text` is one line that
  /// ends with the command that prints the help.
  struct Parsed {
    enum class Kind { arguments, help, error } kind;
    std::string text;
  };
  Parsed parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
};
