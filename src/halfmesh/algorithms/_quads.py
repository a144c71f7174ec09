"""Quadrilaterals: by far the most faces that are not triangles, and worth a short way of their own."""

from __future__ import annotations

import math
from typing import Any

from halfmesh._jit import kernel
from halfmesh.core.navigation import next_of, origin_of, prev_of
from halfmesh.core.operators.asking import is_joined
from halfmesh.geometry._vectors import cross, difference, dot, length, point

__all__ = ["corner_to_cut_at"]

_CLEAR = 1e-14  # rounding errors of an area, in that of the sides
_TIES = 1e-9  # of two diagonals that are as good as each other, the first corner's is taken: rows look alike


@kernel
def corner_to_cut_at(t: Any, points: Any, h: int, delaunay: bool) -> int:
    """The first of the corners of a quadrilateral, from that of `h`, whose diagonal is right: 0 or 1; -1 if unclear.

    A diagonal is right if both triangles turn counter-clockwise; if both are, the one that sees the smaller angles is
    taken, which is Delaunay's in the plane. If what is right is joined already, or rounding errors might decide, the
    general method has to look.
    """
    h2 = next_of(t, next_of(t, h))
    a, b, c, d = origin_of(t, h), origin_of(t, next_of(t, h)), origin_of(t, h2), origin_of(t, prev_of(t, h))
    pa, pb, pc, pd = point(points, a), point(points, b), point(points, c), point(points, d)
    ab, bc, cd, da = difference(pb, pa), difference(pc, pb), difference(pd, pc), difference(pa, pd)
    normal = cross(difference(pc, pa), difference(pd, pb))
    clear = _CLEAR * length(normal) * (dot(ab, ab) + dot(bc, bc) + dot(cd, cd) + dot(da, da))
    at_a, at_b = dot(normal, cross(da, ab)), dot(normal, cross(ab, bc))
    at_c, at_d = dot(normal, cross(bc, cd)), dot(normal, cross(cd, da))
    is_ac = at_b > clear and at_d > clear and at_b < math.inf and at_d < math.inf
    is_bd = at_a > clear and at_c > clear and at_a < math.inf and at_c < math.inf
    if is_ac and is_bd and delaunay:
        along_ac, along_bd = -dot(ab, bc) / at_b - dot(cd, da) / at_d, -dot(da, ab) / at_a - dot(bc, cd) / at_c
        prefers_ac = along_ac >= along_bd - _TIES * (abs(along_ac) + abs(along_bd))
    else:
        prefers_ac = is_ac
    if prefers_ac and is_ac and a != c and not is_joined(t, h, c):
        return 0
    if is_bd and b != d and not is_joined(t, next_of(t, h), d):
        return 1
    if is_ac and a != c and not is_joined(t, h, c):
        return 0
    return -1
