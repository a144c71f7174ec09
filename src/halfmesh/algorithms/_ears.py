"""Ear clipping: the corners of a face are cut off one by one, each with the triangle it makes with its neighbors.

A corner may go where its triangle contains no other corner (G. H. Meisters, "Polygons have ears", American
Mathematical Monthly 82, 1975). Only corners that are not convex need be looked at, and a grid finds those nearby
(M. Held, "FIST: fast industrial-strength triangulation of polygons", Algorithmica 30, 2001). Corners are tried in
turn, and the neighbors of one that was cut wait for the next round: triangles stay stout, and each costs little.

Where a polygon touches itself, or has corners twice at the same place, good ears may run out. Of what is small enough
:mod:`halfmesh.algorithms._exhaustive` then looks at all triangulations; of what is not, less good ears are taken, by
`STRICT` ... `FORCED`.

Whichever way it was found, a triangulation none of whose triangles turns clockwise is right: a map of a disk to the
plane that turns nothing over and follows the polygon along its rim covers every point as often as the polygon does.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import apart, kernel
from halfmesh.algorithms._orientation import orientation
from halfmesh.algorithms._plane import (
    ACROSS,
    AFTER,
    BEFORE,
    BOX,
    CORNER,
    COUNT,
    FLAGS,
    HALFEDGE,
    QUEUE,
    SIDE,
    STACK,
    TREE,
)
from halfmesh.algorithms._tree import LEAF, enlist, is_outside, part, plant
from halfmesh.core.navigation import origin_of
from halfmesh.core.operators.asking import is_joined
from halfmesh.core.statuses import OK, WOULD_BE_LOOP, WOULD_BE_PARALLEL

__all__ = ["FEW", "clip_ears", "cut", "diagonal_status", "first_state", "paste"]

FEW = 64  # corners; so many may be left to the search through all triangulations, which takes their cube

STRICT, TOUCHING, STRAIGHT, SPIKES, FORCED = range(5)  # what passes for an ear:
#   STRICT    the area is beyond rounding errors, and no other corner lies in it or on its rim
#   TOUCHING  others may touch the rim
#   STRAIGHT  corners on a straight line too
#   SPIKES    corners where the polygon turns back on itself too
#   FORCED    any corner: the polygon crosses itself

REFLEX, QUEUED, LATER, REPEATED, GONE = 1, 2, 4, 8, 16  # flags of a corner

_THIN = 1e-15  # rounding errors of projection, in areas of triangles with sides of length 1


@kernel
def first_state(t: Any, w: Any, n: int) -> None:
    """All corners in their ring, each side with its halfedge across; those of the same vertex are marked."""
    apart()
    for i in range(n):
        w[AFTER, i] = i + 1 if i + 1 < n else 0
        w[BEFORE, i] = i - 1 if i > 0 else n - 1
        w[ACROSS, i] = -1 - w[HALFEDGE, i]
        w[FLAGS, i] = 0
        w[CORNER, i] = w[CORNER + 1, i] = -1
    for i in range(n):  # a hash table of 2 n places in two rows that are not needed yet
        v = origin_of(t, w[HALFEDGE, i])
        place = (v * 40503) % (2 * n)
        while True:
            j = w[CORNER + (place & 1), place >> 1]
            if j < 0:
                w[CORNER + (place & 1), place >> 1] = i
                break
            if origin_of(t, w[HALFEDGE, j]) == v:
                w[FLAGS, i] |= REPEATED
                w[FLAGS, j] |= REPEATED
                break
            place = place + 1 if place + 1 < 2 * n else 0


@kernel
def clip_ears(t: Any, w: Any, p: Any, n: int, few: int, parallel: bool) -> int:
    """Cut ears until three corners are left, or no more than `few` and no good ear; how many is returned.

    A diagonal never joins what is joined already, unless `parallel` allows it and the polygon crosses itself.
    """
    apart()
    plant(w, p, n)
    for i in range(n):
        _judge(w, p, n, i)
    left, head, waiting, level, cuts, patience, forced = n, 0, 0, STRICT, 1, 1, 0
    while left > 3:
        if waiting == 0:
            level = STRICT if cuts > 0 else level + 1
            if level > FORCED or (level > STRICT and left <= few):
                break
            head, waiting, cuts, forced = 0, _queue_all(w, n), 0, 0
        b = w[QUEUE, head]
        head = head + 1 if head + 1 < n else 0
        waiting -= 1
        if w[FLAGS, b] & LATER:
            w[FLAGS, b] ^= LATER
            waiting = _queue(w, n, head, waiting, b)
            continue
        w[FLAGS, b] &= ~QUEUED
        a, c = w[BEFORE, b], w[AFTER, b]
        if not _is_ear(w, p, n, a, b, c, level):
            continue
        status = diagonal_status(t, w, a, c, n - left)
        if status != OK and not (parallel and level == FORCED and status == WOULD_BE_PARALLEL):
            continue
        cut(w, b, n - left)
        w[FLAGS, b] |= GONE
        if w[FLAGS, b] & REFLEX:
            w[FLAGS, b] ^= REFLEX
            enlist(w, n, b, -1)
        left -= 1
        cuts += 1
        for x in (a, c):
            _judge(w, p, n, x)
            if w[FLAGS, x] & QUEUED:
                w[FLAGS, x] |= LATER
            else:
                w[FLAGS, x] |= QUEUED
                waiting = _queue(w, n, head, waiting, x)
        if level > STRICT:  # better ears may have come free; but asking all again each time would be quadratic
            forced += 1
            if forced >= patience:
                patience *= 2
                level = STRICT
                head, waiting, cuts, forced = 0, _queue_all(w, n), 0, 0
    return left


@kernel
def _queue(w: Any, n: int, head: int, waiting: int, b: int) -> int:
    """Append a corner to the queue; how many wait there now is returned."""
    place = head + waiting
    w[QUEUE, place if place < n else place - n] = b
    return waiting + 1


@kernel
def _queue_all(w: Any, n: int) -> int:
    waiting = 0
    for i in range(n):
        if w[FLAGS, i] & GONE == 0:
            w[FLAGS, i] = (w[FLAGS, i] | QUEUED) & ~LATER
            w[QUEUE, waiting] = i
            waiting += 1
    return waiting


# ------------------------------------------------------------------------------------------------------------- an ear


@kernel
def _is_ear(w: Any, p: Any, n: int, a: int, b: int, c: int, level: int) -> bool:
    apart()
    area = orientation(p, a, b, c)
    ux, uy, vx, vy = p[0, b] - p[0, a], p[1, b] - p[1, a], p[0, c] - p[0, b], p[1, c] - p[1, b]
    if level == STRICT:
        return area > _THIN * (abs(ux) + abs(uy) + abs(vx) + abs(vy)) and not _is_blocked(w, p, n, a, b, c, True)
    if area > 0.0:
        return level == FORCED or not _is_blocked(w, p, n, a, b, c, False)
    if area == 0.0:
        return level > STRAIGHT or (level == STRAIGHT and ux * vx + uy * vy >= 0.0)
    return level == FORCED


@kernel
def _is_blocked(w: Any, p: Any, n: int, a: int, b: int, c: int, strict: bool) -> bool:
    """Whether a corner that is not convex is in the way, inside the triangle or on its rim."""
    apart()
    w[STACK, 0], w[STACK + 1, 0], w[STACK + 2, 0] = 0, n, 0
    for k in range(4):
        p[BOX + k, 0] = -4.0 if k < 2 else 4.0
    left, right = min(p[0, a], p[0, b], p[0, c]), max(p[0, a], p[0, b], p[0, c])
    lower, upper = min(p[1, a], p[1, b], p[1, c]), max(p[1, a], p[1, b], p[1, c])
    top = 1
    while top > 0:
        top -= 1
        low, high = w[STACK, top], w[STACK + 1, top]
        middle = (low + high) // 2
        if w[COUNT, middle] == 0 or is_outside(p, a, b, c, top):
            continue
        is_leaf = high - low <= LEAF
        for at in range(low if is_leaf else middle, high if is_leaf else middle + 1):
            q = w[TREE, at]
            if (
                w[FLAGS, q] & REFLEX != 0
                and left <= p[0, q] <= right
                and lower <= p[1, q] <= upper
                and _is_in_the_way(w, p, a, b, c, q, strict)
            ):
                return True
        if not is_leaf:
            part(w, p, a, b, c, top)
            top += 2
    return False


@kernel
def _is_in_the_way(w: Any, p: Any, a: int, b: int, c: int, q: int, strict: bool) -> bool:
    """Whether corner `q` is in the way of a triangle.

    It is if it lies inside; or on the rim and the polygon goes inside from there, or along the diagonal with its inner
    side towards the triangle. Strictly, all of the rim is in the way but the places where the diagonal ends: there
    bridges to holes have other corners.
    """
    apart()
    if q in (a, b, c):
        return False
    at_ab = orientation(p, a, b, q)
    if at_ab < 0.0:
        return False
    at_bc = orientation(p, b, c, q)
    if at_bc < 0.0:
        return False
    at_ca = orientation(p, c, a, q)
    if at_ca < 0.0:
        return False
    if strict and not _is_same_place(p, a, q) and not _is_same_place(p, c, q):
        return True
    for row in (BEFORE, AFTER):
        x = w[row, q]
        off_ab, off_bc, off_ca = orientation(p, a, b, x), orientation(p, b, c, x), orientation(p, c, a, x)
        if (at_ab > 0.0 or off_ab > 0.0) and (at_bc > 0.0 or off_bc > 0.0) and (at_ca > 0.0 or off_ca > 0.0):
            return True
        if at_ca == 0.0 and off_ca == 0.0:  # along the diagonal: is the triangle on the inner side?
            along = (p[0, x] - p[0, q]) * (p[0, a] - p[0, c]) + (p[1, x] - p[1, q]) * (p[1, a] - p[1, c])
            if along != 0.0 and (along > 0.0) == (row == AFTER):
                return True
    return False


@kernel
def _is_same_place(p: Any, a: int, b: int) -> bool:
    return p[0, a] == p[0, b] and p[1, a] == p[1, b]  # type: ignore[no-any-return]


@kernel
def diagonal_status(t: Any, w: Any, a: int, c: int, made: int) -> int:
    """Whether the vertices of two corners may be joined: not by the mesh yet, nor by one of the triangles made so far.

    The latter may only be where the face passes one of the two vertices more than once.
    """
    apart()
    u, v = origin_of(t, w[HALFEDGE, a]), origin_of(t, w[HALFEDGE, c])
    if u == v:
        return WOULD_BE_LOOP
    if is_joined(t, w[HALFEDGE, a], v):
        return WOULD_BE_PARALLEL
    if (w[FLAGS, a] | w[FLAGS, c]) & REPEATED:
        for triangle in range(made):
            x = origin_of(t, w[HALFEDGE, w[CORNER + 2, triangle]])
            for k in range(3):
                y = origin_of(t, w[HALFEDGE, w[CORNER + k, triangle]])
                if (x == u and y == v) or (x == v and y == u):
                    return WOULD_BE_PARALLEL
                x = y
    return OK


# -------------------------------------------------------------------------------------------------------- the surgery


@kernel
def cut(w: Any, b: int, triangle: int) -> None:
    """Take corner `b` out of the ring, with its two sides; the diagonal is the side that is left."""
    apart()
    a, c = w[BEFORE, b], w[AFTER, b]
    corners, sides = (a, b, c), (w[ACROSS, a], w[ACROSS, b], w[ACROSS, c])
    for k in range(3):
        w[CORNER + k, triangle] = corners[k]
    for k in range(2 if w[AFTER, c] != a else 3):  # the last triangle has no diagonal
        w[SIDE + k, triangle] = sides[k]
        if sides[k] >= 0:
            w[SIDE + (sides[k] & 3), sides[k] >> 2] = 4 * triangle + k
    w[ACROSS, a] = 4 * triangle + 2
    w[AFTER, a], w[BEFORE, c] = c, a


@kernel
def paste(w: Any, triangle: int) -> None:
    """Undo a cut, the last one first."""
    a, b, c = w[CORNER, triangle], w[CORNER + 1, triangle], w[CORNER + 2, triangle]
    w[ACROSS, a] = w[SIDE, triangle]
    w[AFTER, a], w[BEFORE, c] = b, b


# ----------------------------------------------------------------------------------------- corners that are not convex


@kernel
def _judge(w: Any, p: Any, n: int, i: int) -> None:
    """Whether a corner of the ring is convex; if not, it may be in the way of others, and is listed."""
    apart()
    is_reflex = orientation(p, w[BEFORE, i], i, w[AFTER, i]) <= 0.0
    if is_reflex != (w[FLAGS, i] & REFLEX != 0):
        w[FLAGS, i] ^= REFLEX
        enlist(w, n, i, 1 if is_reflex else -1)
