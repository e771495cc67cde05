"""Stores the results of a sweep on disk while it runs.

Each line is appended in one piece and has a checksum. A sweep that is killed therefore loses at
most its last line.
"""

import contextlib
import fcntl
import json
import os
import zlib

from ._slipfront import FileError, InputError


def _line(content):
    text = json.dumps(content)
    return f"{zlib.crc32(text.encode()):08x} {text}\n".encode()


def _content(line):
    """Returns the content of a line, or None if the line is truncated or damaged."""
    if not line.endswith(b"\n") or line[8:9] != b" ":
        return None
    text = line[9:-1]
    return json.loads(text) if line[:8] == f"{zlib.crc32(text):08x}".encode() else None


class Store:
    """The file `path` with the finished rows of a sweep. Its first line is `about`, the description
    of the sweep as JSON.

    Raises FileError if the file cannot be read or written. Raises InputError if it holds another
    sweep, or if it holds an unfinished sweep and `resume` is false.
    """

    def __init__(self, path, about, resume):
        self.path, self.rows, self.rows_written = path, [], False
        try:
            self._file = os.open(path, os.O_RDWR | os.O_APPEND
                                 | (0 if resume else os.O_CREAT | os.O_EXCL), 0o666)
        except FileExistsError:
            raise InputError(f"{path}: contains an unfinished sweep; allowed: resume it, or remove "
                             "the file") from None
        except OSError as error:
            raise FileError(f"{path}: {error.strerror}") from error
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if resume:
                self._read(about)
            else:
                self.append(about)
        except OSError as error:
            self._close()
            if isinstance(error, FileError):
                raise
            reason = ("another process is writing it" if isinstance(error, BlockingIOError)
                      else error.strerror)
            raise FileError(f"{path}: {reason}") from error
        except InputError:
            self._close()
            raise

    def _close(self):
        with contextlib.suppress(OSError):
            # A process that was forked in the meantime also has the descriptor
            fcntl.flock(self._file, fcntl.LOCK_UN)
        os.close(self._file)

    def _read(self, about):
        whole = 0
        with os.fdopen(os.dup(self._file), "rb") as file:
            for line in file:
                content = _content(line)
                if content is None:
                    break
                if whole == 0 and content != about:
                    raise InputError(f"{self.path}: was written by another sweep; allowed: the "
                                     "scenario, axes, variables and version of that sweep")
                if whole > 0:
                    self.rows += content
                whole += len(line)
        os.ftruncate(self._file, whole)
        self.rows_written = bool(self.rows)
        if whole == 0:
            self.append(about)

    def append(self, content):
        """Appends a line. If that fails, for example on a full disk, the file is as before."""
        line, end = _line(content), os.lseek(self._file, 0, os.SEEK_END)
        try:
            if os.write(self._file, line) == len(line):
                self.rows_written = self.rows_written or isinstance(content, list)
                return
            reason = "cannot be written completely"
        except OSError as error:
            reason = error.strerror
        os.ftruncate(self._file, end)
        raise FileError(f"{self.path}: {reason}")

    def close(self, remove=False):
        """Closes the file, and removes it if `remove`, ignoring errors."""
        try:
            if remove:
                os.unlink(self.path)
            self._close()
        except OSError as error:
            if not remove:
                raise FileError(f"{self.path}: {error.strerror}") from error
