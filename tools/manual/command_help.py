"""Reads the help of the program: commands, their options and arguments, and examples.

CLI11 prints the help of commands in C++, argparse that of commands in Python. Both have a column of names and a column of
meanings, under headings that end with a colon.
"""

import os
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

NOT_BUILT = 3  # exit code of a Python command if the package or one of its libraries is missing
CLI11_COLUMN = 30  # width of the column of names
NAME = r"--?[A-Za-z][A-Za-z0-9-]*"
ROW = re.compile(r" {2,10}((?:-\w, *)?\S.*?)(?: {2,}(\S.*))?")
NUMBERS = re.compile(r":(?:INT|UINT|FLOAT) in \[(\S+) - (\S+)\]")
CHOICES = re.compile(r":?\{([^{}]+)\}")


@dataclass(frozen=True)
class Argument:
    """An option, or a positional argument if `names` is empty."""

    names: tuple[str, ...]
    value: str  # stands for the value in the help; empty for an option without one
    choices: tuple[str, ...]
    repeats: bool
    excludes: tuple[str, ...]
    meaning: str


@dataclass(frozen=True)
class Command:
    name: str  # empty for the program itself
    summary: str
    usage: str
    description: str
    arguments: tuple[Argument, ...]
    examples: tuple[str, ...]

    @property
    def title(self) -> str:
        return f"slipfront {self.name}".strip()

    @property
    def options(self) -> list[Argument]:
        return [argument for argument in self.arguments if argument.names]

    @property
    def positionals(self) -> list[Argument]:
        return [argument for argument in self.arguments if not argument.names]


@dataclass(frozen=True)
class Program:
    version: str
    overview: Command
    commands: tuple[Command, ...]


def output_of(program: str, *arguments: str) -> str:
    """Runs the program and returns its output. The width is so large that argparse divides no line."""
    environment = {**os.environ, "COLUMNS": "10000", "LC_ALL": "C.UTF-8", "NO_COLOR": "1", "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True, env=environment).stdout


def row_of(entry: str) -> tuple[str, str]:
    """Names and meaning of an entry. Only one space divides them if the names fill their column."""
    first, _, rest = entry.partition("\n")
    match = ROW.fullmatch(first.rstrip())
    if not match:
        raise ValueError(f"the help has a row that cannot be read: {first}")
    names, meaning = match[1], match[2] or ""
    if not meaning and first[CLI11_COLUMN - 1:CLI11_COLUMN] == " " and (not rest or re.search(" [a-z]+ ", first[CLI11_COLUMN:])):
        names, meaning = first[:CLI11_COLUMN].strip(), first[CLI11_COLUMN:]
    return names, " ".join(f"{meaning} {rest}".split())


def rows_of(section: str) -> list[tuple[str, str]]:
    """Names and meanings of a section. CLI11 2.5 and later indent long options by ten columns."""
    lines = section.strip("\n")
    return [row_of(entry) for entry in re.split(r"\n+(?=  \S| {10}--)", lines)] if lines else []


def argument_of(left: str, meaning: str) -> Argument:
    left, _, excluded = left.partition(" Excludes: ")
    left, _, needed = left.partition(" Needs: ")
    names = tuple(re.findall(rf"(?:^|[\s,])({NAME})", left))
    value = re.split(rf"(?:^|[\s,]){NAME}", left)[-1].strip().removesuffix("REQUIRED").strip()
    repeats = value.endswith("...")
    value = value.removesuffix("...").strip()
    meaning = meaning.rstrip(".")
    if needed:
        meaning += f"; needs {needed}"
    if excluded:
        meaning += f"; excludes {excluded}"
    if limits := NUMBERS.search(value):
        meaning += f"; allowed: {limits[1]} to {limits[2]}"
        value = NUMBERS.sub("", value)
    choices: tuple[str, ...] = ()
    if listed := CHOICES.search(value):
        choices = tuple(listed[1].split(","))
        meaning += f"; allowed: {', '.join(choices)}"
        value = CHOICES.sub("", value) or "NAME"
    return Argument(names, value, choices, repeats, tuple(excluded.split()), meaning)


def sections_of(text: str) -> dict[str, str]:
    """Parts of a help by their headings in lower case. The text before the first heading has the heading ''."""
    parts = re.split(r"^(positional arguments|positionals|options|subcommands|examples):\n", text, flags=re.MULTILINE | re.IGNORECASE)
    return {"": parts[0]} | {heading.lower(): part for heading, part in zip(parts[1::2], parts[2::2])}


def command_of(name: str, summary: str, text: str) -> Command:
    sections = sections_of(re.sub(r"\\\n +", "", text))  # a long example is continued on the next line
    usage = re.search(rf"^(?:[Uu]sage: *)?({f'slipfront {name}'.strip()} .*)", sections[""], re.MULTILINE)
    if not usage:
        raise ValueError(f"slipfront {name} --help prints no usage")
    description = " ".join(sections[""].replace(usage[0], "").split())
    tables = sections.get("positionals", "") + sections.get("positional arguments", "") + sections.get("options", "")
    examples = tuple(line.strip() for line in sections.get("examples", "").splitlines() if line.strip())
    arguments = [argument_of(*row) for row in rows_of(tables)]
    for i, argument in enumerate(arguments):
        if not argument.names and re.search(rf"{argument.value} ?\.\.\.", usage[1]):  # as argparse shows it
            arguments[i] = replace(argument, repeats=True)
    return Command(name, summary, usage[1], description, tuple(arguments), examples)


def read_help(program: str) -> Program:
    """Reads the help of the program and of its commands, except of Python commands that this machine cannot run."""
    text = output_of(program, "--help")
    summaries = dict(rows_of(sections_of(text)["subcommands"]))

    def read(name: str) -> Command | None:
        try:
            return command_of(name, summaries[name], output_of(program, name, "--help"))
        except subprocess.CalledProcessError as error:
            if error.returncode != NOT_BUILT:
                raise
            return None

    with ThreadPoolExecutor() as pool:
        commands = [command for command in pool.map(read, summaries) if command]
    return Program(output_of(program, "--version").strip(), command_of("", "", text), tuple(commands))
