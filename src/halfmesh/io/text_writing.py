"""Rows of numbers and faces as text, many rows at once, on several threads.

A kernel fills a buffer row by row. A row with a number that only Python can write (see `shortest`) is handed over: the
kernel says which row it is, Python writes it, and the kernel goes on with the next.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import in_succession, kernel
from halfmesh.io.numbers import REACH, powers_of_ten
from halfmesh.io.shortest import (
    MOST_BYTES,
    TOP,
    UNWRITTEN,
    few_digits,
    number_to_text,
    put_eight,
    quotient,
    scale_of,
    shortest_digits,
    ten_to,
    write_integer,
    write_number,
)

__all__ = ["Corners", "Table", "face_text", "row_text"]

Bytes = NDArray[np.uint8]

_BLOCK = 20_000  # rows a thread writes before they go to the file
_INDEX_BYTES = 12  # of an index and what is before it
_SLACK = 32  # bytes that are written beyond what counts
EIGHT_DIGITS = 100000000
SMALL = 0.001
_PER_BYTE = 12  # elements of work for `kernel.at`: interpreted writing takes about 4 us a number


class Table:
    """Rows of numbers.

    Attributes
    ----------
    values : ndarray of float64, shape (n, width)
    prefix : bytes
        At the beginning of each row, at most two letters.
    dotted : int
        From this column on, integers are written with ``.0``: they are floats that happen to be whole.
    optional : int
        From this column on, NaN means that nothing is written.
    """

    def __init__(
        self, values: NDArray[np.float64], prefix: bytes = b"", dotted: int | None = None, optional: int | None = None
    ) -> None:
        self.values = np.ascontiguousarray(values, dtype=np.float64)
        self.n_rows, self.width = self.values.shape
        self.prefix = prefix
        self.dotted = self.width if dotted is None else dotted
        self.optional = self.width if optional is None else optional

    def text(self, row: int) -> bytes:
        """One row, written by Python."""
        words = [self.prefix] if self.prefix else []
        for c, value in enumerate(self.values[row].tolist()):
            if c < self.optional or not math.isnan(value):
                words.append(number_to_text(value, dotted=c >= self.dotted).encode())
        return b" ".join(words) + b"\n"


def row_text(table: Table) -> Iterator[memoryview]:
    """The rows, block by block."""
    run: Any = write_rows.at(table.n_rows * table.width * _PER_BYTE)
    values, powers = table.values.reshape(-1), powers_of_ten()
    first, second = (*table.prefix, 0, 0)[:2]
    form = (table.width, first, second, table.dotted, table.optional)

    def block(buffers: list[Bytes], begin: int, end: int) -> tuple[Bytes, int]:
        out = _buffer(buffers, (end - begin) * (table.width * MOST_BYTES + 4))
        return out, _filled(out, begin, end, lambda *place: run(values, *form, *place, powers), table.text)

    yield from _blocks(block, table.n_rows)


class Corners:
    """Faces as they are written.

    Attributes
    ----------
    vertices, textures, normals : ndarray of int32
        Indices of the corners; an empty array for what there is none of, -1 for a corner that has none.
    offsets : ndarray of int32, shape (n_faces + 1,)
    base : int
        Number of the first vertex: 0 in OFF, 1 in OBJ.
    prefix : bytes
        A letter before each face; if there is none, its degree.
    colors : ndarray of float64, shape (n_faces, k)
        Written behind the indices, NaN left out.
    dotted : bool
        Colours that are whole are written with ``.0``.
    """

    def __init__(
        self,
        vertices: NDArray[np.int32],
        offsets: NDArray[np.int32],
        base: int,
        prefix: bytes = b"",
        textures: NDArray[np.int32] | None = None,
        normals: NDArray[np.int32] | None = None,
        colors: NDArray[np.float64] | None = None,
        dotted: bool = False,
    ) -> None:
        self.vertices, self.offsets, self.base, self.prefix, self.dotted = vertices, offsets, base, prefix, dotted
        nothing = np.zeros(0, dtype=np.int32)
        self.textures = nothing if textures is None else textures
        self.normals = nothing if normals is None else normals
        self.colors = np.zeros((0, 0)) if colors is None else np.ascontiguousarray(colors, dtype=np.float64)

    def text(self, face: int) -> bytes:
        """One face, written by Python; only faces with colours can be beyond the kernel."""
        corners = self.vertices[self.offsets[face] : self.offsets[face + 1]]
        words = [str(v + self.base) for v in (len(corners) - self.base, *corners.tolist())]
        words += [number_to_text(x, dotted=self.dotted) for x in self.colors[face].tolist() if not math.isnan(x)]
        return " ".join(words).encode() + b"\n"


def face_text(corners: Corners, begin: int, end: int) -> Iterator[memoryview]:
    """The faces begin..end, block by block."""
    run: Any = write_faces.at(len(corners.vertices) * _PER_BYTE)
    columns = (corners.vertices, corners.offsets, corners.textures, corners.normals)
    n_colors = corners.colors.shape[1]
    colors, powers = corners.colors.reshape(-1), powers_of_ten()
    form = (corners.base, corners.prefix[0] if corners.prefix else 0, n_colors, corners.dotted)
    each = _INDEX_BYTES * (1 + (len(corners.textures) > 0) + (len(corners.normals) > 0))

    def block(buffers: list[Bytes], low: int, high: int) -> tuple[Bytes, int]:
        low, high = begin + low, begin + high
        n_corners = int(corners.offsets[high] - corners.offsets[low])
        out = _buffer(buffers, n_corners * each + (high - low) * (MOST_BYTES * (n_colors + 1)))
        return out, _filled(out, low, high, lambda *place: run(*columns, colors, *form, *place, powers), corners.text)

    yield from _blocks(block, end - begin)


def _blocks(block: Callable[..., tuple[Bytes, int]], n: int) -> Iterator[memoryview]:
    """A few blocks ahead of the file: the text of a large mesh is never in memory as a whole.

    What was written to the file is written over by later blocks: new pages would cost an eighth of the whole.
    """
    buffers: list[Bytes] = []
    jobs = [(buffers, begin, min(begin + _BLOCK, n)) for begin in range(0, n, _BLOCK)]
    for out, size in in_succession(block, jobs):
        yield memoryview(out)[:size]  # type: ignore[arg-type]
        buffers.append(out)


def _buffer(buffers: list[Bytes], size: int) -> Bytes:
    try:
        out = buffers.pop()  # which is safe among threads
    except IndexError:
        out = np.empty(0, dtype=np.uint8)
    return out if len(out) >= size + _SLACK else np.empty(size + _SLACK, dtype=np.uint8)


def _filled(out: Bytes, begin: int, end: int, run: Callable[..., None], by_hand: Callable[[int], bytes]) -> int:
    state = np.array([begin, 0], dtype=np.int64)  # row, byte
    while True:
        run(end, out, state)
        row, at = state.tolist()
        if row == end:
            return at  # type: ignore[no-any-return]
        text = by_hand(row)
        out[at : at + len(text)] = np.frombuffer(text, dtype=np.uint8)
        state[:] = row + 1, at + len(text)


@kernel
def write_rows(
    values: Any,
    width: int,
    first: int,
    second: int,
    dotted: int,
    optional: int,
    last: int,
    out: Any,
    state: Any,
    powers: Any,
) -> None:
    """Write rows until `last`, or until a number that only Python can write."""
    row = state[0]
    at = state[1]
    while row < last:
        begin = at
        spaced = first == 0
        if first:
            out[at] = first
            at += 1
            if second:
                out[at] = second
                at += 1
        for c in range(width):
            x = values[row * width + c]
            if c >= optional and math.isnan(x):
                continue
            if not spaced:
                out[at] = 32
                at += 1
            spaced = False
            size = abs(x)
            floor = int(size) if size < EIGHT_DIGITS else 0
            if size == floor:
                if math.copysign(1.0, x) < 0.0:
                    out[at] = 45
                    at += 1
                n = few_digits(floor)
                put_eight(out, at, floor * ten_to(8 - n))
                at += n
                if c >= dotted:
                    out[at] = 46
                    out[at + 1] = 48
                    at += 2
                continue
            if not (SMALL <= size < EIGHT_DIGITS):
                at = write_number(x, c >= dotted, out, at, powers)
                if at < 0:
                    break
                continue
            mantissa, binary = math.frexp(size)
            e = scale_of(binary)
            e -= size * powers[2 * (REACH + e)] >= TOP
            digits, shift = shortest_digits(size, mantissa, e, powers[2 * (REACH + e)], powers[2 * (REACH + e) + 1])
            if digits < 0:
                at = UNWRITTEN
                break
            n = 17 - e - shift  # of 17 digits that many are left
            n += digits >= ten_to(n)  # rounded up to one more
            e = shift
            if x < 0.0:
                out[at] = 45
                at += 1
            if floor > 0:
                n += e  # digits before the point
                put_eight(out, at, floor * ten_to(8 - n))
                at += n
                out[at] = 46
                at += 1
                digits = (digits - floor * ten_to(-e)) * ten_to(16 + e)
                high = quotient(digits, EIGHT_DIGITS, 1e-8)
                put_eight(out, at, high)
                put_eight(out, at + 8, digits - high * EIGHT_DIGITS)
                at -= e
            else:
                out[at] = 48
                out[at + 1] = 46
                out[at + 2] = 48
                out[at + 3] = 48
                at += 2 - (n + e)
                digits *= ten_to(17 - n)
                high = quotient(digits, 10 * EIGHT_DIGITS, 1e-9)
                digits -= high * 10 * EIGHT_DIGITS
                low = quotient(digits, 10, 0.1)
                put_eight(out, at, high)
                put_eight(out, at + 8, low)
                out[at + 16] = 48 + digits - 10 * low
                at += n
        if at < 0:
            at = begin
            break
        out[at] = 10
        at += 1
        row += 1
    state[0] = row
    state[1] = at


@kernel
def write_faces(
    vertices: Any,
    offsets: Any,
    textures: Any,
    normals: Any,
    colors: Any,
    base: int,
    prefix: int,
    n_colors: int,
    dotted: bool,
    last: int,
    out: Any,
    state: Any,
    powers: Any,
) -> None:
    """Write faces until `last`, or until a colour that only Python can write."""
    face = state[0]
    at = state[1]
    while face < last:
        begin = at
        if prefix:
            out[at] = prefix
            at += 1
        else:
            x = offsets[face + 1] - offsets[face]
            n = few_digits(x)
            if x < EIGHT_DIGITS:
                put_eight(out, at, x * ten_to(8 - n))
                at += n
            else:
                at = write_integer(x, out, at)
        for c in range(offsets[face], offsets[face + 1]):
            out[at] = 32
            at += 1
            x = vertices[c] + base
            n = few_digits(x)
            if x < EIGHT_DIGITS:
                put_eight(out, at, x * ten_to(8 - n))
                at += n
            else:
                at = write_integer(x, out, at)
            textured = len(textures) > 0 and textures[c] >= 0
            if textured:
                out[at] = 47
                at = write_integer(textures[c] + base, out, at + 1)
            if len(normals) > 0 and normals[c] >= 0:
                if not textured:
                    out[at] = 47
                    at += 1
                out[at] = 47
                at = write_integer(normals[c] + base, out, at + 1)
        for j in range(n_colors):
            color = colors[face * n_colors + j]
            if not math.isnan(color):
                out[at] = 32
                at = write_number(color, dotted, out, at + 1, powers)
                if at < 0:
                    break
        if at < 0:
            at = begin
            break
        out[at] = 10
        at += 1
        face += 1
    state[0] = face
    state[1] = at
