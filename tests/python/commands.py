"""Runs the commands that are written in Python within the process of the test, which saves each of them the start of an interpreter."""

import contextlib
import io
import subprocess
import warnings

from slipfront import __main__
from support import CommandLine, run


def run_here(*arguments, stdin=""):
    """Like `support.run`. Commands that are not written in Python run in the program."""
    if stdin or arguments[0] not in __main__.NAMES:
        return run(*arguments, stdin=stdin)
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors), warnings.catch_warnings():
        code = __main__.run(arguments[0], list(arguments[1:]))
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), errors.getvalue())


class PythonCommands(CommandLine):
    """Like CommandLine. At least one test of each command must still run the program, which starts the interpreter."""

    run_command = staticmethod(run_here)
