"""Completion for bash, from the help of the program. It works with and without the package bash-completion."""

from command_help import Argument, Command, Program
from values import Keys, endings_of, takes_folder, takes_key, words_for

START = """\
# Completion of slipfront {version} in bash, made from its help.

# Completes names of folders, and of files with one of these endings.
_slipfront_files() {{
  local ending
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$current"
    for ending; do compgen -f -X "!*.$ending" -- "$current"; done
  )
}}

_slipfront_words() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}}

# Completes the name of a key. The user continues with its value, so no blank follows.
_slipfront_keys() {{
  compopt -o nospace 2>/dev/null
  _slipfront_words "{keys}"
  COMPREPLY=("${{COMPREPLY[@]/%/=}}")
}}

_slipfront() {{
  local current="${{COMP_WORDS[COMP_CWORD]}}" previous="${{COMP_WORDS[COMP_CWORD - 1]}}" command="" i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "${{COMP_WORDS[i]}}" in
      {commands})
        command="${{COMP_WORDS[i]}}"
        break
        ;;
    esac
  done
  # Readline makes a separate word of each equals sign, as in --option=value.
  if [[ $current == "=" ]]; then
    current=""
  elif [[ $previous == "=" ]]; then
    previous="${{COMP_WORDS[COMP_CWORD - 2]}}"
  fi
  case "$command $previous" in
"""
END = """\
  esac
}
complete -F _slipfront slipfront
"""


def action(argument: Argument, keys: Keys) -> str:
    """The shell command that completes the value of an argument. It completes nothing if any text is allowed."""
    if takes_key(argument):
        return "_slipfront_keys"
    if words := words_for(argument, keys):
        return f'_slipfront_words "{" ".join(words)}"'
    if takes_folder(argument):
        return "_slipfront_files"
    if endings := endings_of(argument):
        return f"_slipfront_files {' '.join(endings)}"
    return ":"


def branch(pattern: str, command: str) -> str:
    return f"    {pattern}) {command} ;;\n"


def value_branches(command: Command, keys: Keys) -> str:
    """Branches for the word after an option with a value, and after the equals sign of a key."""
    text = ""
    for option in command.options:
        if option.value:
            text += branch(" | ".join(f'"{command.name} {name}"' for name in option.names), action(option, keys))
        if takes_key(option):
            text += "".join(branch(f'"{command.name} {key}"', f'_slipfront_words "{" ".join(words)}"') for key, words in keys.allowed.items() if words)
    return text


def other_branches(command: Command, keys: Keys, commands: str) -> str:
    """The branch for any other word: an option if it begins with a hyphen, otherwise a command or an argument."""
    options = " ".join(name for option in command.options for name in option.names)
    other = action(command.positionals[0], keys) if command.positionals else ":"
    if not command.name:
        other = f'_slipfront_words "{commands}"'
    return branch(f'"{command.name} "*', f'if [[ $current == -* ]]; then _slipfront_words "{options}"; else {other}; fi')


def bash_completion(program: Program, keys: Keys) -> str:
    names = [command.name for command in program.commands]
    text = START.format(version=program.version, commands=" | ".join(names), keys=" ".join(keys.allowed))
    for command in (program.overview, *program.commands):
        text += value_branches(command, keys) + other_branches(command, keys, " ".join(names))
    return text + END
