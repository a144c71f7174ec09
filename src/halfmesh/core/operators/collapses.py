"""Contracting an edge: its origin goes, its target stays."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    halfedge_of_vertex,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.operators.asking import halfedge_status, is_face_triangle, is_joined, is_triangle, touches_gap
from halfmesh.core.operators.gaps import close_between
from halfmesh.core.operators.vertices import contract, note_contraction
from halfmesh.core.pens import changed, set_halfedge_of_vertex
from halfmesh.core.slots import delete_face
from halfmesh.core.statuses import (
    LOOP_EDGE,
    OK,
    SHARED_APEX,
    SMALL_FACE,
    WOULD_BE_PARALLEL,
    WOULD_CLOSE_HOLE,
    WOULD_FOLD,
    WOULD_LEAVE_WIRE,
    WOULD_PINCH,
    WOULD_PINCH_FACE,
)

__all__ = ["collapse", "collapse_status", "try_collapse"]


# -- may it? -------------------------------------------------------------------------------------------------------


@operation
def collapse_status(t: Any, h: int) -> int:
    """Whether `h` may be contracted: ``OK`` or a code.

    The link condition, for polygons and at boundaries: what the two ends have in common must be what the edge has.
    Cost: the sum of the degrees around the origin, times the degree of the target at worst.
    """
    o = h ^ 1
    a, b = origin_of(t, h), origin_of(t, o)
    if a == b:
        return LOOP_EDGE
    for side in range(2):
        status = _side_status(t, h ^ side)
        if status != OK:
            return status
    left, right = is_face_triangle(t, h), is_face_triangle(t, o)
    if left and right and target_of(t, next_of(t, h)) == target_of(t, next_of(t, o)):
        return SHARED_APEX
    if face_of(t, h) >= 0 and face_of(t, o) >= 0 and touches_gap(t, a) and touches_gap(t, b):
        return WOULD_PINCH
    p_out = prev_of(t, h) ^ 1
    asked = not (left and origin_of(t, prev_of(t, h)) in (a, b)) and not (
        right and target_of(t, next_of(t, o)) in (a, b)
    )
    x = ccw_of(t, h)
    while x != h:
        apex = (left and x == p_out) or (right and x == next_of(t, o))
        c = target_of(t, x)
        if not apex and c != a and (c == b or is_joined(t, x ^ 1, b)):  # a loop edge at the origin stays a loop
            return WOULD_BE_PARALLEL
        f = face_of(t, x)
        if f >= 0 and f != face_of(t, h) and f != face_of(t, o) and _has_corner(t, x, b, asked):
            return WOULD_PINCH_FACE
        x = ccw_of(t, x)
    return OK


@kernel
def _side_status(t: Any, h: int) -> int:
    """What the face or the hole on the left of `h` has against it."""
    n, p = next_of(t, h), prev_of(t, h)
    if n == p and (n != h ^ 1 or face_of(t, h) >= 0):
        return SMALL_FACE
    if n == h ^ 1 or p == h ^ 1 or not is_triangle(t, h):
        return OK
    if face_of(t, h) < 0:
        return WOULD_CLOSE_HOLE
    f, g = face_of(t, n ^ 1), face_of(t, p ^ 1)
    if f < 0 and g < 0:
        return WOULD_LEAVE_WIRE
    folds = next_of(t, p ^ 1) ^ 1 == prev_of(t, n ^ 1) and is_face_triangle(t, n ^ 1) and is_face_triangle(t, p ^ 1)
    return WOULD_FOLD if folds else OK


@kernel
def _has_corner(t: Any, h: int, v: int, asked: bool) -> bool:
    """Whether the face of `h` has a corner at `v`; the corners of a triangle may have been asked for as neighbors."""
    if asked and is_triangle(t, h):
        return False
    x = next_of(t, h)
    while x != h:
        if origin_of(t, x) == v:
            return True
        x = next_of(t, x)
    return False


# -- the act -------------------------------------------------------------------------------------------------------


@kernel
def collapse(t: Any, h: int, weight: float = 1.0) -> int:
    r"""Contract `h`; returns the vertex that stays, its target. Cost: the degree of the origin.

    `weight` says where the vertex that stays comes to lie, from the origin (0) to the target (1), for the attributes
    that follow. A triangle beside the edge goes, and with it the one of its other edges that touched the origin;
    larger faces give up a corner.

    ::

              c                        c
            / | \                    / | \
          /  p|   \ n              /   |n  \
         .----a ---> b     -->    .--- b ----       a, h and a triangle's p go; b, n stay
          \    \  h / \            \  /   \
    """
    o = h ^ 1
    n, p, on, op = next_of(t, h), prev_of(t, h), next_of(t, o), prev_of(t, o)
    left, right = is_face_triangle(t, h), is_face_triangle(t, o)
    note_contraction(t, h, weight)
    b = contract(t, h)
    if left:
        _close_face(t, n, p)
        if op == p ^ 1:  # the edge between the two triangles, parallel to `h`, is gone: n stands in its place
            op = n
    if right:
        _close_face(t, op, on)
    changed(t)
    return b


@kernel
def _close_face(t: Any, keep: int, drop: int) -> None:
    """Close a face of two sides; cost: O(1)."""
    f = face_of(t, keep)
    close_between(t, keep, drop)
    b, beyond = origin_of(t, keep), face_of(t, keep)
    if beyond < 0 and face_of(t, halfedge_of_vertex(t, b)) >= 0:
        set_halfedge_of_vertex(t, b, keep)
    delete_face(t, f)


@operation
def try_collapse(t: Any, h: int, weight: float) -> int:
    """Contract `h` if it may be: the vertex that stays, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = collapse_status(t, h)
    return -status if status != OK else collapse(t, h, weight)
