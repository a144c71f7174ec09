"""The kernel of a polygon: the points inside from which all of it can be seen.

It is the intersection of the half-planes to the left of the sides: a convex polygon off which every side cuts a piece.
Polygons are two columns of coordinates here, counter-clockwise.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel

__all__ = ["area_inside", "area_seeing_all"]


@kernel
def area_seeing_all(x: Any, y: Any, n: int, ax: Any, ay: Any, bx: Any, by: Any) -> float:
    """The area of the kernel of a polygon of `n` sides; `ax` to `by` are room for n + 4 corners each."""
    m = _box(x, y, n, ax, ay)
    i = n - 1
    for j in range(n):
        dx, dy = x[j] - x[i], y[j] - y[i]
        if dx != 0.0 or dy != 0.0:
            m = _cut(x[i], y[i], dx, dy, ax, ay, m, bx, by)
            if m < 3:
                return 0.0
            ax, ay, bx, by = bx, by, ax, ay
        i = j
    return area_inside(ax, ay, m)


@kernel
def _box(x: Any, y: Any, n: int, ax: Any, ay: Any) -> int:
    """Write the corners of the bounding box."""
    left = right = x[0]
    bottom = top = y[0]
    for i in range(1, n):
        left, right = min(left, x[i]), max(right, x[i])
        bottom, top = min(bottom, y[i]), max(top, y[i])
    ax[0], ay[0] = left, bottom
    ax[1], ay[1] = right, bottom
    ax[2], ay[2] = right, top
    ax[3], ay[3] = left, top
    return 4


@kernel
def _cut(px: float, py: float, dx: float, dy: float, ax: Any, ay: Any, m: int, bx: Any, by: Any) -> int:
    """Write what a convex polygon has to the left of a line through (px, py) along (dx, dy), up to m + 1 corners."""
    n = 0
    i = m - 1
    before = dx * (ay[i] - py) - dy * (ax[i] - px)
    for j in range(m):
        here = dx * (ay[j] - py) - dy * (ax[j] - px)
        if (before > 0.0 and here < 0.0) or (before < 0.0 and here > 0.0):
            part = before / (before - here)
            bx[n], by[n] = ax[i] + part * (ax[j] - ax[i]), ay[i] + part * (ay[j] - ay[i])
            n += 1
        if here >= 0.0:
            bx[n], by[n] = ax[j], ay[j]
            n += 1
        i, before = j, here
    return n


@kernel
def area_inside(x: Any, y: Any, n: int) -> float:
    """The area of a polygon of `n` sides, from its first corner."""
    twice = 0.0
    for i in range(1, n - 1):
        ax, ay, bx, by = x[i] - x[0], y[i] - y[0], x[i + 1] - x[0], y[i + 1] - y[0]
        twice += ax * by - ay * bx
    return 0.5 * twice
