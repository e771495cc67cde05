"""Completion for zsh, from the help of the program: a file _slipfront for a folder of $fpath."""

from command_help import Argument, Command, Program
from values import Keys, endings_of, takes_folder, takes_key, words_for

START = """\
#compdef slipfront
# Completion of slipfront {version} in zsh, made from its help.

# Completes table.key=value for the option --set.
_slipfront_keys() {{
  local -A allowed=(
{keys}  )
  if compset -P 1 '*='; then
    compadd -- ${{=allowed[${{${{IPREFIX%=}}##*=}}]}}
  else
    compadd -S = -- ${{(k)allowed}}
  fi
}}
"""
END = """\

_slipfront() {{
  local curcontext="$curcontext" state state_descr line
  local -A opt_args
  local -a commands=(
{commands}  )
  _arguments -C \\
{options}    '1:command:->command' \\
    '*::argument:->argument'
  case $state in
    command) _describe command commands ;;
    argument) (( $+functions[_slipfront_command_$words[1]] )) && _slipfront_command_$words[1] ;;
  esac
}}

_slipfront "$@"
"""


def quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"


def escaped(text: str) -> str:
    """The text for a specification of _arguments or _describe."""
    for character in "\\:[]":
        text = text.replace(character, "\\" + character)
    return text


def action(argument: Argument, keys: Keys) -> str:
    if takes_key(argument):
        return "_slipfront_keys"
    if words := words_for(argument, keys):
        return f"({' '.join(words)})"
    if takes_folder(argument):
        return "_files -/"
    if endings := endings_of(argument):
        return f'_files -g "*.({"|".join(endings)})(-.)"'
    return " "


def option_specifications(option: Argument, keys: Keys) -> list[str]:
    """One specification for each name of an option."""
    excluded = "*" if option.repeats else f"({' '.join((*option.names, *option.excludes))})"
    value = f":{escaped(option.value)}:{action(option, keys)}" if option.value else ""
    return [f"{excluded}{name}{'=' if value and name.startswith('--') else ''}[{escaped(option.meaning)}]{value}" for name in option.names]


def positional_specification(argument: Argument, keys: Keys) -> str:
    return f"{'*' if argument.repeats else '1'}:{escaped(argument.value)}:{action(argument, keys)}"


def lines(specifications: list[str], end: str) -> str:
    return "".join(f"    {quoted(specification)}{end}\n" for specification in specifications)


def options_of(command: Command, keys: Keys) -> list[str]:
    return [specification for option in command.options for specification in option_specifications(option, keys)]


def function(command: Command, keys: Keys) -> str:
    specifications = options_of(command, keys) + [positional_specification(argument, keys) for argument in command.positionals]
    return f"\n_slipfront_command_{command.name}() {{\n  _arguments \\\n" + lines(specifications, " \\").removesuffix(" \\\n") + "\n}\n"


def zsh_completion(program: Program, keys: Keys) -> str:
    text = START.format(version=program.version,
                        keys="".join(f"    {name} {quoted(' '.join(words))}\n" for name, words in keys.allowed.items()))
    text += "".join(function(command, keys) for command in program.commands)
    commands = lines([f"{command.name}:{escaped(command.summary)}" for command in program.commands], "")
    return text + END.format(commands=commands, options=lines(options_of(program.overview, keys), " \\"))
