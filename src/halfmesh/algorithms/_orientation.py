"""On which side of a line a point lies, exactly: the one question that triangulation must not get wrong.

A float formula whose error is bounded answers nearly always; what is too close to tell is computed without rounding
(J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", Discrete &
Computational Geometry 18, 1997; the sum by the passes of T. Ogita, S. M. Rump, S. Oishi, "Accurate sum and dot
product", SIAM Journal on Scientific Computing 26, 2005).

`p` holds plane coordinates, x in row 0 and y in row 1, none larger than 2 and none so small that the product of two
vanishes: what :mod:`halfmesh.algorithms._plane` makes.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import apart, kernel

__all__ = ["orientation"]

_BOUND = 3.3306690738754716e-16  # 3 u + 16 u^2 for u = 2^-53: Shewchuk's bound of the formula's relative error
_SPLITTER = 134217729.0  # 2^27 + 1
_PASSES = 24  # of twelve numbers, each pass settles one at least


@kernel
def orientation(p: Any, a: int, b: int, c: int) -> float:
    """Twice the area of the triangle of three points: positive if they turn left. Its sign is exact, 0 included."""
    left = (p[0, a] - p[0, c]) * (p[1, b] - p[1, c])
    right = (p[1, a] - p[1, c]) * (p[0, b] - p[0, c])
    area = left - right
    size = abs(left) + abs(right)
    if abs(area) > _BOUND * size or size == 0.0:
        return area  # type: ignore[no-any-return]
    return _exact(p[0, a], p[1, a], p[0, b], p[1, b], p[0, c], p[1, c])


@kernel
def _exact(ax: float, ay: float, bx: float, by: float, cx: float, cy: float) -> float:
    """A number with the sign of the area, from the six products that it is the sum of, rounding errors included."""
    apart()
    terms = np.empty(12)
    for i, (x, y) in enumerate(((ax, by), (-ay, bx), (bx, cy), (-by, cx), (cx, ay), (-cy, ax))):
        product = x * y
        terms[i] = _error_of_product(x, y, product)
        terms[i + 6] = product
    for _ in range(_PASSES):
        rest = 0.0
        for i in range(1, 12):
            a, b = terms[i], terms[i - 1]
            total = a + b
            other = total - a
            terms[i - 1] = (a - (total - other)) + (b - other)
            terms[i] = total
            rest += abs(terms[i - 1])
        if abs(terms[11]) > 2.0 * rest or rest == 0.0:
            break
    return terms[11]  # type: ignore[no-any-return]


@kernel
def _error_of_product(x: float, y: float, product: float) -> float:
    """What rounding has taken from the product: Dekker's, each factor split into two halves of 26 bits."""
    s = _SPLITTER * x
    x_high = s - (s - x)
    x_low = x - x_high
    s = _SPLITTER * y
    y_high = s - (s - y)
    y_low = y - y_high
    return ((x_high * y_high - product) + x_high * y_low + x_low * y_high) + x_low * y_low
