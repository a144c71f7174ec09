"""Putting vertices and edges in: split an edge, split a face at a point or by a diagonal, and join faces again."""

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
from halfmesh.core.notes import (
    BETWEEN,
    CORNERS,
    EDGES,
    FACES,
    VERTICES,
    add_source,
    begin_note,
    is_noting,
    note_between,
    note_copy,
    note_part,
    note_union,
)
from halfmesh.core.operators.asking import (
    both_status,
    face_status,
    halfedge_status,
    is_face_triangle,
    is_joined,
    sides_of,
)
from halfmesh.core.pens import (
    changed,
    link,
    set_face,
    set_halfedge_of_face,
    set_halfedge_of_vertex,
    set_origin,
)
from halfmesh.core.slots import delete_edge, delete_face, is_full, new_edge, new_face, new_vertex
from halfmesh.core.statuses import (
    BOUNDARY_EDGE,
    DIFFERENT_FACES,
    NO_FACE,
    NOT_TRIANGLE,
    OK,
    SAME_CORNER,
    SAME_FACE,
    SMALL_FACE,
    TOO_LARGE,
    WOULD_BE_LOOP,
    WOULD_BE_PARALLEL,
)

__all__ = [
    "connect",
    "connect_status",
    "join_faces",
    "join_faces_status",
    "split_edge",
    "split_edge_triangular",
    "split_edge_triangular_status",
    "split_face",
    "try_connect",
    "try_join_faces",
    "try_split_edge",
    "try_split_edge_triangular",
    "try_split_face",
]


# -- an edge -------------------------------------------------------------------------------------------------------


@kernel
def split_edge(t: Any, h: int, weight: float = 0.5) -> int:
    r"""Put a vertex into the edge of `h`; returns it. Any living halfedge will do. Cost: O(1).

    `weight` says where, from the origin of `h` (0) to its target (1), for the attributes that follow.

    ::

             h                      h      h2
        a ------> b     -->     a ----> v ----> b       the new edge is the last; h2 leaves v, its halfedge 2e
          <------                 <----   <----
             o                      o      o2           faces on both sides gain a corner
    """
    o = h ^ 1
    a, b, n, op = origin_of(t, h), origin_of(t, o), next_of(t, h), prev_of(t, o)
    v = new_vertex(t)
    h2 = new_edge(t, v, b)
    o2 = h2 ^ 1
    set_origin(t, o, v)
    set_face(t, h2, face_of(t, h))
    set_face(t, o2, face_of(t, o))
    link(t, h, h2)
    link(t, o2, o)
    if n == o:  # b is a leaf
        link(t, h2, o2)
    else:
        link(t, h2, n)
        link(t, op, o2)
    if halfedge_of_vertex(t, b) == o:
        set_halfedge_of_vertex(t, b, o2)
    set_halfedge_of_vertex(t, v, o if face_of(t, o) < 0 else h2)
    if face_of(t, o) >= 0 and halfedge_of_face(t, face_of(t, o)) == o:
        set_halfedge_of_face(t, face_of(t, o), o2)
    _note_split_edge(t, h, v, h2, a, b, n, weight)
    changed(t)
    return v


@kernel
def _note_split_edge(t: Any, h: int, v: int, h2: int, a: int, b: int, n: int, weight: float) -> None:
    note_between(t, VERTICES, v, a, b, weight)
    note_part(t, EDGES, h2 >> 1, h >> 1, 1.0 - weight)
    note_part(t, EDGES, h >> 1, h >> 1, weight)
    if is_noting(t, CORNERS):  # each side between its own corners: seams stay seams
        note_between(t, CORNERS, h2, h, n, weight)
        note_copy(t, CORNERS, h2 ^ 1, h ^ 1)
        note_between(t, CORNERS, h ^ 1, h ^ 1, next_of(t, h ^ 1), 1.0 - weight)


