"""The bytes of a file, and where in it something is wrong."""

from __future__ import annotations

import itertools
import os
import re
import stat

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, n_threads
from halfmesh.errors import FormatError
from halfmesh.io.numbers import number_from_text

__all__ = ["PADDING", "Source", "count_lines", "count_plain_lines", "interpreted_size", "n_parts", "skip_gaps"]

Bytes = NDArray[np.uint8]

PADDING = 12  # line ends behind the text, so that digits can be read without asking at each whether the text is over

_PART = 500_000  # bytes; below that a second thread costs more than it saves
_MOST_SHOWN = 40
_TOKEN = re.compile(rb"[^\s#]*+")
_NO_NUMBER = re.compile(rb"#[IQS][A-Z]")


def interpreted_size(n_bytes: int) -> int:
    """What to tell ``kernel.at``: interpreted parsing takes about 0.25 us a byte, importing Numba 0.4 s."""
    return n_bytes // 64


def n_parts(n_bytes: int) -> int:
    """Into how many parts a text of that size is cut."""
    return max(1, min(n_threads(), n_bytes // _PART))


class Source:
    """A file read into memory, once.

    Parameters
    ----------
    path : str or path-like

    Attributes
    ----------
    path : str
    data, view : ndarray of uint8, memoryview of it
    padded : ndarray of uint8
        The same with `PADDING` line ends behind it.
    begin : int
        0, or 3 behind the mark that some editors put before UTF-8 text.

    Raises
    ------
    OSError
        Whatever the system says.
    FormatError
        If `path` is not a regular file (a pipe, a device) or is encoded as UTF-16.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = os.fspath(path)
        self.padded = _contents(self.path)
        self.data = self.padded[:-PADDING]
        self.view = memoryview(self.data)  # type: ignore[arg-type]
        head = bytes(self.data[:3])
        if head[:2] in {b"\xff\xfe", b"\xfe\xff"}:
            raise self.error("this is UTF-16 text; save the file as UTF-8 or ASCII")
        self.begin = 3 if head == b"\xef\xbb\xbf" else 0

    @property
    def end(self) -> int:
        """Number of bytes."""
        return len(self.data)

    def error(self, message: str, at: int | None = None) -> FormatError:
        """The exception for what is wrong at byte `at`; the line is counted only now."""
        return FormatError(message, path=self.path, line=None if at is None else self.line(at))

    def binary_error(self, message: str, at: int | None = None) -> FormatError:
        """The same for files without lines."""
        return FormatError(message, path=self.path, offset=at)

    def line(self, at: int) -> int:
        """Number of the line that holds byte `at`, from 1; lines end with LF, CR LF or CR."""
        before = self.data[:at]
        feeds = int(np.count_nonzero(before == 10))
        returns = before == 13
        if not returns.any():
            return feeds + 1
        followed = self.data[1 : at + 1] == 10
        return feeds + 1 + int(np.count_nonzero(returns[: len(followed)] & ~followed))

    def token(self, at: int) -> bytes:
        """The token that begins at `at`."""
        token = _TOKEN.match(self.view, at)
        assert token is not None  # it may be empty
        return token.group()

    def number(self, at: int) -> float:
        """What ``float()`` makes of the token that begins at `at`.

        Raises
        ------
        FormatError
            If it is not a number; also for ``1.#IND`` and its kind, which C programs on Windows wrote for NaN.
        """
        token = self.token(at)
        value = number_from_text(token)
        behind = bytes(self.data[at + len(token) : at + len(token) + 3])
        if value is None or _NO_NUMBER.match(behind):
            raise self.error(f"expected a number, found {self.shown(at)}", at)
        return value

    def shown(self, at: int) -> str:
        """The token that begins at `at`, fit for a message."""
        token = self.token(at) if at < self.end else b""
        if not token:
            return "the end of the line" if at < self.end else "the end of the file"
        text = token[:_MOST_SHOWN].decode("ascii", "backslashreplace")
        return repr(text) + ("..." if len(token) > _MOST_SHOWN else "")

    def parts(self, begin: int) -> list[tuple[int, int]]:
        """The bytes from `begin` on in a few parts that end with a line."""
        n = n_parts(self.end - begin)
        wanted = (begin + (self.end - begin) * k // n for k in range(1, n))
        cuts = [begin, *(self._next_line(at) for at in wanted), self.end]
        return [(low, high) for low, high in itertools.pairwise(cuts) if low < high] or [(begin, begin)]

    def _next_line(self, at: int) -> int:
        size = 4096
        while at < self.end:
            window = self.data[at : at + size]
            ends = np.flatnonzero((window == 10) | (window == 13))
            if len(ends):
                return at + int(ends[0]) + 1
            at += size
            size *= 8
        return self.end


def _contents(path: str) -> Bytes:
    if not (stat.S_ISREG(mode := os.stat(path).st_mode) or stat.S_ISDIR(mode)):
        raise FormatError("this is not a regular file (a pipe or a device?); copy its contents to a file", path=path)
    with open(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        data = np.empty(size + PADDING, dtype=np.uint8)
        n = 0
        while n < size and (more := file.readinto(memoryview(data)[n:size])):  # type: ignore[arg-type]
            n += more
    data[n : n + PADDING] = 10
    return data[: n + PADDING]


@kernel
def skip_gaps(b: Bytes, i: int, end: int) -> int:
    """The next token at or after `i`, over blanks, line ends and comments."""
    while i < end:
        c = b[i]
        if c == 35:
            while i < end and b[i] != 10 and b[i] != 13:
                i += 1
        elif c == 32 or 9 <= c <= 13:
            i += 1
        else:
            break
    return i


@kernel
def count_plain_lines(b: Bytes) -> int:
    """The same as `count_lines` by a loop that becomes vector instructions; -1 if a line begins with a blank."""
    n = 0
    blank = 0
    if len(b) > 0:
        n += b[0] > 32 and b[0] != 35
        blank += b[0] <= 32 and b[0] != 10 and b[0] != 13
    for i in range(1, len(b)):
        first = (b[i - 1] == 10) | (b[i - 1] == 13)
        n += first & (b[i] > 32) & (b[i] != 35)
        blank += first & (b[i] <= 32) & (b[i] != 10) & (b[i] != 13)
    return -1 if blank else n


@kernel
def count_lines(b: Bytes, i: int, end: int) -> int:
    """How many lines hold more than blanks and a comment."""
    n = 0
    while i < end:
        c = b[i]
        if c == 32 or 9 <= c <= 13:
            i += 1
            continue
        if c != 35:
            n += 1
        while i < end and b[i] != 10 and b[i] != 13:
            i += 1
    return n
