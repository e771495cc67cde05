#!/usr/bin/env python3
"""Writes the man pages and the completions for bash and zsh from the help of the program: make.py PROGRAM OUT.

They are OUT/man/slipfront.1, OUT/man/slipfront-COMMAND.1, OUT/bash/slipfront and OUT/zsh/_slipfront. The date of the pages is
that of the release in CITATION.cff, or SOURCE_DATE_EPOCH if the environment has it.
"""

import datetime
import os
import pathlib
import re
import shutil
import sys

sys.dont_write_bytecode = True

from bash_completion import bash_completion
from command_help import read_help
from man_pages import man_pages
from values import read_keys
from zsh_completion import zsh_completion

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def date() -> str:
    if epoch := os.environ.get("SOURCE_DATE_EPOCH"):
        return datetime.datetime.fromtimestamp(int(epoch), datetime.timezone.utc).date().isoformat()
    citation = (SOURCE / "CITATION.cff").read_text(encoding="utf-8")
    return re.findall(r"^date-released: *(\S+)", citation, re.MULTILINE)[0].strip("\"'")


def exit_codes() -> list[tuple[str, str]]:
    """Exit codes and their meanings, from the page on scenarios."""
    table = (SOURCE / "docs/scenario.md").read_text(encoding="utf-8").partition("## Exit codes")[2].partition("\n## ")[0]
    return re.findall(r"^\| (\d+) \| (.+) \|$", table, re.MULTILINE)


def main() -> None:
    binary, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    program, keys = read_help(binary), read_keys(binary)
    texts = {f"man/{name}": text for name, text in man_pages(program, exit_codes(), date()).items()}
    texts |= {"bash/slipfront": bash_completion(program, keys), "zsh/_slipfront": zsh_completion(program, keys)}
    shutil.rmtree(folder, ignore_errors=True)  # it may have the page of a former command
    for name, text in texts.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
