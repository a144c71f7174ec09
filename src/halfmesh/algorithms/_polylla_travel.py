"""Travel: around every terminal-edge region along its frontier.

The region of a terminal edge is a tree of triangles, joined by internal edges. Its frontier is one closed walk: along a
triangle to the next edge, and where that is internal, across it, so turning clockwise about the vertex until an edge is
frontier. All halfedges of the region's triangles are passed once, so the walks of all regions are O(n) together.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import LONGEST, Bytes, Ints, is_internal
from halfmesh.core.matching import parts
from halfmesh.core.navigation import face_of, next_of, origin_of, twin_of
from halfmesh.geometry._passes import ranges

__all__ = ["Polygons", "Travel", "collect", "first_frontier", "next_frontier", "travel"]


class Travel(NamedTuple):
    """What the first walk around all regions has found."""

    degrees: Ints  # sides of each region
    bad: Ints  # the regions that pass a vertex twice
    n_tips: int  # ends of barrier edges


class Polygons(NamedTuple):
    """All polygons, corner after corner."""

    corners: Ints  # the halfedge of each corner, by index of the triangulation
    vertices: Ints  # its origin
    offsets: Ints  # where each polygon begins, and the end
    places: Ints  # of each frontier halfedge, its corner
    of_triangle: Ints  # the polygon of each triangle


@kernel
def next_frontier(t: Any, marks: Any, h: int) -> int:
    """The frontier halfedge after `h` around its region."""
    g = next_of(t, h)
    while is_internal(t, marks, g):
        g = next_of(t, twin_of(t, g))
    return g  # type: ignore[no-any-return]


@kernel
def first_frontier(t: Any, marks: Any, seed: int) -> int:
    """A frontier halfedge of the region of a seed, from the same vertex."""
    g = seed
    while is_internal(t, marks, g):
        g = next_of(t, twin_of(t, g))
    return g


# -- the first walk ------------------------------------------------------------------------------------------------


def travel(t: Any, marks: Bytes, seeds: Ints, n_vertices: int) -> Travel:
    """Walk around every region: how many sides it has, and whether it is a simple polygon already."""
    n = len(seeds)
    degrees, bad = np.empty(max(n, 1), dtype=np.int32), np.empty(max(n, 1), dtype=np.int32)
    pieces = parts(n, len(marks))  # few, as each has a table of one int a vertex
    jobs = [(t, marks, seeds, degrees, bad, np.full(max(n_vertices, 1), -1, np.int32), *piece) for piece in pieces]
    found = parallel(_travel.at(len(marks)), jobs)
    listed = [bad[low : low + n_bad] for (low, _), (n_bad, _) in zip(pieces, found, strict=True)]
    return Travel(degrees[:n], np.concatenate(listed), sum(n_tips for _, n_tips in found))


@kernel
def _travel(t: Any, marks: Any, seeds: Any, degrees: Any, bad: Any, seen: Any, low: int, high: int) -> tuple[int, int]:
    """Fill `degrees`; `bad` from `low` on with the regions that pass a vertex twice: their number and that of tips."""
    n_bad, n_tips = 0, 0
    for p in range(low, high):
        start = first_frontier(t, marks, seeds[p])
        h, n, is_simple = start, 0, True
        while True:
            v = origin_of(t, h)
            if seen[v] == p:
                is_simple = False
            seen[v] = p
            n += 1
            g = next_frontier(t, marks, h)
            n_tips += g == twin_of(t, h)
            h = g
            if h == start:
                break
        degrees[p] = n
        if not is_simple:
            bad[low + n_bad] = p
            n_bad += 1
    return n_bad, n_tips


# -- the last walk -------------------------------------------------------------------------------------------------


def collect(t: Any, marks: Bytes, seeds: Ints, degrees: Ints, n_faces: int) -> Polygons:
    """Walk around every polygon and write down its corners and its triangles."""
    n = len(seeds)
    offsets = np.zeros(n + 1, dtype=np.int32)
    np.cumsum(degrees, out=offsets[1:])
    n_corners = int(offsets[-1])
    corners, vertices = np.empty(max(n_corners, 1), dtype=np.int32), np.empty(max(n_corners, 1), dtype=np.int32)
    places, of_triangle = np.empty(len(marks), dtype=np.int32), np.empty(max(n_faces, 1), dtype=np.int32)
    made = Polygons(corners[:n_corners], vertices[:n_corners], offsets, places, of_triangle[:n_faces])
    target = (corners, vertices, offsets, places, of_triangle)
    parallel(_collect.at(len(marks)), [(t, marks, seeds, *target, *piece) for piece in ranges(n)])
    return made


@kernel
def _collect(
    t: Any, marks: Any, seeds: Any, corners: Any, vertices: Any, offsets: Any, places: Any, of_triangle: Any,
    low: int, high: int,
) -> None:  # fmt: skip
    """Each triangle is noted when the walk passes its longest edge, as it does once."""
    for p in range(low, high):
        h = first_frontier(t, marks, seeds[p])
        for c in range(offsets[p], offsets[p + 1]):
            corners[c] = h
            vertices[c] = origin_of(t, h)
            places[h] = c
            if marks[h] & LONGEST:
                of_triangle[face_of(t, h)] = p
            h = next_of(t, h)
            while is_internal(t, marks, h):
                if marks[h] & LONGEST:
                    of_triangle[face_of(t, h)] = p
                h = next_of(t, twin_of(t, h))
