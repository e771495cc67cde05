"""Runs the command line: `python3 -m slipfront NAME ARGS...`. It hands the subcommands that are
written in C++ to the program.

Each subcommand in Python is a module cmd_NAME.py with a function `main(argv) -> int`, where argv
are the arguments after the name. An error that it raises becomes one line on stderr and an exit
code.
"""

import atexit
import importlib
import os
import pathlib
import signal
import sys

from ._messages import DONE, FILE, INPUT, INTERRUPTED, NUMERICS, Interruption, complain

NAMES = ("sweep", "fronts", "laboratory", "population", "reproduce", "plot", "animate")


def interrupted(_signal, _frame):
    """Handles the first signal that ends the program; a second one ends it at once."""
    Interruption.seen = True
    for number in ENDING:
        signal.signal(number, lambda *_: os._exit(INTERRUPTED))
    signal.signal(signal.SIGALRM, end_now)
    signal.alarm(1)  # gives the running code a second to end
    raise KeyboardInterrupt


def end_now(*_):
    """Ends the program a second after an interruption that the running code has not heeded."""
    undo_unfinished()
    os.write(2, f"slipfront: interrupted{Interruption.advice()}\n".encode("utf-8", "replace"))
    os._exit(INTERRUPTED)


def undo_unfinished():
    from ._files import UNFINISHED

    for undo in list(UNFINISHED):
        undo()


def end(code):
    """Ends the program, and ignores signals, which would kill an ending interpreter."""
    signal.alarm(0)
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
    if code == INTERRUPTED:  # the interpreter would wait for threads that still compute
        atexit._run_exitfuncs()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def heed_signals():
    for number in ENDING:
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup has ignored it
            signal.signal(number, interrupted)


def run(name, argv):
    """Runs a subcommand. Prints an error as one line, and returns the exit code."""
    try:
        return _run(name, argv)
    except BaseException:
        if not Interruption.seen:
            raise
    signal.alarm(0)
    undo_unfinished()
    complain(f"interrupted{Interruption.advice()}")
    return INTERRUPTED


def _run(name, argv):
    try:
        from ._slipfront import NumericsError
    except ImportError as error:
        if Interruption.seen:
            raise
        complain(error)
        return FILE
    try:
        code = importlib.import_module(f".cmd_{name}", __package__).main(argv)
        sys.stdout.flush()
        return code
    except SystemExit as exit:  # --help
        return exit.code or DONE
    except BaseException as error:
        if Interruption.seen:
            raise
        return _code_of(error, name, NumericsError)


def _code_of(error, name, numerics_error):
    try:
        raise error
    except (numerics_error, MemoryError) as error:
        complain(error if str(error) else "out of memory")
        return NUMERICS
    except ValueError as error:
        complain(error)
        return INPUT
    except (OSError, ImportError) as error:
        complain(error)
        return FILE
    except Exception as error:
        if sys.flags.dev_mode:
            raise
        complain(f"{name} failed: {type(error).__name__}: {error}")
        return NUMERICS


def become_program(argv):
    """Becomes the program slipfront. Returns an exit code if the program is missing."""
    package = pathlib.Path(__file__).parent
    # In a wheel, in the build tree, and where CMake or a Debian package installs it.
    for folder in (package, package.parents[1], package.parents[3]):
        program = folder / "bin" / "slipfront"
        if program.is_file():
            os.environ["SLIPFRONT_PYTHON"] = sys.executable
            os.execv(program, ["slipfront", *argv])
    complain("the program slipfront is missing beside its Python package; install the Debian "
             "package slipfront")
    return FILE


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in NAMES:
        return become_program(sys.argv[1:])
    heed_signals()
    code = run(sys.argv[1], sys.argv[2:])
    try:
        sys.stdout.flush()
    # A closed pipe: without devnull, the interpreter would report it again at its end
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        complain(f"stdout: {error.strerror}")
        return FILE
    return code


if __name__ == "__main__":
    end(main())
