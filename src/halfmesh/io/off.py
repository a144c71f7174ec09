"""Reading OFF, the object file format of Geomview, in the forms that are met in the wild.

The header is ``[ST][C][N][4][n]OFF`` (the letters in any order, or no keyword at all) and may share its line with the
counts; comments and blank lines may stand anywhere; lines end with LF, CR LF or CR. A vertex is ``x y z [w] [normal]
[colour] [texture]``, a face ``degree i0 i1 ... [colour]``.

Text is read by lines, cut into parts that are read at once. If there are fewer lines than elements, it is read as a
stream of tokens, in which a vertex may span lines or share one.
"""

from __future__ import annotations

import contextlib
import functools
import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import parallel
from halfmesh.errors import FormatError
from halfmesh.io import off_kernels as k
from halfmesh.io.data import Attributes, MeshData
from halfmesh.io.numbers import powers_of_ten
from halfmesh.io.off_binary import read_binary
from halfmesh.io.off_header import Header, as_color, read_header
from halfmesh.io.rows import lines_in, state_at, to_the_end
from halfmesh.io.source import Source, interpreted_size, skip_gaps

__all__ = ["read_off"]

_MOST_OPEN = 2048


def read_off(source: Source) -> MeshData:
    """Read OFF, text or binary.

    Raises
    ------
    FormatError
        With the line and what was expected there.

    Notes
    -----
    Time and memory are proportional to the size of the file, whatever its header announces.
    """
    header = read_header(source)
    if header.binary:
        return read_binary(source, header)
    header.check_counts(source)
    found = _read_text(source, header)
    data = MeshData(found.corners, found.offsets, header.points(found.values), meta={"comments": header.comments})
    data.vertex = header.attributes(found.values, found.dotted)
    data.face = _face_colors(found)
    return data


def _read_text(source: Source, header: Header) -> _Elements:
    """By lines; if a line is too short, as a stream of tokens. What is wrong then is said of the lines."""
    text = _Text(source, header)
    try:
        return text.read()
    except FormatError as error:
        if not (text.has_short_line or text.as_stream):
            raise
        for most_extras in (k.MOST_EXTRAS, 0):  # faces may share a line if they have no colours
            with contextlib.suppress(FormatError):
                return _Text(source, header, as_stream=True, most_extras=most_extras).read()
        raise error from None


@dataclass
class _Elements:
    values: NDArray[np.float64]
    dotted: int  # bit c: column c of the vertices is not all integers
    corners: NDArray[np.int32]
    offsets: NDArray[np.int32]
    extras: NDArray[np.float64]  # up to four numbers behind each face
    n_extras: NDArray[np.int8]
    extras_dotted: int


class _Piece(NamedTuple):
    """What one thread found: corners, and whether there was a point or exponent in numbers of vertices and faces."""

    corners: NDArray[np.int32]
    dotted: int
    extras_dotted: int


@dataclass
class _Part:
    """Lines begin..end; vertices up to `last_vertex` come first, then faces up to `last_face`."""

    begin: int
    end: int
    vertex: int
    last_vertex: int
    face: int
    last_face: int


