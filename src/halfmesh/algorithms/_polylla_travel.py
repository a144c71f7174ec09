"""Travel: around every terminal-edge region along its frontier.

The region of a terminal edge is a tree of triangles, joined by internal edges. Its frontier is one closed walk: along a
triangle to the next edge, and where that is internal, across it, so turning clockwise about the vertex until an edge is
frontier. All halfedges of the region's triangles are passed once, so the walks of all regions are O(n) together.

The corners are written down one after the other, in a stretch of its own for each thread. Nobody knows beforehand how
long those get, so there is room for the longest; memory that nobody touches costs nothing.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import LONGEST, Bytes, Ints, is_internal
from halfmesh.core.matching import parts
from halfmesh.core.navigation import face_of, next_of, origin_of, twin_of
from halfmesh.core.topology import LIMIT

__all__ = ["Walks", "first_frontier", "travel"]

Stretch = tuple[int, int]


class Walks(NamedTuple):
    """The frontier of every region, corner after corner.

    Corners are in the order of their polygons, with gaps between them; -1 in `corners` where a gap is in a stretch.
    """

    corners: Ints  # the halfedge of each corner
    vertices: Ints  # its origin
    stretches: list[Stretch]  # which corners are in use
    begins: Ints  # the first corner of each polygon
    degrees: Ints  # its number of sides
    places: Ints  # of each frontier halfedge, its corner
    of_triangle: Ints  # the polygon of each triangle
    bad: Ints  # the regions that pass a vertex twice
    n_tips: int  # ends of barrier edges


@kernel
def first_frontier(t: Any, marks: Any, seed: int) -> int:
    """A frontier halfedge of the region of a seed, from the same vertex."""
    h = seed
    while is_internal(t, marks, h):
        h = next_of(t, twin_of(t, h))
    return h


def travel(t: Any, marks: Bytes, seeds: Ints, n_vertices: int, n_faces: int) -> Walks:
    """Walk around every region: its corners and triangles, and whether it is a simple polygon already. O(n)."""
    n = len(seeds)
    pieces = parts(n, len(marks))  # few, as each has a table of one int a vertex
    while len(pieces) > 1 and (len(pieces) + 3) * n_faces + 2 * n > LIMIT:
        pieces = [*pieces[:-2], (pieces[-2][0], pieces[-1][1])]
    rooms = [n_faces + 2 * (high - low) for low, high in pieces]  # a region of k triangles has k + 2 sides
    starts = [sum(rooms[:i]) for i in range(len(pieces))]
    room = min(sum(rooms) + 3 * n_faces, LIMIT) + 1  # and behind them for what a repair adds
    corners, vertices = np.empty(room, dtype=np.int32), np.empty(room, dtype=np.int32)
    begins, degrees, bad = (np.empty(max(n, 1), dtype=np.int32) for _ in range(3))
    places, of_triangle = np.empty(len(marks), dtype=np.int32), np.empty(max(n_faces, 1), dtype=np.int32)
    target = (corners, vertices, begins, degrees, places, of_triangle, bad)
    jobs = [
        (t, marks, seeds, *target, np.full(max(n_vertices, 1), -1, np.int32), start, *piece)
        for start, piece in zip(starts, pieces, strict=True)
    ]
    found = parallel(_travel.at(len(marks)), jobs)
    stretches = [(start, end) for start, (end, _, _) in zip(starts, found, strict=True)]
    listed = [bad[low : low + n_bad] for (low, _), (_, n_bad, _) in zip(pieces, found, strict=True)]
    n_tips = sum(n_tips for _, _, n_tips in found)
    return Walks(
        corners,
        vertices,
        stretches,
        begins[:n],
        degrees[:n],
        places,
        of_triangle[:n_faces],
        np.concatenate(listed),
        n_tips,
    )


@kernel
def _travel(
    t: Any, marks: Any, seeds: Any,
    corners: Any, vertices: Any, begins: Any, degrees: Any, places: Any, of_triangle: Any, bad: Any, seen: Any,
    place: int, low: int, high: int,
) -> tuple[int, int, int]:  # fmt: skip
    """Write from `place` on: where it ended, and the numbers of bad regions and tips.

    Each triangle is noted when the walk passes its longest edge, as it does once.
    """
    c, n_bad, n_tips = place, 0, 0
    for p in range(low, high):
        start = first_frontier(t, marks, seeds[p])
        begins[p] = c
        h, is_simple = start, True
        while True:
            v = origin_of(t, h)
            is_simple &= seen[v] != p
            seen[v] = p
            corners[c] = h
            vertices[c] = v
            places[h] = c
            c += 1
            g = twin_of(t, h)
            if marks[h] & LONGEST:
                of_triangle[face_of(t, h)] = p
            h = next_of(t, h)
            while is_internal(t, marks, h):
                if marks[h] & LONGEST:
                    of_triangle[face_of(t, h)] = p
                h = next_of(t, twin_of(t, h))
            n_tips += h == g
            if h == start:
                break
        degrees[p] = c - begins[p]
        if not is_simple:
            bad[low + n_bad] = p
            n_bad += 1
    return c, n_bad, n_tips