@operation
def try_split_edge(t: Any, h: int, weight: float) -> int:
    """Split the edge of `h`: the new vertex, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK and is_full(t, 1, 1, 0):
        status = TOO_LARGE
    return -status if status != OK else split_edge(t, h, weight)


@operation
def split_edge_triangular_status(t: Any, h: int, allow_parallel: bool = False) -> int:
    """Whether the triangles beside `h` may be split with its edge: ``OK`` or a code. Cost: O(1)."""
    o = h ^ 1
    for side in (h, o):
        if face_of(t, side) >= 0:
            if not is_face_triangle(t, side):
                return NOT_TRIANGLE
            c = origin_of(t, prev_of(t, side))
            if not allow_parallel and (c == origin_of(t, h) or c == origin_of(t, o)):
                return WOULD_BE_PARALLEL
    has_two = face_of(t, h) >= 0 and face_of(t, o) >= 0
    if not allow_parallel and has_two and origin_of(t, prev_of(t, h)) == origin_of(t, prev_of(t, o)):
        return WOULD_BE_PARALLEL
    return TOO_LARGE if is_full(t, 1, 3, 2) else OK


@kernel
def split_edge_triangular(t: Any, h: int, weight: float = 0.5) -> int:
    r"""Put a vertex into the edge of `h` and join it to the third corners of the triangles beside; returns it.

    ::

             c                      c
           /   \                  / | \         new edges, in this order: v -> b, v -> c, v -> d, those that there are;
         /       \              /   ^   \       new faces: that of h (the side of a), that of o2 (the side of b)
        a --h----> b     -->   a-h-> v --> b
         \   o   /              \   v   /
           \   /                  \ | /        Cost: O(1).
             d                      d
    """
    o = h ^ 1
    v = split_edge(t, h, weight)
    if face_of(t, h) >= 0:
        connect(t, next_of(t, h), prev_of(t, h))
    if face_of(t, o) >= 0:
        connect(t, o, next_of(t, next_of(t, o)))
    return v


@operation
def try_split_edge_triangular(t: Any, h: int, weight: float, allow_parallel: bool) -> int:
    """Split the edge of `h` and the triangles beside: the new vertex, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = split_edge_triangular_status(t, h, allow_parallel)
    return -status if status != OK else split_edge_triangular(t, h, weight)


# -- a face at a point ---------------------------------------------------------------------------------------------


@kernel
def split_face(t: Any, f: int) -> int:
    r"""Put a vertex into a face and join it to every corner; returns it. Any living face will do. Cost: O(degree).

    ::

             c                      c
           /   \                  / | \
          /     \               /   v   \        f keeps its first side; the other triangles are the last faces,
         /   f   \     -->     /  /   \  \       the spokes the last edges, 2e towards v, in the order of the corners
        a ------- b           a ----------- b
    """
    start = halfedge_of_face(t, f)
    v = new_vertex(t)
    degree = _note_split_face(t, start, v)
    spoke = new_edge(t, origin_of(t, start), v)
    first, h, side = spoke, start, f
    for _ in range(degree):
        after = next_of(t, h)
        following = first if after == start else new_edge(t, origin_of(t, after), v)
        if h != start:
            side = new_face(t, h)
            set_face(t, h, side)
            note_part(t, FACES, side, f, 1.0 / degree)
        set_face(t, following, side)
        set_face(t, spoke ^ 1, side)
        link(t, h, following)
        link(t, following, spoke ^ 1)
        link(t, spoke ^ 1, h)
        h, spoke = after, following
    set_halfedge_of_vertex(t, v, first ^ 1)
    note_part(t, FACES, f, f, 1.0 / degree)
    if is_noting(t, CORNERS):
        _note_spokes(t, first, degree)
    changed(t)
    return v


@kernel
def _note_split_face(t: Any, start: int, v: int) -> int:
    """The vertex lies in the middle of the corners, whose number is returned."""
    degree, h = sides_of(t, start), start
    if is_noting(t, VERTICES):
        begin_note(t, BETWEEN, VERTICES, v, degree)
        for _ in range(degree):
            add_source(t, origin_of(t, h), 1.0 / degree)
            h = next_of(t, h)
    return degree


@kernel
def _note_spokes(t: Any, first: int, degree: int) -> None:
    """The corners at the rim keep the values the face had there; those in the middle have the mean of all."""
    spoke = first
    for _ in range(degree):
        out = spoke ^ 1  # middle -> corner; after it the side of the old face that leaves this corner
        note_copy(t, CORNERS, spoke, next_of(t, out))
        begin_note(t, BETWEEN, CORNERS, out, degree)
        h = next_of(t, out)
        for _ in range(degree):
            add_source(t, h, 1.0 / degree)
            h = next_of(t, next_of(t, h) ^ 1)
        spoke = next_of(t, next_of(t, out))


@operation
def try_split_face(t: Any, f: int) -> int:
    """Split the face at a point: the new vertex, or the negative code."""
    status = face_status(t, f)
    if status == OK:
        degree = sides_of(t, halfedge_of_face(t, f))
        if is_full(t, 1, degree, degree):
            status = TOO_LARGE
    return -status if status != OK else split_face(t, f)


