"""`python3 -m slipfront NAME ARGS...`: the subcommands of the command line that are written in Python. Each is a module
cmd_NAME.py with `main(argv) -> int`, argv without the name; what it raises becomes one line and an exit code."""

import importlib
import os
import sys

DONE, INPUT, FILE, NUMERICS, INTERRUPTED = 0, 2, 3, 4, 130
NAMES = ("reproduce", "plot", "animate")


def complain(error):
    print(f"slipfront: {' '.join(str(error).split()) or type(error).__name__}", file=sys.stderr)


def run(name, argv):
    """Runs a subcommand. Returns its exit code; errors are said in one line."""
    try:
        from ._slipfront import NumericsError
    except ImportError as error:
        complain(error)
        return FILE
    try:
        code = importlib.import_module(f".cmd_{name}", __package__).main(argv)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        complain("interrupted")
        return INTERRUPTED
    except (NumericsError, MemoryError) as error:
        complain(error if str(error) else "out of memory")
        return NUMERICS
    except ValueError as error:
        complain(error)
        return INPUT
    except (OSError, ImportError) as error:
        complain(error)
        return FILE


def main():
    if len(sys.argv) < 2 or sys.argv[1] not in NAMES:
        complain(f"python3 -m slipfront: which subcommand? allowed: {', '.join(NAMES)}")
        return INPUT
    code = run(sys.argv[1], sys.argv[2:])
    try:
        sys.stdout.flush()
    except OSError as error:  # a closed pipe; the interpreter would complain again at its end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        complain(f"stdout: {error.strerror}")
        return FILE
    return code


if __name__ == "__main__":
    sys.exit(main())