class _Text:
    def __init__(
        self, source: Source, header: Header, *, as_stream: bool = False, most_extras: int = k.MOST_EXTRAS
    ) -> None:
        self.source, self.header, self.most_extras = source, header, most_extras
        self.begin = header.body
        self.size = interpreted_size(source.end - self.begin)
        self.as_stream, self.has_short_line = as_stream, False
        self.parts = [self._whole()] if as_stream else self._parts()
        self.width = header.least_width if self.as_stream else header.width(source)
        self.powers = powers_of_ten()
        n_faces = header.n_faces
        self.values = np.empty((header.n_vertices, self.width))
        self.degrees = np.empty(n_faces, dtype=np.int32)
        self.extras, self.n_extras = np.empty(k.MOST_EXTRAS * n_faces), np.zeros(n_faces, dtype=np.int8)
        self.room = np.empty((source.end - self.begin) // 2 + 1, dtype=np.int32)  # a corner takes at least two bytes

    def _parts(self) -> list[_Part]:
        """One part for each thread if every element has its own line, else one part for the whole text."""
        n_vertices, n_faces = self.header.n_vertices, self.header.n_faces
        spans = lines_in(self.source, self.begin)
        if spans[-1].last < n_vertices + n_faces:
            self.as_stream = True
            return [self._whole()]
        parts = []
        for begin, end, *lines in spans:
            vertex, last_vertex = (min(x, n_vertices) for x in lines)
            face, last_face = (min(max(x - n_vertices, 0), n_faces) for x in lines)
            parts.append(_Part(begin, end, vertex, last_vertex, face, last_face))
        return parts

    def _whole(self) -> _Part:
        return _Part(self.begin, self.source.end, 0, self.header.n_vertices, 0, self.header.n_faces)

    def read(self) -> _Elements:
        """All vertices and faces; each part is read on by its thread, across the border between the two."""
        pieces = parallel(self._read_part, [(part,) for part in self.parts])
        self._check_end()
        offsets = np.zeros(self.header.n_faces + 1, dtype=np.int32)
        np.cumsum(self.degrees, out=offsets[1:])
        corners = np.concatenate([piece.corners for piece in pieces])
        dotted = functools.reduce(operator.or_, (piece.dotted for piece in pieces))
        extras_dotted = max(piece.extras_dotted for piece in pieces)
        return _Elements(self.values, dotted, corners, offsets, self.extras, self.n_extras, extras_dotted)

    def _read_part(self, part: _Part) -> _Piece:
        dotted = self._read_vertices(part)
        corners, extras_dotted = self._read_faces(part)
        return _Piece(corners, dotted, extras_dotted)

    def _read_vertices(self, part: _Part) -> int:
        state = state_at(part.begin, part.vertex)
        run = k.read_vertices.at(self.size)
        undecided = np.empty(2 * max(_MOST_OPEN, self.width), dtype=np.int64)
        data, values = self.source.padded, self.values.reshape(-1)

        def step() -> None:
            run(data, part.end, part.last_vertex, self.width, not self.as_stream, self.powers, values, undecided, state)

        self._to_the_end(step, state, undecided, values, "vertex")
        part.begin = int(state[k.POSITION])
        return int(state[k.SEEN])

    def _read_faces(self, part: _Part) -> tuple[NDArray[np.int32], int]:
        state = state_at(part.begin, part.face)
        run = k.read_faces.at(self.size)
        undecided = np.empty(2 * _MOST_OPEN, dtype=np.int64)
        corners = self.room[(part.begin - self.begin) // 2 :]
        form = (self.header.n_vertices, not self.as_stream, self.most_extras, self.powers)
        data = self.source.padded
        outputs = (corners, self.degrees, self.extras, self.n_extras, undecided, state)

        def step() -> None:
            run(data, part.end, part.last_face, *form, *outputs)

        self._to_the_end(step, state, undecided, self.extras, "face")
        part.begin = int(state[k.POSITION])
        return corners[: state[k.CORNER]], int(state[k.SEEN])

    def _check_end(self) -> None:
        """Refuse a file that goes on: its counts are wrong, and what would be left out is not ours to choose."""
        for part in self.parts:
            rest = skip_gaps.at(0 if part.begin == part.end else self.size)(self.source.data, part.begin, part.end)
            if rest < part.end:
                n_vertices, n_faces = self.header.n_vertices, self.header.n_faces
                raise self.source.error(
                    f"the header announces {n_vertices} vertices and {n_faces} faces, which end before this line, "
                    f"but {self.source.shown(rest)} follows; correct the counts, or remove the rest",
                    rest,
                )

    def _to_the_end(
        self, step: Callable[[], None], state: Any, undecided: Any, values: NDArray[np.float64], kind: str
    ) -> None:
        def refuse(code: int, at: int, row: int) -> NoReturn:
            self._raise(code, at, row, kind)

        to_the_end(self.source, step, state, undecided, values, refuse)

    def _raise(self, code: int, at: int, row: int, kind: str) -> NoReturn:
        self.has_short_line |= code == k.LINE_ENDS
        raise self.source.error(self._complaint(code, at, row, kind), at)

    def _complaint(self, code: int, at: int, row: int, kind: str) -> str:
        header = self.header
        announced = header.n_vertices if kind == "vertex" else header.n_faces
        form = f"{self.width} numbers" if kind == "vertex" else "a degree and that many vertex indices"
        found = self.source.shown(at)
        index = found.strip("'")
        if code == k.FILE_ENDS:
            return (
                f"the file ends inside {kind} {row} of {announced}; expected {form} for each; "
                "the file was cut off, or its counts are wrong"
            )
        if code == k.LINE_ENDS:
            return f"the line of {kind} {row} ends too early; expected {form}"
        if code == k.NOT_WHOLE:
            return f"face {row}: expected {form}, as integers, found {found}"
        if code == k.NO_SUCH_VERTEX:
            return (
                f"face {row} refers to vertex {index}, but the {header.n_vertices} vertices are "
                f"numbered from 0 to {header.n_vertices - 1}"
            )
        if code == k.SMALL_FACE:
            return f"face {row} has {index} vertices; expected at least 3 (points and lines are not faces)"
        if kind == "vertex":
            return f"the line of vertex {row} has more than {form}, which the first vertex line has; expected the same"
        return f"face {row}: expected a colour of 1, 3 or 4 numbers or the end of the line, found {found}"


def _face_colors(faces: _Elements) -> Attributes:
    """The colours as they are written: an index into a colour map, or three or four components; NaN where none."""
    if not faces.n_extras.any():
        return {}
    n = int(faces.n_extras.max())
    colors = faces.extras.reshape(-1, k.MOST_EXTRAS)[:, :n].copy()
    colors[np.arange(n) >= faces.n_extras[:, None]] = np.nan
    whole = not faces.extras_dotted and int(faces.n_extras.min()) == n
    if n == 1:
        column = colors[:, 0]
        return {"color_index": column.astype(np.int64) if whole and np.abs(column).max() < 2**53 else column}
    return {"color": as_color(colors, whole)}
