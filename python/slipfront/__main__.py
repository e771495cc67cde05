"""`python3 -m slipfront NAME ARGS...`: the subcommands of the command line that are written in Python. Each is a module
cmd_NAME.py with `main(argv) -> int`, argv without the name; what it raises becomes one line and an exit code."""

import atexit
import contextlib
import importlib
import os
import signal
import sys

DONE, INPUT, FILE, NUMERICS, INTERRUPTED = 0, 2, 3, 4, 130
NAMES = ("reproduce", "plot", "animate")


def complain(error):
    text = " ".join(str(error).split()) or type(error).__name__
    with contextlib.suppress(ImportError):  # then the complaint is that
        from ._slipfront import printable

        text = printable(text.encode("utf-8", "surrogateescape"))
    with contextlib.suppress(OSError):
        print(f"slipfront: {text}", file=sys.stderr)


class Interruption:
    """Whether the user has asked the program to end. Libraries may turn the KeyboardInterrupt into another error."""

    seen = False


def interrupted(_signal, _frame):
    """Answers Ctrl-C and other requests to end: the work is left where it can be; a second request ends the program at once."""
    Interruption.seen = True
    for number in ENDING:
        signal.signal(number, lambda *_: os._exit(INTERRUPTED))
    signal.signal(signal.SIGALRM, end_now)
    signal.alarm(1)  # for what is running to come to its end
    raise KeyboardInterrupt


def end_now(*_):
    """Ends a second after an interruption: something waits, or the exception was lost in a place that cannot raise it."""
    undo_unfinished()
    os.write(2, b"slipfront: interrupted\n")
    os._exit(INTERRUPTED)


def undo_unfinished():
    """Removes what has been written in part."""
    from ._files import UNFINISHED

    for undo in list(UNFINISHED):
        undo()


def end(code):
    """Ends the program. From here on a signal changes nothing: while the interpreter ends, Python would let it kill the process."""
    signal.alarm(0)
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
    if code == INTERRUPTED:  # threads may still compute, and the interpreter would wait for them
        atexit._run_exitfuncs()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


ENDING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def heed_signals():
    for number in ENDING:
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, interrupted)


def run(name, argv):
    """Runs a subcommand. Returns its exit code; prints an error as one line."""
    try:
        return _run(name, argv)
    except BaseException:
        if not Interruption.seen:
            raise
    signal.alarm(0)
    undo_unfinished()
    complain("interrupted")
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
    """Prints an error as one line. Returns its exit code."""
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


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in NAMES:
        complain(f"python3 -m slipfront: which subcommand? allowed: {', '.join(NAMES)}")
        return INPUT
    heed_signals()
    code = run(sys.argv[1], sys.argv[2:])
    try:
        sys.stdout.flush()
    except OSError as error:  # a closed pipe; the interpreter would complain again at its end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        complain(f"stdout: {error.strerror}")
        return FILE
    return code


if __name__ == "__main__":
    end(main())
