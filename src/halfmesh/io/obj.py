"""Reading Wavefront OBJ: polygons, wire, texture coordinates and normals at the corners, groups.

What belongs to a mesh is kept: ``v`` with colour or weight, ``vt``, ``vn``, ``f``, ``l``, ``g o usemtl s`` as integer
labels of the faces, the name behind ``mtllib`` (the file is never opened). ``p`` lines are checked and counted, lines
with any other keyword (curves, surfaces, what a writer forgot to mark as a comment) are counted by keyword.
"""

from __future__ import annotations

from typing import NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import parallel
from halfmesh.io import obj_kernels as k
from halfmesh.io.data import Attributes, MeshData
from halfmesh.io.numbers import powers_of_ten
from halfmesh.io.obj_labels import read_labels
from halfmesh.io.source import Source, interpreted_size

__all__ = ["read_obj"]

_MOST_OPEN = 2048
_FEED, _RETURN, _SPACE, _HASH, _BACKSLASH = 10, 13, 32, 35, 92
_ROWS = ((k.VERTEX, k.V), (k.TEXTURE, k.VT), (k.NORMAL, k.VN), (k.FACE, k.F), (k.EVENT, k.OTHER))


def read_obj(source: Source) -> MeshData:
    """Read OBJ.

    Raises
    ------
    FormatError
        With the line and what was expected there.

    Notes
    -----
    Time and memory are proportional to the size of the file.
    """
    return _Text(source).data()


class _Piece(NamedTuple):
    """What one thread found."""

    corners: NDArray[np.int32]
    textures: NDArray[np.int32]
    normals: NDArray[np.int32]
    edges: NDArray[np.int32]
    state: NDArray[np.int64]


