"""Reading Triangle's ``.poly`` files: points, the segments between them, holes, regions. No triangles."""

from __future__ import annotations

import numpy as np

from halfmesh.io.data import MeshData
from halfmesh.io.rows import TableReader
from halfmesh.io.source import Source, skip_gaps
from halfmesh.io.triangle_files import MOST, companion, header_at, marker_of, numbered, read_points

__all__ = ["read_poly"]


def read_poly(source: Source) -> MeshData:
    """Read a planar straight line graph.

    If the file has 0 points, they lie in the ``.node`` file beside it. Segments are `edges`, with their markers in
    ``edge["marker"]``; ``meta["holes"]`` is a point in each hole, shape (k, 2), ``meta["regions"]`` a point in each
    region, its attribute and its largest area (-1 for none), shape (k, 4).
    """
    points = read_points(source, alone=False)
    end = points.end
    if not len(points.points):
        points = read_points(Source(companion(source.path, ".node")))
    data = points.data()
    (n, marked), end = header_at(source, end, "segments, whether there are markers (0 or 1)", (None, 0))
    if marked not in (0, 1):
        raise source.error(f"expected 0 or 1 for the number of markers, found {marked}", end)
    form = "its number, 2 points" + (", a marker" if marked else "")
    rows = TableReader(source, n, 3 + marked, "segment", form).read(end, alone=False)
    numbered(rows)
    data.edges = rows.integers(slice(1, 3), "points numbered", points.base, points.base + data.n_vertices - 1)
    data.edges -= points.base
    if marked:
        data.edge["marker"] = marker_of(rows)
    _read_places(source, rows.end, data)
    return data


def _read_places(source: Source, at: int, data: MeshData) -> None:
    """Holes, and regions where there are any."""
    (n,), at = header_at(source, at, "holes", (None,))
    holes = TableReader(source, n, 3, "hole", "its number and 2 coordinates").read(at, alone=False)
    data.meta["holes"] = holes.values[:, 1:].copy()
    (n,), at = header_at(source, holes.end, "regions", (0,))
    regions = np.empty((0, 4))
    if n:
        regions, at = _regions(source, n, at)
    if len(regions):
        data.meta["regions"] = regions
    rest = skip_gaps.at(0)(source.data, at, source.end)
    if rest < source.end:
        raise source.error(f"expected nothing behind the last region, found {source.shown(rest)}", rest)


def _regions(source: Source, n: int, at: int) -> tuple[np.ndarray[tuple[int, int], np.dtype[np.float64]], int]:
    """Each is its number, a place, an attribute, and often a largest area: the first line says whether."""
    first = skip_gaps.at(0)(source.data, at, source.end)
    line = bytes(source.data[first : first + MOST]).splitlines()[:1]
    width = 5 if line and len(line[0].split(b"#")[0].split()) == 5 else 4
    form = "its number, 2 coordinates, an attribute" + (", a largest area" if width == 5 else "")
    rows = TableReader(source, n, width, "region", form).read(at, alone=False)
    values = np.full((n, 4), -1.0)
    values[:, : width - 1] = rows.values[:, 1:]
    return values, rows.end
