"""Writing the files of Triangle: ``.node``, ``.ele``, ``.neigh``, ``.poly``; see `triangle_files`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from halfmesh.errors import FormatError
from halfmesh.io.data import MeshData
from halfmesh.io.off_writing import column
from halfmesh.io.text_writing import Table, row_text
from halfmesh.io.triangle_files import FIRST_NUMBER, neighbor_rows

__all__ = ["ele_pieces", "neigh_pieces", "node_pieces", "poly_pieces"]

Piece = bytes | memoryview
Floats = NDArray[np.float64]


def node_pieces(data: MeshData, path: str) -> Iterator[Piece]:
    """The points, with their attributes and markers; two coordinates if all z are 0."""
    _check_no_wire(data, path)
    yield from _points(data)


def ele_pieces(data: MeshData, path: str) -> Iterator[Piece]:
    """The triangles, with their attributes."""
    triangles = _triangles(data, path)
    attributes = column(data.face, "attributes", data.n_faces)
    n_attributes = 0 if attributes is None else attributes.shape[1]
    yield _header(data.n_faces, 3, n_attributes)
    yield from _rows(data, triangles + _base(data), attributes)


def neigh_pieces(data: MeshData, path: str) -> Iterator[Piece]:
    """The neighbors of the triangles: the first lies opposite to the first corner; -1 for none."""
    _triangles(data, path)
    neighbors = neighbor_rows(data)
    yield _header(data.n_faces, 3)
    yield from _rows(data, np.where(neighbors < 0, -1, neighbors + _base(data)))


def poly_pieces(data: MeshData, path: str) -> Iterator[Piece]:
    """Points and segments, holes and regions."""
    if data.n_faces:
        raise FormatError(
            f"a .poly file holds segments and no faces, and there are {data.n_faces}; save an .ele file, or the "
            "outline: Mesh([], points, edges=...)",
            path=path,
        )
    markers = column(data.edge, "marker", len(data.edges), (1,))
    yield from _points(data)
    yield _header(len(data.edges), int(markers is not None))
    yield from _rows(data, data.edges + _base(data), markers)
    holes = np.asarray(data.meta.get("holes", np.empty((0, 2))), dtype=np.float64).reshape(-1, 2)
    yield _header(len(holes))
    yield from _rows(data, holes)
    regions = np.asarray(data.meta.get("regions", np.empty((0, 4))), dtype=np.float64).reshape(-1, 4)
    if len(regions):
        yield _header(len(regions))
        yield from _rows(data, regions)


def _points(data: MeshData) -> Iterator[Piece]:
    dimension = 3 if data.points[:, 2].any() else 2
    attributes = column(data.vertex, "attributes", data.n_vertices)
    markers = column(data.vertex, "marker", data.n_vertices, (1,))
    yield _header(
        data.n_vertices, dimension, 0 if attributes is None else attributes.shape[1], int(markers is not None)
    )
    yield from _rows(data, data.points[:, :dimension], attributes, markers)


def _base(data: MeshData) -> int:
    return 1 if data.meta.get(FIRST_NUMBER, 0) == 1 else 0


def _header(*counts: int) -> bytes:
    return " ".join(map(str, counts)).encode() + b"\n"


def _rows(data: MeshData, *columns: NDArray[np.generic] | None) -> Iterator[Piece]:
    """Lines that begin with their number."""
    given: list[NDArray[np.generic]] = [c for c in columns if c is not None]
    first = _base(data)
    numbers = np.arange(first, first + len(given[0]), dtype=np.float64)
    yield from row_text(Table(np.column_stack([numbers, *given])))


def _triangles(data: MeshData, path: str) -> NDArray[np.int32]:
    _check_no_wire(data, path)
    bad = np.flatnonzero(np.diff(data.offsets) != 3)
    if len(bad):
        degree = data.offsets[bad[0] + 1] - data.offsets[bad[0]]
        raise FormatError(
            f"an .ele file holds triangles, and face {bad[0]} has {degree} vertices; cut the faces first "
            "(halfmesh.triangulated), or save OFF or OBJ",
            path=path,
        )
    return data.indices.reshape(-1, 3)


def _check_no_wire(data: MeshData, path: str) -> None:
    if len(data.edges):
        raise FormatError(
            f"edges without faces ({len(data.edges)}) have no place in .node and .ele files; save a .poly file, or OBJ",
            path=path,
        )
