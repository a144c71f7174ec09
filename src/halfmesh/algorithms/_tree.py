"""Finding corners inside a triangle: a balanced tree over the corners of a face (J. L. Bentley's k-d tree, 1975).

Row TREE of `w` holds the corners so that in each range the middle one parts it by x, its halves by y, and so on; a
range of a few is searched from end to end. Of the corners only some are *listed*; COUNT, at the middle of each range,
says how many are. All else follows from the bounds of the range, so that there is nothing to store.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, kernel
from halfmesh.algorithms._plane import BOX, COUNT, PLACE, STACK, TREE

__all__ = ["LEAF", "enlist", "is_outside", "part", "plant"]

LEAF = 8  # corners; fewer are quicker searched than parted

_MARGIN = 1e-15  # the rounding errors of a sum of two products


@kernel
def plant(w: Any, p: Any, n: int) -> None:
    """Part the corners again and again; none is listed yet."""
    apart()
    for i in range(n):
        w[TREE, i] = i
        w[COUNT, i] = 0
    w[STACK, 0], w[STACK + 1, 0], w[STACK + 2, 0] = 0, n, 0
    top = 1
    while top > 0:
        top -= 1
        low, high, axis = w[STACK, top], w[STACK + 1, top], w[STACK + 2, top]
        if high - low <= LEAF:
            continue
        middle = (low + high) // 2
        _part(w, p, axis, low, high - 1, middle)
        for start, end in ((low, middle), (middle + 1, high)):
            w[STACK, top], w[STACK + 1, top], w[STACK + 2, top] = start, end, 1 - axis
            top += 1
    for i in range(n):
        w[PLACE, w[TREE, i]] = i


@kernel
def _part(w: Any, p: Any, axis: int, low: int, high: int, middle: int) -> None:
    """Have no larger coordinate before the middle place, and no smaller one behind it (C. A. R. Hoare's FIND, 1961)."""
    while low < high:
        pivot = p[axis, w[TREE, middle]]
        i, j = low, high
        while i <= j:
            while p[axis, w[TREE, i]] < pivot:
                i += 1
            while p[axis, w[TREE, j]] > pivot:
                j -= 1
            if i <= j:
                w[TREE, i], w[TREE, j] = w[TREE, j], w[TREE, i]
                i += 1
                j -= 1
        if j < middle:
            low = i
        if i > middle:
            high = j


@kernel
def enlist(w: Any, n: int, corner: int, by: int) -> None:
    """List a corner (1), or take it off the list (-1)."""
    place, low, high = w[PLACE, corner], 0, n
    while low < high:
        middle = (low + high) // 2
        w[COUNT, middle] += by
        if high - low <= LEAF or place == middle:
            return
        if place < middle:
            high = middle
        else:
            low = middle + 1


@kernel
def is_outside(p: Any, a: int, b: int, c: int, box: int) -> bool:
    """Whether all of a box on the stack lies beyond a side of a triangle, or of the upright box around that."""
    apart()
    for x in range(2):
        low, high = p[BOX + x, box], p[BOX + 2 + x, box]
        if p[x, a] < low and p[x, b] < low and p[x, c] < low:
            return True
        if p[x, a] > high and p[x, b] > high and p[x, c] > high:
            return True
    for _ in range(3):
        ux, uy = p[0, b] - p[0, a], p[1, b] - p[1, a]
        left = ux * ((p[BOX + 3, box] if ux > 0.0 else p[BOX + 1, box]) - p[1, a])
        right = uy * ((p[BOX, box] if uy > 0.0 else p[BOX + 2, box]) - p[0, a])
        if left - right < -_MARGIN * (abs(left) + abs(right)):
            return True
        a, b, c = b, c, a
    return False


@kernel
def part(w: Any, p: Any, a: int, b: int, c: int, top: int) -> None:
    """Put the two halves of the range at the top of the stack in its place, and the one to be searched first on top.

    That is where the center of the triangle lies: if there is anything inside, it is found soonest.
    """
    low, high, axis = w[STACK, top], w[STACK + 1, top], w[STACK + 2, top]
    middle = (low + high) // 2
    border = p[axis, w[TREE, middle]]
    is_low = p[axis, a] + p[axis, b] + p[axis, c] > 3.0 * border
    for k in range(4):
        p[BOX + k, top + 1] = p[BOX + k, top]
    for at in range(top, top + 2):
        w[STACK, at], w[STACK + 1, at], w[STACK + 2, at] = middle + 1, high, 1 - axis
        if is_low:
            w[STACK, at], w[STACK + 1, at] = low, middle
        p[axis + (BOX + 2 if is_low else BOX), at] = border
        is_low = not is_low
