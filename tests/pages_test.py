#!/usr/bin/env python3
"""Runs the code blocks of documentation pages: pages_test.py BUILD SOURCE PAGE...

The blocks of a page run from top to bottom in one new folder, which contains a copy of cases/ and a script `run` in
place of the one at the root of the repository. `slipfront` is on the path, and build/release leads to BUILD.

    ```sh       runs in bash, which stops at the first command that fails
    ```python   runs in one Python process for the whole page
    ```text     after one of these is its output; `...` stands for any text, and numbers may differ by 1e-6 of themselves
    Write `NAME`:   above any other block writes its text into that file

A comment `<!-- not run: REASON -->` on the line above excludes a block. A picture that a page writes must not be empty.
Prints PAGE:LINE for everything that fails.
"""

import dataclasses
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PATIENCE = 1200  # seconds; no block takes so long
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
FENCE = re.compile(r"^( *)(```+)\s*(\w*)")
FILE_ABOVE = re.compile(r"(?:Write|write|Save|save)\b.*`([\w./-]+)`")
NOT_RUN = re.compile(r"<!-- not run: \S.*-->")
PICTURES = (".png", ".svg", ".gif", ".webp")
SMALLEST_PICTURE = 5000  # bytes; an empty figure has fewer
COMMANDS_IN_INDENTED_TEXT = re.compile(r"^ {4,}(?:slipfront|\./run|\./test|python3|cmake|mpirun|git|docs/|tests/|build/)\b")

#: Runs the Python blocks that it reads, one line of JSON each, and answers with their output.
DRIVER = """
import ast, contextlib, io, json, sys, traceback
names = {"__name__": "__main__"}
answers = sys.stdout
for request in sys.stdin:
    block, out, error = json.loads(request), io.StringIO(), ""
    try:
        tree = ast.increment_lineno(ast.parse(block["code"]), block["line"])
        with contextlib.redirect_stdout(out):
            exec(compile(tree, block["page"], "exec"), names)
    except BaseException:
        error = traceback.format_exc()
    print(json.dumps({"out": out.getvalue(), "error": error}), file=answers, flush=True)
"""


@dataclasses.dataclass
class Block:
    language: str
    line: int  # the line of the opening fence
    text: str
    file: str  # the name that the text above gives to it
    excluded: bool


def blocks_of(text: str) -> list[Block]:
    found: list[Block] = []
    lines = text.splitlines()
    i = 0
    while i < len(lines):
        fence = FENCE.match(lines[i])
        if not fence:
            i += 1
            continue
        indent, ticks, language = fence.groups()
        end = next((j for j in range(i + 1, len(lines)) if lines[j].strip() == ticks), len(lines))
        above = next((lines[j] for j in range(i - 1, -1, -1) if lines[j].strip()), "")
        two_above = " ".join(lines[max(0, i - 3):i])
        file = FILE_ABOVE.search(two_above) if above.rstrip().endswith(":") else None
        inside = [line[len(indent):] if line.startswith(indent) else line for line in lines[i + 1:end]]
        found.append(Block(language, i + 1, "\n".join(inside) + "\n", file[1] if file else "", bool(NOT_RUN.search(above))))
        i = end + 1
    return found


def same_line(shown: str, printed: str) -> bool:
    """Whether a printed line is the shown one, but for `...` and the last digits of numbers."""
    pattern, at = "", 0
    numbers = []
    for found in re.finditer(rf"\.\.\.|{NUMBER.pattern}|\s+", shown):
        pattern += re.escape(shown[at:found.start()])
        at = found.end()
        if found[0] == "...":
            pattern += ".*"
        elif found[0].isspace():
            pattern += r"\s+"
        else:
            pattern += f"({NUMBER.pattern})"
            numbers.append(float(found[0]))
    whole = re.fullmatch(pattern + re.escape(shown[at:]), printed)
    if not whole:
        return False
    return all(math.isclose(float(value), number, rel_tol=1e-6) for value, number in zip(whole.groups(), numbers))


def first_difference(shown: str, printed: str) -> int | None:
    """Number of the first shown line that the output does not have, from 1; None if all agree. `...` on a line of its own
    stands for any lines."""
    rest = [line.rstrip() for line in printed.splitlines()]
    rest = [line for line in rest if line]
    skip = False
    for number, line in enumerate(shown.splitlines(), 1):
        if not line.strip():
            continue
        if line.strip() == "...":
            skip = True
            continue
        candidates = range(len(rest)) if skip else range(1)
        at = next((i for i in candidates if i < len(rest) and same_line(line.rstrip(), rest[i])), None)
        if at is None:
            return number
        rest, skip = rest[at + 1:], False
    return None if skip or not rest else len(shown.splitlines())


