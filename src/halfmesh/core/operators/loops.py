"""Cutting a surface along a loop of edges and capping both ends, and the inverse: what changes the genus."""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.attempts import begin_attempt, end_attempt
from halfmesh.core.navigation import (
    face_of,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.operators.asking import both_status, halfedge_status, sides_of
from halfmesh.core.operators.building import remove_face
from halfmesh.core.operators.holes import fill_hole
from halfmesh.core.operators.seams import cut, open_edge_status, stitch, stitch_status
from halfmesh.core.pens import set_halfedge_of_vertex
from halfmesh.core.slots import is_full
from halfmesh.core.statuses import (
    DIFFERENT_DEGREES,
    NO_FACE,
    NOT_A_CHAIN,
    NOT_A_CYCLE,
    OK,
    SAME_EDGE,
    SAME_FACE,
    SHARED_VERTEX,
    SMALL_FACE,
    TOO_LARGE,
)
from halfmesh.core.topology import DELETED

__all__ = ["join_loop", "join_loop_status", "split_loop", "split_loop_status", "try_join_loop", "try_split_loop"]


# -- split ---------------------------------------------------------------------------------------------------------


@kernel
def split_loop_status(t: Any, path: Any) -> int:
    """Whether the surface may be split along a closed path: ``OK`` or a code. Cost: the number of its halfedges."""
    n = len(path)
    for i in range(n):
        status = halfedge_status(t, int(path[i]))
        if status != OK:
            return status
    if n < 3:
        return SMALL_FACE
    for i in range(n):
        h = int(path[i])
        if target_of(t, h) != origin_of(t, int(path[i + 1 if i + 1 < n else 0])):
            return NOT_A_CHAIN
        status = open_edge_status(t, h)
        if status != OK:
            return status
        if is_exterior(t, halfedge_of_vertex(t, origin_of(t, h))):
            return NOT_A_CYCLE
    if is_full(t, n, n, 2):
        return TOO_LARGE
    before = begin_attempt(t)
    status = OK
    for i in range(n):
        if not _mark_vertex(t, origin_of(t, int(path[i]))):
            status = NOT_A_CYCLE
            break
    end_attempt(t, before, False)
    return status


@kernel
def split_loop(t: Any, path: Any) -> int:
    r"""Cut along a closed path and lay a face over each of the two holes; returns the first face.

    The first face lies along the twin of ``path[0]``, opposite to the faces on the left of the path; the other, the
    last, is turned to those on its right. A handle is cut through, or a piece is cut off. Cost: the degrees of the
    vertices on the path.

    ::

        ====|====            ====) f          the path runs around the tube
            |        -->
        ====|====            ====)    f+1 (====
    """
    first = cut(t, path)
    f = fill_hole(t, int(path[0]) ^ 1)
    fill_hole(t, 2 * first + 1)
    return f


@kernel
def try_split_loop(t: Any, path: Any) -> int:
    """Split the surface along a closed path if that may be: the first of the two faces, or the negative code."""
    status = split_loop_status(t, path)
    return -status if status != OK else split_loop(t, path)


@kernel
def _mark_vertex(t: Any, v: int) -> bool:
    """Mark a vertex, within an attempt that will be undone; False if it was marked before."""
    if halfedge_of_vertex(t, v) == DELETED:
        return False
    set_halfedge_of_vertex(t, v, DELETED)
    return True


# -- join ----------------------------------------------------------------------------------------------------------


@kernel
def join_loop_status(t: Any, h: int, g: int, allow_parallel: bool = False) -> int:
    """Whether the faces of `h` and `g` may be glued: ``OK`` or a code. Cost: that of doing it, which is undone."""
    status = _apart_status(t, h, g)
    if status == OK:
        before = begin_attempt(t)
        status = _glue(t, h, g, allow_parallel)
        end_attempt(t, before, False)
    return status


@kernel
def _apart_status(t: Any, h: int, g: int) -> int:
    """Whether both are faces, with equally many sides and no corner in common."""
    if face_of(t, h) < 0 or face_of(t, g) < 0:
        return NO_FACE
    if face_of(t, h) == face_of(t, g):
        return SAME_FACE
    if sides_of(t, h) != sides_of(t, g):
        return DIFFERENT_DEGREES
    before = begin_attempt(t)
    apart = _mark_corners(t, h) and _mark_corners(t, g)
    end_attempt(t, before, False)
    return OK if apart else SHARED_VERTEX


@kernel
def _mark_corners(t: Any, h: int) -> bool:
    x = h
    while True:
        if not _mark_vertex(t, origin_of(t, x)):
            return False
        x = next_of(t, x)
        if x == h:
            return True


@kernel
def join_loop(t: Any, h: int, g: int, allow_parallel: bool = False) -> int:
    """Remove two faces and glue what bounded them, `h` to `g`, next to prev; returns the code ``OK`` if it was done.

    Undoes :func:`split_loop`: a handle is made, or two pieces become one. Cost: the degrees of the corners, times
    those of their neighbors at worst.
    """
    before = begin_attempt(t)
    status = _glue(t, h, g, allow_parallel)
    end_attempt(t, before, status == OK)
    return status


@kernel
def _glue(t: Any, h: int, g: int, allow_parallel: bool) -> int:
    """Glue the two faces, as far as it goes: ``OK`` or why not, for the caller to undo."""
    sides = _facing_sides(t, h, g)
    remove_face(t, face_of(t, h))
    remove_face(t, face_of(t, g))
    for i in range(len(sides) // 2):
        if both_status(t, sides[2 * i], sides[2 * i + 1]) != OK:  # gone with an edge that a face passes twice
            return SAME_EDGE
        status = stitch_status(t, sides[2 * i], sides[2 * i + 1], allow_parallel)
        if status != OK:
            return status
        stitch(t, sides[2 * i], sides[2 * i + 1])
    return OK


@kernel
def try_join_loop(t: Any, h: int, g: int, allow_parallel: bool) -> int:
    """Glue the faces of `h` and `g` if that may be: `h`, or the negative code."""
    status = both_status(t, h, g)
    if status == OK:
        status = _apart_status(t, h, g)
    if status == OK:
        status = join_loop(t, h, g, allow_parallel)
    return h if status == OK else -status


@kernel
def _facing_sides(t: Any, h: int, g: int) -> Any:
    """`h` and `g`, the next of `h` and the prev of `g`, and so on."""
    n = sides_of(t, h)
    sides = np.empty(2 * n, np.int64)
    for i in range(n):
        sides[2 * i] = h
        sides[2 * i + 1] = g
        h, g = next_of(t, h), prev_of(t, g)
    return sides
