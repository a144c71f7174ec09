"""Three numbers as a vector: the few words that the formulas of this room are written in.

A vector is a tuple of three floats; compiled, that costs nothing against writing the components out.
"""

from __future__ import annotations

import math
from typing import Any

from halfmesh._jit import kernel

__all__ = ["Vector", "cross", "difference", "dot", "length", "plus", "point", "scaled", "unit"]

Vector = tuple[float, float, float]


@kernel
def point(points: Any, v: int) -> Vector:
    """The position of vertex `v`."""
    return points[v, 0], points[v, 1], points[v, 2]


@kernel
def difference(a: Vector, b: Vector) -> Vector:
    """From `b` to `a`."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@kernel
def plus(a: Vector, b: Vector) -> Vector:
    """The sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@kernel
def scaled(a: Vector, factor: float) -> Vector:
    """The vector `factor` times as long."""
    return factor * a[0], factor * a[1], factor * a[2]


@kernel
def dot(a: Vector, b: Vector) -> float:
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@kernel
def cross(a: Vector, b: Vector) -> Vector:
    """The vector product: perpendicular to both, as long as their parallelogram is large."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@kernel
def length(a: Vector) -> float:
    """The length of a vector, right even where its square would overflow or vanish."""
    square = dot(a, a)
    if 1e-280 < square < 1e300:
        return math.sqrt(square)
    largest = max(abs(a[0]), abs(a[1]), abs(a[2]))
    if largest == 0.0:
        return 0.0
    x, y, z = a[0] / largest, a[1] / largest, a[2] / largest
    return largest * math.sqrt(x * x + y * y + z * z)


@kernel
def unit(a: Vector) -> Vector:
    """The vector of length 1 in the same direction; zero stays zero."""
    size = length(a)
    if size == 0.0:
        return 0.0, 0.0, 0.0
    return a[0] / size, a[1] / size, a[2] / size
