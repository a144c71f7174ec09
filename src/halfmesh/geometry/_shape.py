"""One polygon on paper: its corners in a plane, how they turn, and from where all of it is seen.

Work arrays of a loop: `p` (2, k) the corners in the plane; `q`, `r` (2, k + 4) a convex polygon and what is left of it.
"""

from __future__ import annotations

import math
from typing import Any

from halfmesh._jit import kernel
from halfmesh.core.navigation import halfedge_of_face, next_of, origin_of, prev_of, twin_of
from halfmesh.geometry._vectors import Vector, difference, dot, length, point
from halfmesh.geometry.kernels import angle_from, face_normal

__all__ = ["COLUMNS", "shape_of"]

COLUMNS = ("min_angle", "max_angle", "edge_ratio", "area_perimeter_ratio", "kernel_ratio", "convex")
MIN_ANGLE, MAX_ANGLE, EDGE_RATIO, AREA_PERIMETER_RATIO, KERNEL_RATIO, CONVEX = 0, 1, 2, 3, 4, 5

_STRAIGHT = 1e-12  # a sine: a corner that turns less than that is straight
_NOTHING = 1e-12  # of the area: less is rounding errors


@kernel
def shape_of(t: Any, points: Any, f: int, p: Any, q: Any, r: Any, out: Any) -> None:
    """Write the measures of face `f` to row `f` of `out`; all 0 if it has no area."""
    n = _drawn(t, points, f, p)
    if n == 0:
        return
    area = 0.5 * _twice_area(p, n)
    perimeter, shortest, longest = 0.0, math.inf, 0.0
    low, high, total = math.inf, 0.0, 0.0
    turns_left = True
    h = halfedge_of_face(t, f)
    for i in range(n):
        after, before = (i + 1) % n, (i + n - 1) % n
        ax, ay = p[0, after] - p[0, i], p[1, after] - p[1, i]
        bx, by = p[0, before] - p[0, i], p[1, before] - p[1, i]
        side = math.sqrt(ax * ax + ay * ay)
        perimeter, shortest, longest = perimeter + side, min(shortest, side), max(longest, side)
        sine = ax * by - ay * bx
        angle = 2.0 * math.pi if prev_of(t, h) == twin_of(t, h) else angle_from(sine, ax * bx + ay * by)
        low, high, total = min(low, angle), max(high, angle), total + angle
        turns_left = turns_left and sine >= -_STRAIGHT * side * math.sqrt(bx * bx + by * by)
        h = next_of(t, h)
    if not area > _NOTHING * perimeter * perimeter:
        return
    is_convex = turns_left and abs(total - (n - 2) * math.pi) < 1.0  # else it turns around more than once
    out[f, MIN_ANGLE], out[f, MAX_ANGLE] = low, high
    out[f, EDGE_RATIO] = shortest / longest
    out[f, AREA_PERIMETER_RATIO] = 4.0 * math.pi * area / (perimeter * perimeter)
    out[f, CONVEX] = 1.0 if is_convex else 0.0
    ratio = 1.0 if is_convex else _kernel_area(p, n, q, r) / area
    out[f, KERNEL_RATIO] = min(ratio, 1.0) if ratio > _NOTHING else 0.0


@kernel
def _drawn(t: Any, points: Any, f: int, p: Any) -> int:
    """Draw the face on the plane of its normal, the first corner at the origin, its size about 1.

    How many corners it has is returned, 0 if they all lie in one place.
    """
    x_axis, y_axis = _axes(face_normal(t, points, f))
    first = halfedge_of_face(t, f)
    corner = point(points, origin_of(t, first))
    n, size, h = 0, 0.0, first
    while n == 0 or h != first:
        offset = difference(point(points, origin_of(t, h)), corner)
        p[0, n], p[1, n] = dot(offset, x_axis), dot(offset, y_axis)
        size = max(size, length(offset))
        h = next_of(t, h)
        n += 1
    if size == 0.0:
        return 0
    for i in range(n):
        p[0, i], p[1, i] = p[0, i] / size, p[1, i] / size
    return n


@kernel
def _axes(normal: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors perpendicular to the normal; x and y themselves if it is z.

    T. Duff and others, "Building an orthonormal basis, revisited", Journal of Computer Graphics Techniques 6, 2017.
    """
    x, y, z = normal
    sign = math.copysign(1.0, z)
    a = -1.0 / (sign + z)
    b = x * y * a
    return (1.0 + sign * x * x * a, sign * b, -sign * x), (b, sign + y * y * a, -y)


@kernel
def _twice_area(p: Any, n: int) -> float:
    twice = 0.0
    for i in range(1, n - 1):
        ax, ay = p[0, i] - p[0, 0], p[1, i] - p[1, 0]
        twice += ax * (p[1, i + 1] - p[1, 0]) - ay * (p[0, i + 1] - p[0, 0])
    return twice


@kernel
def _kernel_area(p: Any, n: int, q: Any, r: Any) -> float:
    """The area from where the whole polygon is seen: a square around it, cut off along every side.

    O(n m), where m is the number of corners of what is left at the largest.
    """
    m = 0
    for x, y in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)):
        q[0, m], q[1, m] = 1.5 * x, 1.5 * y
        m += 1
    for i in range(n):
        m = _cut(p, i, (i + 1) % n, q, m, r)
        if m < 3:
            return 0.0
        for k in range(m):
            q[0, k], q[1, k] = r[0, k], r[1, k]
    return 0.5 * _twice_area(q, m)


@kernel
def _cut(p: Any, i: int, j: int, q: Any, m: int, r: Any) -> int:
    """What is left of a convex polygon of `m` corners on the left of the line from corner `i` to corner `j`.

    I. E. Sutherland, G. W. Hodgman, "Reentrant polygon clipping", Communications of the ACM 17, 1974.
    """
    dx, dy = p[0, j] - p[0, i], p[1, j] - p[1, i]
    count = 0
    last = dx * (q[1, m - 1] - p[1, i]) - dy * (q[0, m - 1] - p[0, i])
    for k in range(m):
        here = dx * (q[1, k] - p[1, i]) - dy * (q[0, k] - p[0, i])
        if (last < 0.0) != (here < 0.0):
            before = k - 1 if k > 0 else m - 1
            s = last / (last - here)
            r[0, count] = q[0, before] + s * (q[0, k] - q[0, before])
            r[1, count] = q[1, before] + s * (q[1, k] - q[1, before])
            count += 1
        if here >= 0.0:
            r[0, count], r[1, count] = q[0, k], q[1, k]
            count += 1
        last = here
    return count