class Page:
    def __init__(self, path: pathlib.Path, build: pathlib.Path, source: pathlib.Path):
        self.path, self.source = path, source
        self.name = str(path.relative_to(source))
        self.failures: list[str] = []
        self.output = ""
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="slipfront-page-"))
        program = build / "bin/slipfront"
        self.environment = os.environ | {"HOME": str(self.folder), "PYTHONPATH": str(build / "python"), "MPLBACKEND": "Agg",
                                         "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "COLUMNS": "120"}
        shutil.copytree(source / "cases", self.folder / "cases")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/slipfront").symlink_to(program)
        (self.folder / "bin/python3").symlink_to("/usr/bin/python3")
        run = self.folder / "run"
        run.write_text(f'#!/bin/sh\nexec "{program}" "$@"\n', encoding="utf-8")
        run.chmod(0o755)
        (self.folder / "docs").mkdir()
        (self.folder / "build").mkdir()
        (self.folder / "build/release").symlink_to(build)
        self.python: subprocess.Popen[str] | None = None

    def fail(self, line: int, text: str) -> None:
        self.failures.append(f"{self.name}:{line}: {text.strip()}")

    def run_shell(self, block: Block) -> None:
        script = "trap 'echo \"line $LINENO\" >&2' ERR\nset -euo pipefail\n" + block.text
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE)
        self.output = done.stdout
        if done.returncode != 0:
            at = re.search(r"line (\d+)\n?$", done.stdout)
            self.fail(block.line + (int(at[1]) - 2 if at else 0), f"exit code {done.returncode}: {done.stdout[-1500:]}")

    def run_python(self, block: Block) -> None:
        if self.python is None:
            self.python = subprocess.Popen(["/usr/bin/python3", "-c", DRIVER], cwd=self.folder, env=self.environment,
                                           stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self.python.stdin and self.python.stdout
        print(json.dumps({"code": block.text, "line": block.line, "page": str(self.path)}), file=self.python.stdin, flush=True)
        answer = json.loads(self.python.stdout.readline())
        self.output = answer["out"]
        if answer["error"]:
            self.fail(block.line, answer["error"][-1500:])

    def check(self) -> int:
        """Runs all blocks. Returns how many ran."""
        text = self.path.read_text(encoding="utf-8")
        ran = 0
        for number, line in enumerate(text.splitlines(), 1):
            if COMMANDS_IN_INDENTED_TEXT.match(line) and not self.in_block(text, number):
                self.fail(number, "a command in indented text is not tested: make it a ```sh block")
        code_before = False
        for block in blocks_of(text):
            if block.excluded:
                code_before = False
            elif block.language in ("sh", "python"):
                self.run_shell(block) if block.language == "sh" else self.run_python(block)
                ran += 1
                code_before = True
            elif block.language == "text":
                different = first_difference(block.text, self.output) if code_before else None
                if different is not None:
                    self.fail(block.line + different, f"the output differs; it is\n{self.output[:3000]}")
                code_before = False
            elif block.file:
                (self.folder / block.file).parent.mkdir(parents=True, exist_ok=True)
                (self.folder / block.file).write_text(block.text, encoding="utf-8")
                code_before = False
            elif block.language == "":
                self.fail(block.line, "a block without a language: sh, python, text, toml, csv, cpp, cmake, ...")
        for picture in self.folder.rglob("*"):
            if picture.suffix in PICTURES and picture.stat().st_size < SMALLEST_PICTURE:
                self.fail(1, f"the picture {picture.relative_to(self.folder)} has {picture.stat().st_size} bytes only")
        return ran

    @staticmethod
    def in_block(text: str, number: int) -> bool:
        return any(block.line < number <= block.line + block.text.count("\n") for block in blocks_of(text))

    def close(self) -> None:
        if self.python is not None:
            assert self.python.stdin
            self.python.stdin.close()
            self.python.wait()
        shutil.rmtree(self.folder)


def main() -> int:
    build, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    failures = []
    for argument in sys.argv[3:]:
        page = Page(source / argument, build, source)
        try:
            print(f"{argument}: {page.check()} blocks ran")
        finally:
            page.close()
        failures += page.failures
    print("\n".join(failures))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
