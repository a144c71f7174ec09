"""A face on paper: its corners one after the other, and their shadows on a coordinate plane.

The work arrays of this room have a column for each corner of the face: `w` (int64) the rows named below, `p`
(float64) the plane coordinates. They may be wider than the face.
"""

from __future__ import annotations

import math
from typing import Any

from halfmesh._jit import apart, kernel
from halfmesh.core.navigation import halfedge_of_face, next_of, origin_of
from halfmesh.geometry._vectors import Vector, cross, difference, dot, length, plus, point, scaled, unit

__all__ = ["N_FLOAT_ROWS", "N_ROWS", "lay_flat"]

HALFEDGE = 0  # of the corner, in the mesh
AFTER, BEFORE = 1, 2  # the corners that are left, as a ring
ACROSS = 3  # what lies across the side from this corner to the one after it, as in SIDE
FLAGS = 4
QUEUE = 5
TREE, PLACE, COUNT = 6, 7, 8  # see :mod:`halfmesh.algorithms._tree`
STACK = 9  # and 10, 11
CORNER = 12  # and 13, 14: the three corners of each triangle
SIDE = 15  # and 16, 17: what lies across its side from corner k to k + 1: ``4 * triangle + k``, or ``-1 - halfedge``
N_ROWS = 18  # of w
BOX = 2  # row of p, and 3, 4, 5: low x and y, high x and y of the ranges on the stack
SPACE = 6  # row of p, and 7, 8: the corner in space
N_FLOAT_ROWS = 9  # of p, with x and y

_NOTHING = 1e-12  # of the size of a face: what is so much smaller is rounding errors


@kernel
def lay_flat(t: Any, points: Any, f: int, w: Any, p: Any) -> int:
    """Gather the corners of a face; their number is returned.

    Of a flat face one coordinate is left out, that in which its shadow is largest: that loses no bit, so corners that
    meet or lie on a line still do so, in any plane. Of other faces the shadow is cast along the normal. Coordinates
    are divided by a power of two, which is exact, so that products neither overflow nor vanish. A corner that lies
    nowhere (NaN) is put at the origin.
    """
    apart()
    start = halfedge_of_face(t, f)
    n, h, largest = 0, start, 0.0
    while n == 0 or h != start:
        w[HALFEDGE, n] = h
        for x in point(points, origin_of(t, h)):
            if abs(x) > largest and abs(x) < math.inf:
                largest = abs(x)
        n += 1
        h = next_of(t, h)
    scale = math.ldexp(1.0, max(-1022, min(1022, -math.frexp(largest)[1])))
    for i in range(n):
        place = scaled(point(points, origin_of(t, w[HALFEDGE, i])), scale)
        if not length(place) < 4.0:  # which NaN is not
            place = (0.0, 0.0, 0.0)
        for k in range(3):
            p[SPACE + k, i] = place[k]
    _project(p, n, _normal(p, n))
    return n


@kernel
def _project(p: Any, n: int, normal: Vector) -> None:
    apart()
    z = 2
    for k in range(2):
        if abs(normal[k]) > abs(normal[z]):
            z = k
    x, y = (z + 1) % 3, (z + 2) % 3
    if normal[z] < 0.0:
        x, y = y, x
    height, size = 0.0, 0.0
    for i in range(n):
        offset = difference(_place(p, i), _place(p, 0))
        height, size = max(height, abs(dot(offset, normal))), max(size, length(offset))
    is_flat = height <= _NOTHING * size
    slope_x, slope_y = normal[x] / normal[z], normal[y] / normal[z]
    for i in range(n):
        p[0, i], p[1, i] = p[SPACE + x, i], p[SPACE + y, i]
        if not is_flat:
            above = p[SPACE + z, i] - p[SPACE + z, 0]
            p[0, i] -= above * slope_x
            p[1, i] -= above * slope_y


@kernel
def _place(p: Any, i: int) -> Vector:
    return p[SPACE, i], p[SPACE + 1, i], p[SPACE + 2, i]


@kernel
def _normal(p: Any, n: int) -> Vector:
    """Newell's; that of a face whose area cancels (a figure of eight) is the normal of its parts, one way round."""
    apart()
    last = difference(_place(p, 1), _place(p, 0))
    total, parts = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for i in range(2, n):
        here = difference(_place(p, i), _place(p, 0))
        part = cross(last, here)
        total = plus(total, part)
        parts = plus(parts, scaled(part, -1.0 if dot(parts, part) < 0.0 else 1.0))
        last = here
    normal = unit(total if length(total) > _NOTHING * length(parts) else parts)
    return normal if dot(normal, normal) > 0.5 else (0.0, 0.0, 1.0)
