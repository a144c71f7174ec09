"""Marks: one byte a halfedge says which edges are the longest of a triangle, and with that which are frontier.

==========  ========================================================================================================
mark        of a halfedge
==========  ========================================================================================================
``INSIDE``  it has a triangle, of which it is not the longest edge
``LONGEST`` it is the longest edge of its triangle
``OUTSIDE`` it has no face: exterior, or wire
``CUT``     added to both sides of an edge by a repair: frontier from now on
``PENDING`` added while a repair has still to walk the polygon that this halfedge bounds
==========  ========================================================================================================

An edge is *internal* where the marks of its two sides together are ``LONGEST`` and nothing else; all others are
*frontier*: the longest edge of neither triangle, boundary, wire, or cut. An internal edge that is the longest of both
its triangles is *terminal*; so is a boundary edge that is the longest of its one triangle.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import apart, kernel, parallel
from halfmesh.core.navigation import edge_of, halfedge_of_edge, halfedge_of_face, next_of, origin_of, target_of, twin_of
from halfmesh.geometry._passes import Floats, ranges

__all__ = [
    "CUT",
    "INSIDE",
    "LONGEST",
    "OUTSIDE",
    "PENDING",
    "Bytes",
    "Ints",
    "find_seeds",
    "is_internal",
    "mark_longest_edges",
]

Bytes = NDArray[np.uint8]
Ints = NDArray[np.int32]

INSIDE, LONGEST, OUTSIDE, CUT, PENDING = 0, 1, 2, 4, 8
OK, NO_TRIANGLE, REPEATED_VERTEX, NOT_FINITE = 0, 1, 2, 3


@kernel
def is_internal(t: Any, marks: Any, h: int) -> bool:
    """Whether the triangles on both sides of `h` belong to one polygon, joined by this edge."""
    return (marks[h] | marks[twin_of(t, h)]) == LONGEST  # type: ignore[no-any-return]


# -- longest edges -------------------------------------------------------------------------------------------------


def mark_longest_edges(t: Any, points: Floats, n_halfedges: int, n_faces: int) -> tuple[Bytes, int, int]:
    """The marks of all halfedges; a code and the first face that has it, where that can't be. O(n), on all threads."""
    marks = np.full(max(n_halfedges, 1), OUTSIDE, dtype=np.uint8)
    jobs = [(t, points, marks, low, high) for low, high in ranges(n_faces)]
    for code, f in parallel(_mark_longest.at(n_faces), jobs):
        if code != OK:
            return marks, code, f
    return marks, OK, -1


@kernel
def _mark_longest(t: Any, points: Any, marks: Any, low: int, high: int) -> tuple[int, int]:
    for f in range(low, high):
        h0 = halfedge_of_face(t, f)
        h1 = next_of(t, h0)
        h2 = next_of(t, h1)
        if h2 == h0 or next_of(t, h2) != h0:
            return NO_TRIANGLE, f
        a, b, c = origin_of(t, h0), origin_of(t, h1), origin_of(t, h2)
        if a == b or b == c or c == a:  # noqa: PLR1714 - compiled code compares
            return REPEATED_VERTEX, f
        d0, d1, d2 = _squared(points, a, b), _squared(points, b, c), _squared(points, c, a)
        longest = max(d0, d1, d2)
        if not d0 + d1 + d2 < np.inf:  # nor is NaN
            return NOT_FINITE, f
        is0, is1, is2 = d0 == longest, d1 == longest, d2 == longest
        if is0 + is1 + is2 != 1:
            is0, is1, is2 = _first_of(t, points, h0, h1, h2, is0, is1, is2)
        marks[h0] = is0
        marks[h1] = is1
        marks[h2] = is2
    return OK, -1


@kernel
def _squared(points: Any, a: int, b: int) -> float:
    """The squared length: the same to the last bit from both ends."""
    x, y, z = points[a, 0] - points[b, 0], points[a, 1] - points[b, 1], points[a, 2] - points[b, 2]
    return x * x + y * y + z * z  # type: ignore[no-any-return]


@kernel
def _first_of(
    t: Any, points: Any, h0: int, h1: int, h2: int, is0: bool, is1: bool, is2: bool
) -> tuple[bool, bool, bool]:
    """Of two or three sides that are equally long, the one that comes first in `_is_before`."""
    apart()
    best = h0
    if not is0 or (is1 and _is_before(t, points, h1, h0)):
        best = h1
    if is2 and _is_before(t, points, h2, best):
        best = h2
    return best == h0, best == h1, best == h2


@kernel
def _is_before(t: Any, points: Any, h: int, g: int) -> bool:
    """The order of edges: by their lower ends' coordinates, x first, then by their upper ends', then by indices."""
    a, b = origin_of(t, h), target_of(t, h)
    c, d = origin_of(t, g), target_of(t, g)
    if _order(points, a, b) > 0:
        a, b = b, a
    if _order(points, c, d) > 0:
        c, d = d, c
    for k in range(3):
        if points[a, k] != points[c, k]:
            return points[a, k] < points[c, k]  # type: ignore[no-any-return]
    for k in range(3):
        if points[b, k] != points[d, k]:
            return points[b, k] < points[d, k]  # type: ignore[no-any-return]
    if a != c:
        return a < c  # type: ignore[no-any-return]
    if b != d:
        return b < d  # type: ignore[no-any-return]
    return edge_of(t, h) < edge_of(t, g)  # type: ignore[no-any-return]


@kernel
def _order(points: Any, a: int, b: int) -> int:
    """Negative if vertex `a` comes before `b`: by coordinates, then by index."""
    for k in range(3):
        if points[a, k] != points[b, k]:
            return -1 if points[a, k] < points[b, k] else 1
    return a - b


# -- seeds ---------------------------------------------------------------------------------------------------------


def find_seeds(t: Any, marks: Bytes, n_edges: int) -> tuple[Ints, int]:
    """A halfedge of every terminal edge, in the order of the edges; and the number of wire edges."""
    pieces = ranges(n_edges)
    rows = [np.empty(high - low + 1, dtype=np.int32) for low, high in pieces]
    found = parallel(
        _list_seeds.at(n_edges), [(t, marks, *job) for job in zip(rows, *zip(*pieces, strict=True), strict=True)]
    )
    return np.concatenate([row[:n] for row, (n, _) in zip(rows, found, strict=True)]), sum(n for _, n in found)


@kernel
def _list_seeds(t: Any, marks: Any, seeds: Any, low: int, high: int) -> tuple[int, int]:
    n, n_wire = 0, 0
    for e in range(low, high):
        h = halfedge_of_edge(t, e)
        g = twin_of(t, h)
        seeds[n] = g if marks[h] == OUTSIDE else h  # without a branch: to be overwritten if it is none
        n += is_terminal(marks[h], marks[g])
        n_wire += (marks[h] & marks[g]) == OUTSIDE
    return n, n_wire


@kernel
def is_terminal(a: int, b: int) -> bool:
    """Whether an edge of which the sides have these marks is terminal: the longest of all triangles that it has."""
    return (a & b) == LONGEST or (a | b) == (LONGEST | OUTSIDE)
