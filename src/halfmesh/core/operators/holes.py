"""Holes: faces taken out and put in, and faces grown along the boundary."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.navigation import halfedge_of_face, is_exterior, next_of, origin_of, prev_of
from halfmesh.core.operators.asking import both_status, face_status, halfedge_status, is_joined
from halfmesh.core.operators.building import remove_face
from halfmesh.core.operators.gaps import show_gap
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_vertex
from halfmesh.core.slots import is_full, new_edge, new_face, new_vertex
from halfmesh.core.statuses import (
    DIFFERENT_LOOPS,
    NOT_EXTERIOR,
    OK,
    SAME_CORNER,
    TOO_LARGE,
    WOULD_BE_LOOP,
    WOULD_BE_PARALLEL,
)

__all__ = [
    "add_face_to_boundary",
    "add_face_to_boundary_status",
    "add_vertex_and_face_to_boundary",
    "add_vertex_and_face_to_boundary_status",
    "fill_hole",
    "fill_hole_status",
    "make_hole",
    "try_add_face_to_boundary",
    "try_add_vertex_and_face_to_boundary",
    "try_fill_hole",
    "try_make_hole",
]


# -- a face goes, a face comes -------------------------------------------------------------------------------------


@kernel
def make_hole(t: Any, f: int) -> int:
    """Remove the face; returns its halfedge, which runs along the hole now. Cost: the number of its sides."""
    h = halfedge_of_face(t, f)
    remove_face(t, f)
    return h


@operation
def try_make_hole(t: Any, f: int) -> int:
    """Remove the face if there is one: its halfedge, or the negative code."""
    status = face_status(t, f)
    return -status if status != OK else make_hole(t, f)


@operation
def fill_hole_status(t: Any, h: int) -> int:
    """Whether a face may be laid along the hole of `h`: ``OK`` or a code. Cost: O(1)."""
    if not is_exterior(t, h):
        return NOT_EXTERIOR
    return TOO_LARGE if is_full(t, 0, 0, 1) else OK


@kernel
def fill_hole(t: Any, h: int) -> int:
    """Lay a face along the whole hole on the left of `h`; returns it. Cost: the degrees of its corners.

    Whatever the hole is bounded by: wire that hangs in it becomes a slit of the face.
    """
    f = new_face(t, h)
    _lay_along(t, h, f)
    changed(t)
    return f


@kernel
def _lay_along(t: Any, h: int, f: int) -> None:
    """Give the loop of `h` a face, and let its vertices show the gaps that are left to them."""
    x = h
    while True:
        set_face(t, x, f)
        x = next_of(t, x)
        if x == h:
            break
    while True:
        show_gap(t, origin_of(t, x))
        x = next_of(t, x)
        if x == h:
            break


@operation
def try_fill_hole(t: Any, h: int) -> int:
    """Fill the hole on the left of `h`: the new face, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = fill_hole_status(t, h)
    return -status if status != OK else fill_hole(t, h)


# -- along the boundary --------------------------------------------------------------------------------------------


@operation
def add_face_to_boundary_status(t: Any, h: int, g: int, allow_parallel: bool = False) -> int:
    """Whether a face may be laid from `h` to `g`: ``OK`` or a code. Cost: the number of sides between, and a degree."""
    status = _between_status(t, h, g)
    if status == OK and not allow_parallel:
        if origin_of(t, h) == origin_of(t, g):
            return WOULD_BE_LOOP
        if is_joined(t, h, origin_of(t, g)):
            return WOULD_BE_PARALLEL
    return TOO_LARGE if status == OK and is_full(t, 0, 1, 1) else status


@kernel
def add_face_to_boundary(t: Any, h: int, g: int) -> int:
    r"""Lay a face along the boundary from `h` up to `g`, closed by a new edge; returns it. Cost: the degrees between.

    ::

          g                           g
        <----- .                    <----- .
               ^         -->           /   ^         x: the last edge's first halfedge, in the new face f;
               |                      x  f |            the hole goes on beyond it
        -----> . ----> .            v   ___|
               h                    .------> h
    """
    x = new_edge(t, origin_of(t, g), origin_of(t, h))
    _close_off(t, h, g, x, x)
    f = new_face(t, h)
    _lay_along(t, h, f)
    changed(t)
    return f


@operation
def try_add_face_to_boundary(t: Any, h: int, g: int, allow_parallel: bool) -> int:
    """Lay a face along the boundary from `h` up to `g`: it, or the negative code."""
    status = both_status(t, h, g)
    if status == OK:
        status = add_face_to_boundary_status(t, h, g, allow_parallel)
    return -status if status != OK else add_face_to_boundary(t, h, g)


@operation
def add_vertex_and_face_to_boundary_status(t: Any, h: int, g: int) -> int:
    """Whether a face may be laid from `h` to `g` through a new vertex: ``OK`` or a code. Cost: the sides between."""
    status = _between_status(t, h, g)
    return TOO_LARGE if status == OK and is_full(t, 1, 2, 1) else status


@kernel
def add_vertex_and_face_to_boundary(t: Any, h: int, g: int) -> int:
    """Lay a face along the boundary from `h` up to `g`, closed by two edges through a new vertex; returns the vertex.

    The edges are the last two: ``x`` from the origin of `g` to the vertex, ``y`` from there to the origin of `h`.
    With ``g = next_of(t, h)`` a triangle grows on `h`. Cost: the degrees between.
    """
    w = new_vertex(t)
    x = new_edge(t, origin_of(t, g), w)
    y = new_edge(t, w, origin_of(t, h))
    _close_off(t, h, g, x, y)
    link(t, x, y)
    link(t, y ^ 1, x ^ 1)
    set_halfedge_of_vertex(t, w, x ^ 1)
    f = new_face(t, h)
    _lay_along(t, h, f)
    changed(t)
    return w


@operation
def try_add_vertex_and_face_to_boundary(t: Any, h: int, g: int) -> int:
    """Lay a face along the boundary from `h` up to `g` through a new vertex: that, or the negative code."""
    status = both_status(t, h, g)
    if status == OK:
        status = add_vertex_and_face_to_boundary_status(t, h, g)
    return -status if status != OK else add_vertex_and_face_to_boundary(t, h, g)


@kernel
def _between_status(t: Any, h: int, g: int) -> int:
    if not is_exterior(t, h) or not is_exterior(t, g):
        return NOT_EXTERIOR
    if h == g:
        return SAME_CORNER
    x = next_of(t, h)
    while x != h:
        if x == g:
            return OK
        x = next_of(t, x)
    return DIFFERENT_LOOPS


@kernel
def _close_off(t: Any, h: int, g: int, first: int, last: int) -> None:
    """Close the part of a loop from `h` to before `g` by a path from `first` to `last`; its back closes the rest."""
    p, q = prev_of(t, h), prev_of(t, g)
    link(t, q, first)
    link(t, last, h)
    link(t, p, last ^ 1)
    link(t, first ^ 1, g)
