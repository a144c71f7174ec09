"""Turning an edge inside the two faces beside it."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import (
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.notes import CORNERS, is_noting, note_copy
from halfmesh.core.operators.asking import edge_status, is_joined
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_face, set_halfedge_of_vertex, set_origin
from halfmesh.core.statuses import BOUNDARY_EDGE, OK, SAME_FACE, SMALL_FACE, WOULD_BE_LOOP, WOULD_BE_PARALLEL

__all__ = ["flip", "flip_status", "try_flip"]


@operation
def flip_status(t: Any, e: int, allow_parallel: bool = False) -> int:
    """Whether the edge may be flipped: ``OK`` or a code. Cost: the smaller degree of the two new ends."""
    h = 2 * e
    f, g = face_of(t, h), face_of(t, h ^ 1)
    if f < 0 or g < 0:
        return BOUNDARY_EDGE
    if f == g:
        return SAME_FACE
    n, on = next_of(t, h), next_of(t, h ^ 1)
    nn, onn = next_of(t, n), next_of(t, on)
    if h in (n, nn) or on == h ^ 1 or onn == h ^ 1:
        return SMALL_FACE
    if not allow_parallel:
        c = origin_of(t, nn)
        if c == origin_of(t, onn):
            return WOULD_BE_LOOP
        if is_joined(t, onn, c):
            return WOULD_BE_PARALLEL
    return OK


@kernel
def flip(t: Any, e: int) -> None:
    r"""Turn the edge counter-clockwise: each end moves on to the next corner of its face. Cost: O(1).

    ::

             b                        b
           / ^ \                    /   \
        n /  |  \ op             n /  g  \ op         h = 2e; faces of any degree: each keeps its degree,
         v   |   \                v       \           f gains `on` and gives up `n`
        c  f |h g  d    -->      c <------ d
         \   |   ^                \   h   ^
        p \  |  / on             p \  f  / on
           v | /                    v   /
             a                        a
    """
    h, o = 2 * e, 2 * e + 1
    n, p, on, op = next_of(t, h), prev_of(t, h), next_of(t, o), prev_of(t, o)
    nn, onn = next_of(t, n), next_of(t, on)
    a, b, f, g = origin_of(t, h), origin_of(t, o), face_of(t, h), face_of(t, o)
    if halfedge_of_vertex(t, a) == h:
        set_halfedge_of_vertex(t, a, on)
    if halfedge_of_vertex(t, b) == o:
        set_halfedge_of_vertex(t, b, n)
    if halfedge_of_face(t, f) == n:
        set_halfedge_of_face(t, f, h)
    if halfedge_of_face(t, g) == on:
        set_halfedge_of_face(t, g, o)
    set_origin(t, h, target_of(t, on))
    set_origin(t, o, target_of(t, n))
    link(t, op, n)
    link(t, n, o)
    link(t, o, onn)
    link(t, p, on)
    link(t, on, h)
    link(t, h, nn)
    set_face(t, n, g)
    set_face(t, on, f)
    if is_noting(t, CORNERS):  # a corner keeps the value that its face had at this vertex, or takes its neighbor's
        note_copy(t, CORNERS, n, o)
        note_copy(t, CORNERS, on, h)
        note_copy(t, CORNERS, h, onn)
        note_copy(t, CORNERS, o, nn)
    changed(t)


@operation
def try_flip(t: Any, e: int, allow_parallel: bool) -> int:
    """Flip the edge if it may be: 0, or the negative code."""
    status = edge_status(t, e)
    if status == OK:
        status = flip_status(t, e, allow_parallel)
    if status == OK:
        flip(t, e)
    return -status
