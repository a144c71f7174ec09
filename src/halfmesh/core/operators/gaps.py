"""Gaps and what closes them: the steps that several operators have in common."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.notes import CORNERS, EDGES, note_copy, note_union
from halfmesh.core.pens import link, set_face, set_halfedge_of_face, set_halfedge_of_vertex
from halfmesh.core.slots import delete_edge

__all__ = ["close_between", "next_gap", "show_gap", "splice"]


@kernel
def show_gap(t: Any, v: int) -> None:
    """Make the halfedge of a vertex exterior, if it touches a gap. Cost: the degree, if it was not."""
    start = halfedge_of_vertex(t, v)
    if is_exterior(t, start):
        return
    x = ccw_of(t, start)
    while x != start:
        if is_exterior(t, x):
            set_halfedge_of_vertex(t, v, x)
            return
        x = ccw_of(t, x)


@kernel
def next_gap(t: Any, h: int) -> int:
    """The first exterior halfedge counter-clockwise after `h` around its origin; `h` itself if there is no other."""
    x = ccw_of(t, h)
    while x != h and not is_exterior(t, x):
        x = ccw_of(t, x)
    return x


@kernel
def splice(t: Any, a: int, b: int) -> None:
    r"""Exchange the gaps before `a` and `b`, which are exterior: two rings become one, or one ring two.

    The operator of Guibas and Stolfi (1985), for gaps. The origins are the caller's. Cost: O(1).

    ::

        p \     / a                 p \         / a
           v   ^                       v       ^
            (u)                         (      )
                           <-->         (  u   )            a and b leave the same vertex, or each its own
            (v)                         (      )
           ^   \                       ^       v
        q /     v b                 q /         \ b
    """
    p, q = prev_of(t, a), prev_of(t, b)
    link(t, q, a)
    link(t, p, b)


@kernel
def close_between(t: Any, keep: int, drop: int) -> None:
    r"""Close what lies between two edges: they become the one of `keep`, which takes the place behind `drop`.

    What had two sides, `keep` and `drop`, a face or a hole, is the caller's to forget; and a vertex may have no gap any
    more, or a gap that it does not show yet. Cost: O(1).

    ::

           keep
        b ------> c            keep
          <------      -->   b ----> c
           drop
          ~~~~~~> q = drop ^ 1, with the face beyond
    """
    q = drop ^ 1
    b, c, beyond, before, after = origin_of(t, keep), target_of(t, keep), face_of(t, q), prev_of(t, q), next_of(t, q)
    if after == q:
        link(t, keep, keep)
    else:
        link(t, before, keep)
        link(t, keep, after)
    set_face(t, keep, beyond)
    if beyond >= 0 and halfedge_of_face(t, beyond) == q:
        set_halfedge_of_face(t, beyond, keep)
    if halfedge_of_vertex(t, b) == q:
        set_halfedge_of_vertex(t, b, keep)
    if halfedge_of_vertex(t, c) == drop:
        set_halfedge_of_vertex(t, c, keep ^ 1)
    note_union(t, EDGES, keep >> 1, drop >> 1, 0.5)
    note_copy(t, CORNERS, keep, q)
    delete_edge(t, drop)
