"""Writes files with the code of the program: completely, or not at all."""

import contextlib
import numbers as kinds
import os
import signal
from collections.abc import Callable

from . import _slipfront
from ._optional import import_optional

#: Functions that remove files that are only written in part. A program that must end at once calls
#: them. They may be called twice.
UNFINISHED: set[Callable[[], object]] = set()


def write_bytes(path, content):
    """Writes these bytes to a file. Raises FileError with the path and the reason."""
    _slipfront.write_file(os.fsencode(path), content)


def write_text(path, text):
    """Writes a text to a file, as UTF-8. Raises FileError like write_bytes."""
    write_bytes(path, text.encode("utf-8"))


def _attribute(value):
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode()
    if hasattr(value, "item"):
        value = value.item()
    return int(value) if isinstance(value, kinds.Integral) else float(value)


def _values(array):
    """Returns values as the bindings take them: flat float64, int64 or int8, or a list of texts."""
    if array.dtype.kind in "OUS":
        return [str(text) for text in array.ravel().tolist()]
    kind = "int8" if array.dtype.name == "int8" else {"f": "float64", "i": "int64",
                                                      "u": "int64"}[array.dtype.kind]
    return array.astype(kind).ravel()


def write_dataset(data, path):
    """Writes a Dataset as NetCDF, encoded by the CF conventions. Raises FileError."""
    conventions = import_optional("xarray.conventions")
    variables, attributes = conventions.cf_encoder(*conventions.encode_dataset_coordinates(data))
    sizes = {name: size for variable in variables.values()
             for name, size in zip(variable.dims, variable.shape)}
    _slipfront.write_dataset(os.fsencode(path), list(sizes.items()),
                             [(name, list(variable.dims), _values(variable.values),
                               [(key, _attribute(value)) for key, value in variable.attrs.items()])
                              for name, variable in variables.items()],
                             [(name, _attribute(value)) for name, value in attributes.items()])


def isolated(path, make):
    """Returns the bytes of make(), called in a fork: drawing libraries crash without memory."""
    with told_of(path):
        return _of_fork(path, make)


def _of_fork(path, make):
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        _live_as_fork(reader, writer, make)
    try:
        os.close(writer)
        reply = b"".join(iter(lambda: os.read(reader, 1 << 20), b""))
    except BaseException:  # also at Ctrl-C: nobody would read what the fork still sends
        os.kill(child, signal.SIGKILL)
        raise
    finally:
        status = os.waitpid(child, 0)[1]
        os.close(reader)
    if status or reply[:1] != b"d":
        reason = "" if status else " ".join(reply[1:].decode().split())
        raise _slipfront.FileError(f"{path}: cannot be written: "
                                   f"{reason or 'the drawing library crashed'}")
    return reply[1:]


def _live_as_fork(reader, writer, make):
    """Sends the result of make(), or why it failed. The exit status is 0 if all was sent."""
    unsent = 1
    try:
        os.close(reader)
        try:
            reply = b"d" + make()
        except Exception as error:  # other libraries raise errors of any class
            reply = f"f{error or type(error).__name__}".encode("utf-8", "replace")
        with os.fdopen(writer, "wb") as pipe:
            pipe.write(reply)
        unsent = 0
    finally:
        os._exit(unsent)


@contextlib.contextmanager
def told_of(path):
    """Turns an OSError into a FileError with the name of the file, by default `path`."""
    try:
        yield
    except _slipfront.FileError:
        raise
    except OSError as error:
        raise _slipfront.FileError(
            f"{error.filename or path}: {error.strerror or error}") from error
