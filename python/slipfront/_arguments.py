"""Command lines of the subcommands that are written in Python."""

import argparse
import os
import pathlib
import sys
import textwrap
import tomllib

from . import _table
from ._slipfront import printable, require_other_file, sensible_threads

COMMANDS = pathlib.Path(__file__).with_name("commands.toml")


class Help(argparse.HelpFormatter):
    """Fills paragraphs. A long example is continued on the next line as a shell reads it."""

    def _fill_text(self, text, width, indent):
        if not text.startswith("Examples:"):
            return super()._fill_text(text, width, indent)
        lines = (textwrap.wrap(line, width, initial_indent="  " * (i > 0), subsequent_indent=" "
                               * 6, break_long_words=False, break_on_hyphens=False)
                 for i, line in enumerate(text.splitlines()))
        return "\n".join(" \\\n".join(parts) for parts in lines)


class Arguments(argparse.ArgumentParser):
    """The parser of a command, by commands.toml. Its errors are one line: ValueError."""

    def __init__(self, name):
        about = tomllib.loads(COMMANDS.read_text(encoding="utf-8"))[name]
        super().__init__(prog=f"slipfront {name}", description=about["description"],
                         epilog="\n".join(["Examples:", *about["examples"]]),
                         formatter_class=Help, allow_abbrev=False)
        self.add_argument("--json", action="store_true",
                          help="one JSON object on stdout, nothing else")
        self.add_argument("--quiet", action="store_true", help="no notes, no progress")
        self.add_argument("--wide", action="store_true",
                          help="all columns side by side (default: what fits the terminal)")
        self.add_argument("--threads", type=threads, default=len(os.sched_getaffinity(0)),
                          metavar="N",
                          help="threads; results do not depend on it (default: all cores)")
        for flags, option in about["option"].items():
            if flags == "--si --dimensionless":
                self.add_units(**option)
                continue
            if "type" in option:
                option["type"] = TYPES[option["type"]]
            self.add_argument(*flags.split(), **option)

    def add_units(self, default="default if the scenario has values with units outside of "
                  "[medium]"):
        units = self.add_mutually_exclusive_group()
        units.add_argument("--si", action="store_true", help=f"results in SI units ({default})")
        units.add_argument("--dimensionless", action="store_true",
                           help="results in the units of the model (default otherwise)")

    def parse_args(self, args=None, namespace=None):
        """Parses the words. Refuses an output that another word but --resume names."""
        options = super().parse_args(args, namespace)
        _table.Lines.whole = options.wide
        if output := getattr(options, "output", None):
            words = [value for name, value in vars(options).items()
                     if name not in ("output", "resume")]
            words += [word for value in words if isinstance(value, list) for word in value]
            files = [os.fsencode(word) for word in words if isinstance(word, str)]
            require_other_file(os.fsencode(output), files)
        return options

    def error(self, message):
        raise ValueError(f"{message}; see {self.prog} --help")


def chosen_units(options):
    """Returns whether results are in SI units: True, False, or None for the default."""
    return options.si if options.si or options.dimensionless else None


def file_name(text):
    if not text:
        raise argparse.ArgumentTypeError("the file name is empty")
    return text


def netcdf_name(text):
    if not file_name(text).endswith(".nc"):
        raise argparse.ArgumentTypeError(f"{text}: unsupported file type; allowed: a name that "
                                         "ends in .nc")
    return text


def put(text):
    """Prints what may hold names of files, as it may be shown, in lines that fit."""
    print("\n".join(_table.fitted(printable(os.fsencode(line))) for line in text.split("\n")))


def threads(text):
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= 4096:
        raise argparse.ArgumentTypeError(f"'{text}' is no number of threads; allowed: 1 to 4096")
    return sensible_threads(int(text))


def whole(text):
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number; "
                                         "allowed: digits only, such as 1000")
    return int(text)


def names(text):
    return text.split(",")


TYPES = {"file_name": file_name, "float": float, "int": int, "names": names,
         "netcdf_name": netcdf_name, "whole": whole}


def progress(options, text):
    """Shows a line on a terminal's stderr that the next one overwrites. "" wipes it."""
    if sys.stderr.isatty() and not options.quiet:
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