# -- a face by a diagonal ------------------------------------------------------------------------------------------


@operation
def connect_status(t: Any, h: int, g: int, allow_parallel: bool = False) -> int:
    """Whether the origins of two halfedges of a face may be joined: ``OK`` or a code. Cost: the smaller degree."""
    if h == g:
        return SAME_CORNER
    if face_of(t, h) < 0:
        return NO_FACE
    if face_of(t, h) != face_of(t, g):
        return DIFFERENT_FACES
    if not allow_parallel:
        if origin_of(t, h) == origin_of(t, g):
            return WOULD_BE_LOOP
        if is_joined(t, h, origin_of(t, g)):
            return WOULD_BE_PARALLEL
    return TOO_LARGE if is_full(t, 0, 1, 1) else OK


@kernel
def connect(t: Any, h: int, g: int) -> int:
    r"""Join the origins of `h` and `g`, two corners of a face; returns the new halfedge from that of `h`.

    The new face, the last one, is on the left of the new halfedge; the old face keeps the other part. Cost: the number
    of sides of the new face.

    ::

           g                       g
        . <-- b . <             . <-- b . <
        |   f     |             | new ^   |
        v         |     -->     v     |x  |      x is the new halfedge, the last edge's first
        . --> a . >             . --> a . >
               h                       h
    """
    f, p, q = face_of(t, h), prev_of(t, h), prev_of(t, g)
    x = new_edge(t, origin_of(t, h), origin_of(t, g))
    link(t, p, x)
    link(t, x, g)
    link(t, q, x ^ 1)
    link(t, x ^ 1, h)
    made = new_face(t, x)
    set_face(t, x, made)
    y = g
    while y != x:
        set_face(t, y, made)
        y = next_of(t, y)
    set_face(t, x ^ 1, f)
    if face_of(t, halfedge_of_face(t, f)) != f:
        set_halfedge_of_face(t, f, h)
    note_part(t, FACES, made, f, 0.5)
    note_part(t, FACES, f, f, 0.5)
    note_copy(t, CORNERS, x, h)
    note_copy(t, CORNERS, x ^ 1, g)
    changed(t)
    return x


@operation
def try_connect(t: Any, h: int, g: int, allow_parallel: bool) -> int:
    """Join two corners of a face: the new halfedge, or the negative code."""
    status = both_status(t, h, g)
    if status == OK:
        status = connect_status(t, h, g, allow_parallel)
    return -status if status != OK else connect(t, h, g)


@operation
def join_faces_status(t: Any, h: int) -> int:
    """Whether the faces on both sides of `h` may be united: ``OK`` or a code. Cost: O(1)."""
    if face_of(t, h) < 0 or face_of(t, h ^ 1) < 0:
        return BOUNDARY_EDGE
    if next_of(t, h) == h or next_of(t, h ^ 1) == h ^ 1:
        return SMALL_FACE
    return SAME_FACE if face_of(t, h) == face_of(t, h ^ 1) else OK


@kernel
def join_faces(t: Any, h: int) -> int:
    r"""Remove the edge between two faces: that on the left of `h` takes over the other, and is returned.

    Cost: the number of sides of the face on the right, which goes.

    ::

        . <-- b . <             . <-- b . <
        | f   ^ g |             |         |
        v     |h  |     -->     v    f    |
        . --> a . >             . --> a . >
    """
    o = h ^ 1
    f, g = face_of(t, h), face_of(t, o)
    n, p, on, op = next_of(t, h), prev_of(t, h), next_of(t, o), prev_of(t, o)
    x = on
    while x != o:
        set_face(t, x, f)
        x = next_of(t, x)
    link(t, p, on)
    link(t, op, n)
    if halfedge_of_face(t, f) == h:
        set_halfedge_of_face(t, f, on)
    if halfedge_of_vertex(t, origin_of(t, h)) == h:
        set_halfedge_of_vertex(t, origin_of(t, h), on)
    if halfedge_of_vertex(t, target_of(t, h)) == o:
        set_halfedge_of_vertex(t, target_of(t, h), n)
    delete_edge(t, h)
    delete_face(t, g)
    note_union(t, FACES, f, g, 0.5)
    changed(t)
    return f


@operation
def try_join_faces(t: Any, h: int) -> int:
    """Unite the two faces beside `h`: the one that stays, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = join_faces_status(t, h)
    return -status if status != OK else join_faces(t, h)
