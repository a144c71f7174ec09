"""From a face to its diagonals, and from the diagonals to the mesh: plan first, then act, so that a no costs nothing.

The plan is a list of triangles that know their neighbors. Its diagonals are flipped until all are locally Delaunay
(C. L. Lawson, "Software for C1 surface interpolation", Mathematical Software III, 1977), as far as the corners allow:
that is the constrained Delaunay triangulation of the face, which has no needless slivers.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, kernel
from halfmesh.algorithms._ears import FEW, clip_ears, cut, diagonal_status, first_state, paste
from halfmesh.algorithms._exhaustive import DOUBLED, cut_best
from halfmesh.algorithms._orientation import orientation
from halfmesh.algorithms._plane import CORNER, FLAGS, HALFEDGE, PLACE, QUEUE, SIDE, SPACE, lay_flat
from halfmesh.core.navigation import next_of
from halfmesh.core.operators.splits import connect
from halfmesh.core.statuses import OK, WOULD_BE_LOOP, WOULD_BE_PARALLEL

__all__ = ["draw", "plan"]

_TIES = 1e-12  # of two triangulations that are this much alike, that which is there stays
_FLIPS = 32  # for each corner: more than any face has needed; rounding errors must not go on for ever


@kernel
def plan(t: Any, points: Any, f: int, w: Any, p: Any, delaunay: bool, parallel: bool) -> int:
    """Cut a face of four corners or more into triangles, on paper: ``OK``, or why it can't be."""
    apart()
    apart()
    n = lay_flat(t, points, f, w, p)
    first_state(t, w, n)
    left = clip_ears(t, w, p, n, FEW, parallel)
    if left > FEW:
        return WOULD_BE_LOOP if parallel else WOULD_BE_PARALLEL
    if left == 3:
        cut(w, w[CORNER, n - 4], n - 3)
        left = 2
    if left > 3 or _has_faults(w, p, n):
        status = _improve(t, w, p, n, left, parallel)
        if status != OK:
            return status
        cut(w, w[CORNER, n - 4], n - 3)
    if delaunay:
        _flip_all(t, w, p, n)
    return OK


@kernel
def _improve(t: Any, w: Any, p: Any, n: int, left: int, parallel: bool) -> int:
    """Take back the last cuts, as many as can be searched through, and make the best ones in their place."""
    while left < min(n, FEW):
        paste(w, n - left - 1)
        left += 1
    status = cut_best(t, w, p, n, w[CORNER, n - left - 1] if left < n else 0, left)
    if parallel:
        return OK
    if status == DOUBLED:
        first_state(t, w, n)
        return OK if clip_ears(t, w, p, n, 3, False) == 3 else WOULD_BE_PARALLEL
    return status


@kernel
def _has_faults(w: Any, p: Any, n: int) -> bool:
    """Whether a triangle turns clockwise or has no area."""
    for triangle in range(n - 2):
        if orientation(p, w[CORNER, triangle], w[CORNER + 1, triangle], w[CORNER + 2, triangle]) <= 0.0:
            return True
    return False


# ---------------------------------------------------------------------------------------------------- better diagonals


@kernel
def _flip_all(t: Any, w: Any, p: Any, n: int) -> None:
    """Flip the diagonals that are not locally Delaunay, until there are none."""
    apart()
    waiting = n - 2
    for triangle in range(n - 2):
        w[QUEUE, triangle] = triangle
        w[FLAGS, triangle] |= _WAITS
    for _ in range(_FLIPS * n):
        if waiting == 0:
            break
        waiting -= 1
        triangle = w[QUEUE, waiting]
        w[FLAGS, triangle] &= ~_WAITS
        for k in range(3):
            side = w[SIDE + k, triangle]
            if side >= 0 and _should_flip(t, w, p, n, triangle, k, side):
                _flip(w, triangle, k, side)
                for changed in (triangle, side >> 2):
                    if w[FLAGS, changed] & _WAITS == 0:
                        w[FLAGS, changed] |= _WAITS
                        w[QUEUE, waiting] = changed
                        waiting += 1
                break