class _Text:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.size = interpreted_size(source.end)
        self.bytes = _joined(source)  # padded like that of `source`
        self.spans = source.parts(source.begin)
        counts = np.zeros((len(self.spans), k.N_KINDS), dtype=np.int64)
        jobs = [(self.bytes, *span, counts[n]) for n, span in enumerate(self.spans)]
        parallel(k.survey.at(self.size), jobs)
        self.before = np.cumsum(counts, axis=0) - counts
        self.totals = counts.sum(axis=0)
        self._allocate()

    def _allocate(self) -> None:
        n_vertices, n_textures, n_normals, n_faces = (int(self.totals[x]) for x in (k.V, k.VT, k.VN, k.F))
        if not self.totals[k.V]:
            what = "the file is empty" if not self.totals[1:].any() else "there is no vertex (a line 'v x y z')"
            raise self.source.error(f"{what}; expected Wavefront OBJ text")
        self.points, self.extras = np.empty(3 * n_vertices), np.empty(4 * n_vertices)
        self.n_extras = np.empty(n_vertices, dtype=np.int8)
        self.textures, self.normals = np.empty(3 * n_textures), np.empty(3 * n_normals)
        self.degrees = np.empty(n_faces, dtype=np.int32)
        self.events = np.empty(2 * int(self.totals[k.OTHER]), dtype=np.int64)

    def data(self) -> MeshData:
        pieces = parallel(self._read, list(enumerate(self.spans)))
        offsets = np.zeros(len(self.degrees) + 1, dtype=np.int32)
        np.cumsum(self.degrees, out=offsets[1:])
        corners = np.concatenate([piece.corners for piece in pieces])
        data = MeshData(corners, offsets, self.points.reshape(-1, 3))
        data.edges = np.concatenate([piece.edges for piece in pieces]).reshape(-1, 2)
        data.vertex = self._vertex_attributes(pieces)
        data.halfedge = self._corner_attributes(pieces)
        data.face, data.meta = read_labels(self.source, self.bytes, self.events.reshape(-1, 2), data.n_faces)
        data.meta["n_point_elements"] = sum(int(piece.state[k.N_POINTS]) for piece in pieces)
        return data

    def _read(self, n: int, span: tuple[int, int]) -> _Piece:
        begin, end = span
        state = np.zeros(k.N_STATE, dtype=np.int64)
        state[k.POSITION] = begin
        for place, kind in _ROWS:
            state[place] = self.before[n, kind]
        room = (end - begin) // 2 + 1  # a corner takes at least two bytes; memory is touched as far as it is written
        corners, textures, normals = (np.empty(room, dtype=np.int32) for _ in range(3))
        edges = np.empty(2 * room if self.totals[k.L] else 0, dtype=np.int32)
        undecided = np.empty(2 * _MOST_OPEN, dtype=np.int64)
        rows = (self.points, self.extras, self.n_extras, self.textures, self.normals)
        run = k.read_lines.at(self.size)
        powers = powers_of_ten()
        while True:
            own = (corners, textures, normals, self.degrees, edges, self.events, undecided, state)
            run(self.bytes, end, self.totals, powers, *rows, *own)
            self._decide(undecided[: 2 * state[k.N_OPEN]].reshape(-1, 2))
            if state[k.CODE] == k.DONE:
                break
            if state[k.CODE] != k.AGAIN:
                self._raise(int(state[k.CODE]), int(state[k.WHERE]))
        n_corners = int(state[k.CORNER])
        for column, flag in ((textures, k.HAS_TEXTURE), (normals, k.HAS_NORMALS)):
            if not state[k.SEEN] & flag:
                column[:n_corners] = -1
        n_edges = int(state[k.EDGE])
        return _Piece(corners[:n_corners], textures[:n_corners], normals[:n_corners], edges[: 2 * n_edges], state)

    def _decide(self, undecided: NDArray[np.int64]) -> None:
        arrays = (self.points, self.extras, self.textures, self.normals)
        for at, place in undecided.tolist():
            arrays[place % 4][place // 4] = self.source.number(at)

    def _raise(self, code: int, at: int) -> NoReturn:
        shown = self.source.shown(at).strip("'")
        line = bytes(self.bytes[at : at + 64]).split()
        word = line[0].decode("ascii", "replace") if line else ""
        expected = {
            "v": "x y z, with a weight or a colour r g b [a] behind them",
            "vt": "1 to 3 numbers",
            "vn": "3 numbers",
        }
        complaints = {
            k.FEW_NUMBERS: f"'{word}' has too few numbers; expected {expected.get(word)}",
            k.MANY_NUMBERS: f"'{word}' has numbers left over; expected {expected.get(word)}",
            k.BAD_CORNER: f"expected a vertex index as v, v/vt, v//vn or v/vt/vn in integers, found {shown!r}",
            k.NO_VERTEX: f"{shown!r} refers to a vertex that is not there{self._numbered('vertices', k.V)}",
            k.NO_TEXTURE: f"{shown!r} refers to a texture coordinate that is not there"
            f"{self._numbered('texture coordinates', k.VT)}",
            k.NO_NORMAL: f"{shown!r} refers to a normal that is not there{self._numbered('normals', k.VN)}",
            k.SMALL_FACE: "a face has fewer than 3 vertices; write an edge as 'l', a point as 'p', or remove the line",
        }
        raise self.source.error(complaints[code], at)

    def _numbered(self, what: str, kind: int) -> str:
        return f"; the {self.totals[kind]} {what} are numbered from 1, or backwards from -1"

    def _vertex_attributes(self, pieces: list[_Piece]) -> Attributes:
        named: Attributes = {}
        if not self.n_extras.any():
            return named
        extras = self.extras.reshape(-1, 4)
        if (weighted := self.n_extras == 1).any():
            named["w"] = np.where(weighted, extras[:, 0], 1.0)
        n = int(self.n_extras.max())
        if n > 1:
            given = (self.n_extras[:, None] > np.arange(n)) & ~weighted[:, None]
            colors = np.where(given, extras[:, :n], np.nan)
            dotted = any(piece.state[k.SEEN] & k.DOTTED for piece in pieces)
            in_bytes = not dotted and bool(given.all()) and colors.min() >= 0 and 1 < colors.max() <= 255
            named["color"] = colors.astype(np.uint8) if in_bytes else colors
        return named

    def _corner_attributes(self, pieces: list[_Piece]) -> Attributes:
        named: Attributes = {}
        seen = np.bitwise_or.reduce([piece.state[k.SEEN] for piece in pieces])
        if seen & k.HAS_TEXTURE:
            n = max(int(piece.state[k.N_TEXTURE]) for piece in pieces)
            rows = np.concatenate([piece.textures for piece in pieces])
            named["texcoord"] = _gathered(self.textures.reshape(-1, 3)[:, :n], rows)
        if seen & k.HAS_NORMALS:
            rows = np.concatenate([piece.normals for piece in pieces])
            named["normal"] = _gathered(self.normals.reshape(-1, 3), rows)
        return named


def _gathered(values: NDArray[np.float64], rows: NDArray[np.int32]) -> NDArray[np.float64]:
    """``values[rows]``, NaN where the row is -1."""
    gathered = values[rows]
    gathered[rows < 0] = np.nan
    return gathered


def _joined(source: Source) -> NDArray[np.uint8]:
    r"""The padded text with each backslash that joins two lines written as blanks; byte for byte at the same places.

    A comment ends with its line, backslash or not: paths like ``C:\models\`` stand there.
    """
    data = source.data
    at = np.flatnonzero(data == _BACKSLASH)
    if not len(at):
        return source.padded
    joined = source.padded.copy()
    at = at[(joined[at + 1] == _FEED) | (joined[at + 1] == _RETURN)]  # at the end of the file padding follows
    ends = np.flatnonzero((data == _FEED) | (data == _RETURN))
    comments = np.flatnonzero(data == _HASH)
    line = np.concatenate([[0], ends + 1])[np.searchsorted(ends, at)]
    at = at[np.searchsorted(comments, line) == np.searchsorted(comments, at)]
    both = at[(joined[at + 1] == _RETURN) & (joined[at + 2] == _FEED)]
    for place in (at, at + 1, both + 2):
        joined[place] = _SPACE
    joined[len(data) :] = _FEED
    return joined
