"""The best of all triangulations of a small polygon, where ears have run out.

By the intervals of corners, in the manner of G. T. Klincsek, "Minimal triangulations of polygonal domains" (Annals of
Discrete Mathematics 9, 1980). What is minimal is, each only among those that are alike in all before: the number of
loop edges, of triangles that turn clockwise, of parallel edges, of triangles without area; then the area, which is
least where nothing is covered twice; then the length of the diagonals. O(corners^3).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import apart, kernel
from halfmesh.algorithms._ears import FEW, cut, diagonal_status
from halfmesh.algorithms._orientation import orientation
from halfmesh.algorithms._plane import AFTER, CORNER
from halfmesh.core.statuses import OK, WOULD_BE_LOOP, WOULD_BE_PARALLEL

__all__ = ["DOUBLED", "cut_best"]

_PARALLEL, _CLOCKWISE, _LOOP = FEW, FEW**2, FEW**3  # faults; a triangle without area is 1
_NEVER = FEW**5

DOUBLED = -1  # two diagonals of the best triangulation join the same two vertices, which the search can't see coming


@kernel
def cut_best(t: Any, w: Any, p: Any, n: int, first: int, left: int) -> int:
    """Cut the ring of corners into triangles, all but the last; ``OK``, or why it is forbidden.

    `first` is any corner of the ring, `left` their number, no more than FEW; `n` is that of the whole face.
    """
    apart()
    ring = np.empty(left, np.int64)
    for i in range(left):
        ring[i] = first
        first = w[AFTER, first]
    faults, costs, middles = np.zeros((left, left), np.int64), np.zeros((left, left)), np.zeros((left, left), np.int64)
    for gap in range(2, left):
        for i in range(left - gap):
            _choose(t, w, p, ring, n - left, i, i + gap, faults, costs, middles)
    _cut_all(w, ring, middles, n - left)
    total = faults[0, left - 1]
    status = OK
    if total >= _LOOP:
        status = WOULD_BE_LOOP
    elif total % _CLOCKWISE >= _PARALLEL:
        status = WOULD_BE_PARALLEL
    for triangle in range(n - left, n - 3):
        a, c = w[CORNER, triangle], w[CORNER + 2, triangle]
        if status == OK and diagonal_status(t, w, a, c, triangle) != OK:
            status = DOUBLED
    return status


@kernel
def _choose(
    t: Any, w: Any, p: Any, ring: Any, made: int, i: int, j: int, faults: Any, costs: Any, middles: Any
) -> None:
    """The third corner of the triangle on the diagonal from corner i to j of the ring: what is best on both sides."""
    apart()
    best, least, middle = _NEVER, 0.0, i + 1
    for k in range(i + 1, j):
        area = orientation(p, ring[i], ring[k], ring[j])
        faulty = faults[i, k] + faults[k, j] + (_CLOCKWISE if area < 0.0 else int(area == 0.0))
        cost = costs[i, k] + costs[k, j] + 1e6 * abs(area)
        if faulty < best or (faulty == best and cost < least):
            best, least, middle = faulty, cost, k
    if i > 0 or j < len(ring) - 1:
        status = diagonal_status(t, w, ring[i], ring[j], made)
        if status != OK:
            best += _LOOP if status == WOULD_BE_LOOP else _PARALLEL
        x, y = p[0, ring[i]] - p[0, ring[j]], p[1, ring[i]] - p[1, ring[j]]
        least += x * x + y * y
    faults[i, j], costs[i, j], middles[i, j] = best, least, middle


@kernel
def _cut_all(w: Any, ring: Any, middles: Any, triangle: int) -> None:
    """Cut along the chosen diagonals, the innermost intervals first: backwards through the order of their finding."""
    apart()
    found = 0
    low, high = np.empty(len(ring), np.int64), np.empty(len(ring), np.int64)
    low[0], high[0], found = 0, len(ring) - 1, 1
    at = 0
    while at < found:
        i, j = low[at], high[at]
        k = middles[i, j]
        if k - i > 1:
            low[found], high[found] = i, k
            found += 1
        if j - k > 1:
            low[found], high[found] = k, j
            found += 1
        at += 1
    for at in range(found - 1, 0, -1):
        cut(w, ring[middles[low[at], high[at]]], triangle)
        triangle += 1
