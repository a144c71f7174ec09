"""Reading binary OFF, of which there are two dialects.

Geomview writes big-endian 32-bit words and puts the number of colour components behind the indices of each face; PMP
and OpenMesh write little-endian words and no such number. The file doesn't say which: the one that fits the
length of the file to the byte is taken.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.io.data import Attributes, MeshData
from halfmesh.io.off_header import Header
from halfmesh.io.source import Source

__all__ = ["read_binary"]

FITS, FILE_ENDS, BAD_DEGREE, NO_SUCH_VERTEX, BAD_COLOR = 0, 1, 2, 3, 4
_SMALL_TAIL = 2  # a line end that an editor or a careful writer put behind the last word
_COMPLAINTS = {
    FILE_ENDS: "the file ends inside the faces",
    BAD_DEGREE: "a face has fewer than 3 vertices, or more than the file can hold",
    NO_SUCH_VERTEX: "a face refers to a vertex that is not there",
    BAD_COLOR: "a face has a colour of neither 0, 1, 3 nor 4 components",
}


class _Dialect(NamedTuple):
    name: str
    order: str
    colors: bool


_DIALECTS = (
    _Dialect("Geomview's (big-endian, with colour counts)", ">", True),
    _Dialect("PMP's and OpenMesh's (little-endian, without)", "<", False),
    _Dialect("big-endian, without colour counts", ">", False),
    _Dialect("little-endian, with colour counts", "<", True),
)


def read_binary(source: Source, header: Header) -> MeshData:
    """Read the part behind the line ``OFF BINARY``.

    Raises
    ------
    FormatError
        If no dialect fits; with the byte where the likeliest one fails.
    """
    if header.n_coordinates == 0:
        raise source.binary_error("binary nOFF is not known; convert the file to text", header.body)
    failures = []
    for dialect in _DIALECTS:
        attempt = _Attempt(source, header, dialect)
        if attempt.fits():
            return attempt.data()
        failures.append((attempt.reached, attempt.complaint, dialect.name))
    at, complaint, name = max(failures, key=lambda failure: failure[0])
    raise source.binary_error(f"binary OFF of no known dialect; read as {name}: {complaint}", at)


class _Attempt:
    def __init__(self, source: Source, header: Header, dialect: _Dialect) -> None:
        self.header, self.dialect = header, dialect
        self.begin, self.reached = header.body, header.body
        self.left = source.end - self.begin
        n_words = self.left // 4
        raw = source.data[self.begin : self.begin + 4 * n_words]
        self.words = raw.view(np.dtype(dialect.order + "i4"))
        self.tail = bytes(source.data[self.begin + 4 * n_words :])
        self.complaint = "the counts of the header can't be right for a file of this size"

    def fits(self) -> bool:
        """Whether counts, vertices and faces take up the file to its last word."""
        header, n_words = self.header, len(self.words)
        if n_words < 3:
            self.complaint = "the file ends inside the three counts"
            return False
        header.n_vertices, header.n_faces, _ = (int(x) for x in self.words[:3])
        least = 3 + header.n_vertices * header.least_width + header.n_faces * (4 + self.dialect.colors)
        if min(header.n_vertices, header.n_faces) < 0 or least > n_words:
            return False
        return self._walk(3 + header.n_vertices * header.least_width)

    def _walk(self, at: int) -> bool:
        words = self.words[at:].astype(np.int32)  # aligned, and of the machine's own byte order
        header, n = self.header, len(words)
        self.corners = np.empty(n, dtype=np.int32)
        self.degrees = np.empty(header.n_faces, dtype=np.int32)
        self.color_at = np.zeros(header.n_faces, dtype=np.int32)
        self.n_colors = np.zeros(header.n_faces, dtype=np.int32)
        state = np.zeros(2, dtype=np.int64)
        columns = (self.corners, self.degrees, self.color_at, self.n_colors)
        code = _walk_faces.at(n)(words, header.n_vertices, self.dialect.colors, *columns, state)
        self.floats = words.view(np.float32)
        self.reached = self.begin + 4 * (at + int(state[0]))
        self.n_corners = int(state[1])
        left_over = n - int(state[0])
        if code == FITS and (left_over or len(self.tail) > _SMALL_TAIL or self.tail.strip()):
            self.complaint = "the file goes on behind the last face"
            return False
        self.complaint = _COMPLAINTS.get(code, "")
        return bool(code == FITS)

    def data(self) -> MeshData:
        header = self.header
        width = header.least_width
        n = header.n_vertices * width
        floats = self.words[3 : 3 + n].view(np.dtype(self.dialect.order + "f4"))
        values = floats.astype(np.float64).reshape(-1, width)
        offsets = np.zeros(header.n_faces + 1, dtype=np.int32)
        np.cumsum(self.degrees, out=offsets[1:])
        data = MeshData(self.corners[: self.n_corners].copy(), offsets, header.points(values))
        data.vertex = header.attributes(values, -1)  # every column is a float
        data.face = self._face_colors()
        return data

    def _face_colors(self) -> Attributes:
        n = int(self.n_colors.max(initial=0))
        if n == 0:
            return {}
        places: NDArray[Any] = self.color_at[:, None] + np.arange(n)
        given = np.arange(n) < self.n_colors[:, None]
        colors = np.where(given, self.floats[np.where(given, places, 0)], np.nan).astype(np.float64)
        return {"color": colors} if n > 1 else {"color_index": colors[:, 0]}


@kernel
def _walk_faces(
    words: Any,
    n_vertices: int,
    has_colors: bool,
    corners: Any,
    degrees: Any,
    color_at: Any,
    n_colors: Any,
    state: Any,
) -> int:
    """Go from face to face; `state` gets the words passed and the corners written."""
    at = 0
    corner = 0
    n = len(words)
    code = FITS
    for f in range(len(degrees)):
        if at >= n:
            code = FILE_ENDS
            break
        degree = words[at]
        if degree < 3 or degree >= n - at:
            code = BAD_DEGREE
            break
        for j in range(at + 1, at + 1 + degree):
            v = words[j]
            if v < 0 or v >= n_vertices:
                code = NO_SUCH_VERTEX
                break
            corners[corner] = v
            corner += 1
        if code != FITS:
            break
        degrees[f] = degree
        at += 1 + degree
        if has_colors:
            n_components = words[at] if at < n else -1
            if n_components < 0 or n_components > 4 or n_components == 2:
                code = BAD_COLOR
                break
            if n_components > n - at - 1:
                code = FILE_ENDS
                break
            color_at[f] = at + 1
            n_colors[f] = n_components
            at += 1 + n_components
    state[0] = at
    state[1] = corner
    return code
