"""Reading the files of Shewchuk's Triangle: ``.node`` (points), ``.ele`` (triangles), ``.neigh`` (their neighbors).

A mesh is a pair of files with the same stem, and whichever of them is named, both are read. Numbering may begin at 0 or
at 1: the first row of the ``.node`` file says which. TetGen writes the same files with three coordinates, as we do for
surfaces in space.

The formats: J. R. Shewchuk, "Triangle: Engineering a 2D Quality Mesh Generator and Delaunay Triangulator", Applied
Computational Geometry, LNCS 1148, Springer 1996, and the pages that come with the program.
"""

from __future__ import annotations

import os
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh.core.navigation import opposite_face_of
from halfmesh.io.data import Attributes, MeshData
from halfmesh.io.rows import Table, TableReader
from halfmesh.io.source import Source, skip_gaps
from halfmesh.mesh.mesh import Mesh

__all__ = ["FIRST_NUMBER", "MOST", "Points", "companion", "header_at", "neighbor_rows", "numbered", "read_ele"]
__all__ += ["read_neigh", "read_node", "read_points"]

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]

FIRST_NUMBER = "first_number"  # in `meta`: what the file counts from
MOST = 2**31 - 2
CORNERS, SECOND_ORDER = 3, 6


def read_node(source: Source) -> MeshData:
    """Read points, and the triangles of the ``.ele`` file beside them if there is one."""
    points = read_points(source)
    elements = companion(source.path, ".ele")
    return _with_faces(points, Source(elements)) if os.path.exists(elements) else points.data()


def read_ele(source: Source) -> MeshData:
    """Read triangles, and their points from the ``.node`` file beside them."""
    return _with_faces(_points_of(source), source)


def read_neigh(source: Source) -> MeshData:
    """Read the three files, and check the neighbors against the triangles.

    Raises
    ------
    FormatError
        A triangle has other neighbors than its row says.
    InvalidMeshError
        The triangles make no mesh that can be held.
    """
    data = read_ele(Source(companion(source.path, ".ele")))
    (n, width), begin = header_at(source, source.begin, "triangles, the number of neighbors of each", (None, 3))
    if width != CORNERS:
        raise source.error(f"expected 3 neighbors for each triangle, found {width}", source.begin)
    if n != data.n_faces:
        raise source.error(f"{n} triangles are announced, but the .ele file has {data.n_faces}", source.begin)
    rows = TableReader(source, n, 1 + CORNERS, "triangle", "its number and the numbers of 3 neighbors").read(begin)
    base = numbered(rows)
    found = rows.integers(slice(1, None), "numbers of triangles, or -1,", -1, base + n - 1)
    found[found >= 0] -= base
    true = neighbor_rows(data)
    wrong = np.flatnonzero((found != true).any(axis=1))
    if len(wrong):
        row = int(wrong[0])
        expected = [int(x) + base if x >= 0 else -1 for x in true[row]]
        raise rows.error(
            row, f"triangle {row + base} has the neighbors {expected}, by the .ele file; not as listed here"
        )
    return data


def companion(path: str, suffix: str) -> str:
    """The file with the same stem and another suffix, in capitals if that of `path` is."""
    stem, given = os.path.splitext(path)
    return stem + (suffix.upper() if given.isupper() else suffix)


class Points(NamedTuple):
    """What a ``.node`` file holds, or the first part of a ``.poly`` file."""

    points: Floats
    vertex: Attributes
    base: int
    end: int

    def data(self) -> MeshData:
        """The points alone."""
        nothing = np.zeros(0, dtype=np.int32)
        return MeshData(
            nothing, np.zeros(1, dtype=np.int32), self.points, vertex=self.vertex, meta={FIRST_NUMBER: self.base}
        )


def read_points(source: Source, *, alone: bool = True) -> Points:
    """Read a list of points from the beginning of a file; ``alone``: nothing may follow them."""
    said = "points, their dimension, the number of attributes, whether there are markers (0 or 1)"
    (n, dimension, n_attributes, marked), begin = header_at(source, source.begin, said, (None, 2, 0, 0))
    if dimension not in (2, 3):
        raise source.error(f"the dimension of the points is {dimension}; expected 2 or 3", source.begin)
    if marked not in (0, 1):
        raise source.error(f"expected 0 or 1 for the number of markers, found {marked}", source.begin)
    form = f"its number, {dimension} coordinates"
    form += f", {n_attributes} attributes" if n_attributes else ""
    form += ", a marker" if marked else ""
    reader = TableReader(source, n, 1 + dimension + n_attributes + marked, "point", form)
    rows = reader.read(begin, alone=alone)
    points = np.zeros((n, 3))
    points[:, :dimension] = rows.values[:, 1 : 1 + dimension]
    vertex: Attributes = {}
    if n_attributes:
        vertex["attributes"] = rows.values[:, 1 + dimension : 1 + dimension + n_attributes].copy()
    if marked:
        vertex["marker"] = marker_of(rows)
    return Points(points, vertex, numbered(rows), rows.end)


