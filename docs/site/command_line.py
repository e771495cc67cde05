"""Writes the reference of the command line from the program: command_line.py PROGRAM > command_line.md."""
import re
import subprocess
import sys


def help_of(program: str, *command: str) -> str:
    return subprocess.run([program, *command, "--help"], check=True, capture_output=True, text=True).stdout.strip()


def main() -> None:
    program = sys.argv[1]
    overview = help_of(program)
    commands = re.findall(r"^  ([a-z]+) ", overview.split("Subcommands:")[1], re.MULTILINE)
    print("# Command line\n")
    print("This page lists every command and option, as `slipfront COMMAND --help` prints them.\n")
    for title, text in [("slipfront", overview), *((f"slipfront {name}", help_of(program, name)) for name in commands)]:
        print(f"## {title}\n\n```\n{text}\n```\n")


if __name__ == "__main__":
    main()
