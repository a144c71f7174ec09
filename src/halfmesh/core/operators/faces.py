"""Faces added one by one or many at once, on any mesh.

A face is laid along halfedges that have none; where two that should follow each other do not yet, what lies between
them around their vertex is moved into another gap. So faces can be added in any order, two may touch at a vertex only,
and no order of adding leads into a dead end that the result would not be.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel, operation
from halfmesh.core.attempts import begin_attempt, end_attempt
from halfmesh.core.matching import corner_range
from halfmesh.core.navigation import (
    ccw_of,
    face_slots,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    target_of,
)
from halfmesh.core.operators.asking import halfedge_status, vertex_status
from halfmesh.core.operators.building import find_free_between, hung_edge, is_closed, make_follow
from halfmesh.core.operators.gaps import show_gap
from halfmesh.core.pens import changed, set_face
from halfmesh.core.slots import is_full, new_face
from halfmesh.core.statuses import (
    CLOSED_VERTEX,
    EMPTY_FACE,
    FEW_VERTICES,
    NO_GAP,
    NOT_A_CHAIN,
    OK,
    REPEATED_HALFEDGE,
    REPEATED_VERTEX,
    TAKEN_HALFEDGE,
    TOO_LARGE,
)
from halfmesh.core.topology import FEW

__all__ = [
    "add_face_of_vertices_status",
    "add_face_status",
    "add_faces_or_none",
    "add_faces_while_possible",
    "try_add_face",
    "try_add_face_of_vertices",
    "try_add_faces",
    "try_add_quad",
    "try_add_triangle",
]


@operation
def add_face_status(t: Any, halfedges: Any) -> int:
    """Whether a face may be added with these halfedges: ``OK`` or a code. Cost: that of doing it, which is undone."""
    before = begin_attempt(t)
    f = try_add_face(t, halfedges)
    end_attempt(t, before, False)
    return OK if f >= 0 else -f


@operation
def add_face_of_vertices_status(t: Any, vertices: Any) -> int:
    """Whether a face may be added with these corners: ``OK`` or a code. Cost: that of doing it, which is undone."""
    before = begin_attempt(t)
    f = try_add_face_of_vertices(t, vertices)
    end_attempt(t, before, False)
    return OK if f >= 0 else -f


@operation
def try_add_face(t: Any, halfedges: Any) -> int:
    """Add a face with these halfedges, in this order: the face, or the negative code, and nothing changed.

    They are made adjacent where they are not. The face may have one side or two, run along both sides of an edge, and
    pass a vertex several times. ``NO_GAP`` says that there is no way to have it. Cost: the degrees of its corners.
    """
    status = _face_status(t, halfedges)
    if status != OK:
        return -status
    before = begin_attempt(t)
    f = _lay_face(t, halfedges)
    end_attempt(t, before, f >= 0)
    return f


@operation
def try_add_face_of_vertices(t: Any, vertices: Any) -> int:
    """Add a face with these corners, in this order: the face, or the negative code, and nothing changed.

    Its sides are the first free halfedges found, and new edges between vertices that no edge joins yet. Where parallel
    edges are to choose from, add the face by its halfedges. Cost: the degrees of its corners.
    """
    return _try_add_between(t, vertices, 0, len(vertices))


@operation
def try_add_triangle(t: Any, a: int, b: int, c: int) -> int:
    """The same for a triangle: from Python, three ints are handed over in less than half the time of an array."""
    t.room[0], t.room[1], t.room[2] = a, b, c
    return _try_add_few(t, 3)


@operation
def try_add_quad(t: Any, a: int, b: int, c: int, d: int) -> int:
    """The same for a quad."""
    t.room[0], t.room[1], t.room[2], t.room[3] = a, b, c, d
    return _try_add_few(t, 4)


# Of a face with few corners, the vertices lie in t.room, and FEW places further the sides that are chosen for it: an
# array made for every face would take as long as the rest.


@kernel
def _try_add_between(t: Any, corners: Any, begin: int, end: int) -> int:
    n = end - begin
    if n > FEW:
        many = np.empty(n, np.int64)
        for i in range(n):
            many[i] = corners[begin + i]
        return _try_add_intricate_face(t, many)
    for i in range(n):
        t.room[i] = corners[begin + i]
    return _try_add_few(t, n)


@kernel
def _try_add_few(t: Any, n: int) -> int:
    status = _size_status(t, n)
    if status != OK:
        return -status
    are_distinct = True
    for i in range(n):
        status = _corner_status(t, t.room[i], t.room[i + 1 if i + 1 < n else 0])
        if status != OK:
            return -status
        for j in range(i):
            are_distinct = are_distinct and t.room[i] != t.room[j]
    if not are_distinct:
        return _try_add_few_intricate(t, n)
    status = _choose_sides(t, n)
    return -status if status != OK else _lay_along(t, n)


@kernel
def _choose_sides(t: Any, n: int) -> int:
    """The free halfedges that the face is to run along, -1 for an edge to be made: ``OK``, or why it can't be.

    Where all vertices are distinct no corner has to do with another, so all can be asked before anything is moved.
    """
    for i in range(n):
        u, v = t.room[i], t.room[i + 1 if i + 1 < n else 0]
        h = _find_free(t, u, v)
        if h == -2:
            return TAKEN_HALFEDGE
        if h == -1 and (is_closed(t, u, -1) or is_closed(t, v, -1)):
            return CLOSED_VERTEX
        t.room[FEW + i] = h
    h_in = t.room[FEW + n - 1]
    for i in range(n):
        h_out = t.room[FEW + i]
        apart = h_in >= 0 and h_out >= 0 and next_of(t, h_in) != h_out
        if apart and find_free_between(t, t.room[i], h_out ^ 1, h_in) < 0:
            return NO_GAP
        h_in = h_out
    return OK


@kernel
def _find_free(t: Any, u: int, v: int) -> int:
    """The first halfedge from `u` to `v` without a face; -1 if no edge joins them, -2 if all have faces there."""
    start, found = halfedge_of_vertex(t, u), -1
    x = start
    while x >= 0:
        if target_of(t, x) == v:
            if is_exterior(t, x):
                return x
            found = -2
        x = ccw_of(t, x)
        if x == start:
            break
    return found


@kernel
def _lay_along(t: Any, n: int) -> int:
    """Make the edges that are missing and lay the face, which `_choose_sides` has said may be."""
    f = face_slots(t)
    for i in range(n):
        if t.room[FEW + i] < 0:
            t.room[FEW + i] = hung_edge(t, t.room[i], t.room[i + 1 if i + 1 < n else 0])
    h_in = t.room[FEW + n - 1]
    for i in range(n):
        h_out = t.room[FEW + i]
        set_face(t, h_out, f)
        if next_of(t, h_in) != h_out:
            make_follow(t, h_in, h_out, find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in))
        h_in = h_out
    new_face(t, t.room[FEW])
    for i in range(n):
        show_gap(t, t.room[i])
    changed(t)
    return f


@kernel
def _try_add_few_intricate(t: Any, n: int) -> int:
    vertices = np.empty(n, np.int64)
    for i in range(n):
        vertices[i] = t.room[i]
    return _try_add_intricate_face(t, vertices)


@kernel
def _try_add_intricate_face(t: Any, vertices: Any) -> int:
    """A face that may pass a vertex or an edge twice, so that its corners have to do with each other: by trying."""
    n = len(vertices)
    status = _size_status(t, n)
    if status != OK:
        return -status
    for i in range(n):
        status = _corner_status(t, int(vertices[i]), int(vertices[i + 1 if i + 1 < n else 0]))
        if status != OK:
            return -status
    before = begin_attempt(t)
    halfedges = np.empty(n, np.int64)
    f = face_slots(t)  # marks what the face has chosen already, until all are chosen
    for i in range(n):
        h = _side(t, int(vertices[i]), int(vertices[i + 1 if i + 1 < n else 0]), f)
        if h < 0:
            status = -h
            break
        halfedges[i] = h
        set_face(t, h, f)
    if status == OK:
        for i in range(n):
            set_face(t, int(halfedges[i]), -1)
        f = _lay_face(t, halfedges)
    else:
        f = -status
    end_attempt(t, before, f >= 0)
    return f


@kernel
def _face_status(t: Any, halfedges: Any) -> int:
    """What can be said before anything is moved. Cost: the number of sides."""
    n = len(halfedges)
    if n == 0:
        return EMPTY_FACE
    for i in range(n):
        status = halfedge_status(t, int(halfedges[i]))
        if status != OK:
            return status
    for i in range(n):
        if not is_exterior(t, int(halfedges[i])):
            return TAKEN_HALFEDGE
        if target_of(t, int(halfedges[i])) != origin_of(t, int(halfedges[i + 1 if i + 1 < n else 0])):
            return NOT_A_CHAIN
    return TOO_LARGE if is_full(t, 0, 0, 1) else OK


@kernel
def _size_status(t: Any, n: int) -> int:
    if n == 0:
        return EMPTY_FACE
    if n < 3:
        return FEW_VERTICES
    return TOO_LARGE if is_full(t, 0, n, 1) else OK


@kernel
def _corner_status(t: Any, v: int, following: int) -> int:
    status = vertex_status(t, v)
    return REPEATED_VERTEX if status == OK and v == following else status


@kernel
def _side(t: Any, u: int, v: int, planned: int) -> int:
    """A free halfedge from `u` to `v`, made if no edge joins them; or the negative code."""
    h = _find_free(t, u, v)
    if h == -2:
        return -TAKEN_HALFEDGE
    if h >= 0:
        return h
    if is_closed(t, u, planned) or is_closed(t, v, planned):
        return -CLOSED_VERTEX
    return hung_edge(t, u, v)


@kernel
def _lay_face(t: Any, halfedges: Any) -> int:
    """Make the halfedges adjacent and a face: it, or the negative code; the caller undoes what was half done.

    A halfedge gets the face as soon as its next is settled, so it is no gap for the rest of the search. That is enough:
    around a vertex what is settled is a set of fans, each with one free end, and two of them can be joined as long as
    they are not the same fan. So the search fails only if the halfedges themselves ask for a ring that leaves
    something out, whatever the order.
    """
    n, f = len(halfedges), face_slots(t)
    for i in range(n):
        h_in, h_out = int(halfedges[i]), int(halfedges[i + 1 if i + 1 < n else 0])
        set_face(t, h_in, f)
        if i + 1 < n and not is_exterior(t, h_out):
            return -REPEATED_HALFEDGE
        if next_of(t, h_in) != h_out:
            g = find_free_between(t, origin_of(t, h_out), h_out ^ 1, h_in)
            if g < 0:
                return -NO_GAP
            make_follow(t, h_in, h_out, g)
    f = new_face(t, int(halfedges[0]))
    for i in range(n):
        show_gap(t, origin_of(t, int(halfedges[i])))
    changed(t)
    return f


# -- many faces ----------------------------------------------------------------------------------------------------


@kernel
def try_add_faces(t: Any, corners: Any, offsets: Any) -> int:
    """Add many faces: face `i` has the vertices ``corners[offsets[i]:offsets[i + 1]]``; see `try_add_face_of_vertices`.

    All or none: the first new face, or the negative code of the first that can't be, and nothing changed.
    """
    first = face_slots(t)
    code = add_faces_or_none(t, corners, 0, offsets, len(offsets) - 1)[1]
    return first if code == OK else -code


@kernel
def add_faces_or_none(t: Any, corners: Any, degree: int, offsets: Any, n: int) -> tuple[int, int]:
    """Add `n` faces or none: how many were possible, and the code of the first that was not."""
    before = begin_attempt(t)
    done, code = add_faces_while_possible(t, corners, degree, offsets, n)
    end_attempt(t, before, code == OK)
    return done, code


@kernel
def add_faces_while_possible(t: Any, corners: Any, degree: int, offsets: Any, n: int) -> tuple[int, int]:
    """Add `n` faces up to the first that can't be: how many were added, and its code."""
    for f in range(n):
        begin, end = corner_range(degree, offsets, f)
        added = _try_add_between(t, corners, begin, end)
        if added < 0:
            return f, -added
    return n, OK