_WAITS = 64  # a flag of the triangle of this number


@kernel
def _should_flip(t: Any, w: Any, p: Any, n: int, triangle: int, k: int, side: int) -> bool:
    """Whether the angles that look at the diagonal are more than two right ones, and it may be flipped."""
    apart()
    u, v, r = w[CORNER + k, triangle], w[CORNER + (k + 1) % 3, triangle], w[CORNER + (k + 2) % 3, triangle]
    s = w[CORNER + ((side & 3) + 2) % 3, side >> 2]
    at_r, at_s = orientation(p, r, u, v), orientation(p, s, v, u)
    left, right = at_r * _cosine(p, s, u, v), at_s * _cosine(p, r, u, v)
    if left + right >= -_TIES * (abs(left) + abs(right)):
        return False
    if orientation(p, u, s, r) <= 0.0 or orientation(p, s, v, r) <= 0.0:
        return False
    return diagonal_status(t, w, r, s, n - 2) == OK


@kernel
def _cosine(p: Any, at: int, a: int, b: int) -> float:
    """The cosine of an angle in space, times the lengths of its sides."""
    total = 0.0
    for k in range(SPACE, SPACE + 3):
        total += (p[k, a] - p[k, at]) * (p[k, b] - p[k, at])
    return total


@kernel
def _flip(w: Any, left: int, k: int, side: int) -> None:
    r"""Turn the diagonal between two triangles, each of which gives up one corner.

    ::

             v                    v
           / | \                /   \
          r  |  s      -->     r --- s       left is (u, v, r) from its corner k, and becomes (u, s, r);
           \ | /                \   /        right is (v, u, s) from its corner j, and becomes (v, r, s)
             u                    u
    """
    apart()
    right, j = side >> 2, side & 3
    k1, j1 = (k + 1) % 3, (j + 1) % 3
    w[CORNER + k1, left], w[CORNER + j1, right] = w[CORNER + (j + 2) % 3, right], w[CORNER + (k + 2) % 3, left]
    beyond_left, beyond_right = w[SIDE + k1, left], w[SIDE + j1, right]
    _meet(w, left, k, beyond_right)
    _meet(w, right, j, beyond_left)
    _meet(w, left, k1, 4 * right + j1)


@kernel
def _meet(w: Any, triangle: int, k: int, side: int) -> None:
    """Let a side of a triangle, and what lies across it, know each other."""
    w[SIDE + k, triangle] = side
    if side >= 0:
        w[SIDE + (side & 3), side >> 2] = 4 * triangle + k


# -------------------------------------------------------------------------------------------------------- on the mesh


@kernel
def draw(t: Any, w: Any, n: int) -> None:
    """Connect the corners of the face as planned, a triangle at a time from the outside in, so that each costs O(1).

    The last one keeps the number of the face, and its first side.
    """
    apart()
    found = _queue_from_root(w, n)
    for at in range(found - 1, 0, -1):
        triangle = w[QUEUE, at]
        k = 0
        while w[SIDE + k, triangle] < 0:
            k += 1
        first, last = -1 - w[SIDE + (k + 1) % 3, triangle], -1 - w[SIDE + (k + 2) % 3, triangle]
        x = connect(t, next_of(t, last), first)
        side = w[SIDE + k, triangle]
        w[SIDE + (side & 3), side >> 2] = -1 - (x ^ 1)


@kernel
def _queue_from_root(w: Any, n: int) -> int:
    """The triangles, each after the one that it hangs on, from the one at the first side of the face."""
    apart()
    for triangle in range(n - 2):
        for k in range(3):
            if w[SIDE + k, triangle] == -1 - w[HALFEDGE, 0]:
                w[QUEUE, 0] = triangle
    at, found, before = 0, 1, -1
    while at < found:
        triangle = w[QUEUE, at]
        before = w[PLACE, at] if at > 0 else -1
        for k in range(3):
            side = w[SIDE + k, triangle]
            if side >= 0 and side >> 2 != before:
                w[QUEUE, found], w[PLACE, found] = side >> 2, triangle
                found += 1
        at += 1
    return found