def header_at(source: Source, at: int, said: str, defaults: tuple[int | None, ...]) -> tuple[tuple[int, ...], int]:
    """The counts in the next line that holds any, and the byte behind them; those left out have their defaults."""
    at = skip_gaps.at(0)(source.data, at, source.end)
    found: list[int] = []
    while len(found) < len(defaults):
        token = source.token(at) if at < source.end else b""
        if not token:
            break
        if not token.isdigit() or int(token[:12]) > MOST or len(token) > 12:
            raise source.error(f"expected the numbers of {said}; found {source.shown(at)}", at)
        found.append(int(token))
        at += len(token)
        while at < source.end and source.data[at] in b" \t\v\f":
            at += 1
    if not found and defaults[0] is None:
        raise source.error(f"expected the numbers of {said}; found {source.shown(at)}", at)
    if at < source.end and source.token(at):
        raise source.error(f"expected no more than the numbers of {said}; found {source.shown(at)}", at)
    return (*found, *(default or 0 for default in defaults[len(found) :])), at


def numbered(rows: Table) -> int:
    """What the rows are counted from, 0 or 1.

    Raises
    ------
    FormatError
        The first is neither, or they are not consecutive.
    """
    numbers = rows.values[:, 0]
    if not len(numbers):
        return 0
    if numbers[0] not in (0.0, 1.0):
        raise rows.error(0, f"the first {rows.reader.what} has the number {numbers[0]:g}; expected 0 or 1")
    base = int(numbers[0])
    wrong = numbers != np.arange(base, base + len(numbers))
    if wrong.any():
        row = int(np.argmax(wrong))
        raise rows.error(row, f"expected {rows.reader.what} number {row + base}, found {numbers[row]:g}")
    return base


def marker_of(rows: Table) -> Ints:
    """The last column."""
    return rows.integers(slice(-1, None), "a marker", -MOST - 2, MOST + 1)[:, 0]


def _points_of(source: Source) -> Points:
    path = companion(source.path, ".node")
    try:
        return read_points(Source(path))
    except FileNotFoundError as error:
        error.add_note(f"the points of {source.path} lie in a .node file beside it")
        raise


def _with_faces(points: Points, source: Source) -> MeshData:
    said = "triangles, the nodes of each, the number of attributes"
    (n, n_nodes, n_attributes), begin = header_at(source, source.begin, said, (None, CORNERS, 0))
    if n_nodes not in (CORNERS, SECOND_ORDER):
        what = "these are tetrahedra" if n_nodes == 4 else "these are no triangles"
        raise source.error(
            f"expected 3 nodes for each triangle, or 6 of second order; found {n_nodes}: {what}", source.begin
        )
    form = f"its number, {n_nodes} vertices" + (f", {n_attributes} attributes" if n_attributes else "")
    rows = TableReader(source, n, 1 + n_nodes + n_attributes, "triangle", form).read(begin)
    numbered(rows)
    data = points.data()
    last = points.base + len(points.points) - 1
    nodes = rows.integers(slice(1, 1 + n_nodes), "vertices numbered", points.base, last)
    nodes -= points.base
    data.indices = np.ascontiguousarray(nodes[:, :CORNERS]).reshape(-1)
    data.offsets = np.arange(0, CORNERS * n + 1, CORNERS, dtype=np.int32)
    if n_nodes == SECOND_ORDER:
        data.face["midpoints"] = nodes[:, CORNERS:].copy()
    if n_attributes:
        data.face["attributes"] = rows.values[:, 1 + n_nodes :].copy()
    return data


def neighbor_rows(data: MeshData) -> Ints:
    """The triangle across the edge opposite to each corner, -1 for none; shape (n, 3). O(n).

    Raises
    ------
    InvalidMeshError
        The triangles make no mesh that can be held.
    """
    mesh = Mesh(data.faces, n_vertices=data.n_vertices)
    across: Ints = opposite_face_of(mesh.topology, mesh.corner_halfedges())
    return across.reshape(-1, CORNERS)[:, [1, 2, 0]]
