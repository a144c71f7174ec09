"""The operators that a loop in plain Python calls by the million, as built-in functions.

Each does what the method of its name does, in the common case; for everything else it calls that method. The operator
notes how attributes are to follow, and Python replays that by the policy of each. For the points, which every mesh
has, that would cost ten times the operator: here they follow before the call returns, and the vertex is put where it
is told.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, native, real_at, record_of, word_at
from halfmesh.core.navigation import edge_slots
from halfmesh.core.notes import VERTICES
from halfmesh.core.operators.building import try_add_vertex
from halfmesh.core.operators.collapses import collapse_status, try_collapse
from halfmesh.core.operators.faces import try_add_quad, try_add_triangle
from halfmesh.core.operators.flips import flip_status, try_flip
from halfmesh.core.operators.splits import try_split_edge, try_split_edge_triangular, try_split_face
from halfmesh.core.statuses import DELETED_ELEMENT
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    FEW,
    HAS_NOTES,
    NEWS,
    NOTES_SIZE,
    NOTING,
    VERTEX_SLOTS,
    topology_at,
)
from halfmesh.mesh.attributes import positions_at
from halfmesh.mesh.desk import (
    ASK,
    DESK,
    EDGE,
    FACE,
    HALFEDGE,
    IS_ONLY,
    MODE,
    POINTS,
    TOPOLOGY,
    TRIANGULAR,
    TRY,
    VERTEX,
    WEIGHT,
    X,
)
from halfmesh.mesh.objects import (
    NO_PLACE,
    boolean,
    caught_up,
    halfedge_in,
    handle,
    index_in,
    is_open,
    item,
    method,
    none,
    options_in,
    size_of,
)
from halfmesh.mesh.policies import LERP, replay_notes

__all__ = [
    "OF_ADD_FACE",
    "OF_ADD_VERTEX",
    "OF_SPLIT_EDGE",
    "OF_SPLIT_FACE",
    "add_face",
    "add_vertex",
    "collapse",
    "flip",
    "split_edge",
    "split_face",
]

# What each makes at most: vertices, edges and faces. (Splitting a face of more corners may have to grow the columns.)
OF_ADD_VERTEX = (1, 0, 0)
OF_ADD_FACE = (0, 4, 1)
OF_SPLIT_EDGE = (1, 3, 2)  # and the triangles beside
OF_SPLIT_FACE = (1, FEW, FEW)


@native
def flip(self: int, arguments: int, n: int, names: int) -> int:
    """``flip(edge)``, ``try_flip(edge)`` or ``can_flip(edge)``."""
    record = record_of(self)
    desk = word_at(record, DESK)
    e = index_in(desk, word_at(arguments, 0), EDGE) if n == 1 and names == 0 and is_open(desk) else -1
    if e < 0:
        return method(record, arguments, n, names)
    t, mode = topology_at(word_at(desk, TOPOLOGY)), word_at(record, MODE)
    if mode == ASK:
        if not _is_living(t, 2 * e):
            return method(record, arguments, n, names)
        return boolean(flip_status(t, e, False) == 0)
    code = try_flip(t, e, False)
    if code < 0:
        if mode == TRY and code < -DELETED_ELEMENT:
            return boolean(False)
        return method(record, arguments, n, names)
    if not caught_up(t, desk):
        return 0
    return boolean(True) if mode == TRY else none(desk)


@native
def collapse(self: int, arguments: int, n: int, names: int) -> int:
    """``collapse(halfedge, point=None, *, at=1.0)``, ``try_collapse(...)`` or ``can_collapse(halfedge)``."""
    record = record_of(self)
    desk = word_at(record, DESK)
    h = index_in(desk, word_at(arguments, 0), HALFEDGE) if n >= 1 and is_open(desk) else -1
    is_told = options_in(desk, arguments, 1, n, names, 1.0) if h >= 0 else -1
    if is_told < 0:
        return method(record, arguments, n, names)
    t, mode = topology_at(word_at(desk, TOPOLOGY)), word_at(record, MODE)
    if mode == ASK:
        if n != 1 or names != 0 or not _is_living(t, h):
            return method(record, arguments, n, names)
        return boolean(collapse_status(t, h) == 0)
    weight = real_at(desk, WEIGHT)
    noting = _note_less(t, desk, is_told == 1 or weight == 1.0)
    v = try_collapse(t, h, weight)
    t.counts[NOTING] = noting
    if v < 0:
        if mode == TRY and v < -DELETED_ELEMENT:
            return none(desk)
        return method(record, arguments, n, names)
    return _answer(t, desk, v, is_told)


@native
def split_edge(self: int, arguments: int, n: int, names: int) -> int:
    """``split_edge(edge, point=None, *, at=0.5)``, or ``split_edge_triangular(...)``."""
    record = record_of(self)
    desk = word_at(record, DESK)
    h = halfedge_in(desk, word_at(arguments, 0)) if n >= 1 and is_open(desk) else -1
    is_told = options_in(desk, arguments, 1, n, names, 0.5) if h >= 0 and _has_room(desk, *OF_SPLIT_EDGE) else -1
    if is_told < 0:
        return method(record, arguments, n, names)
    t, weight = topology_at(word_at(desk, TOPOLOGY)), real_at(desk, WEIGHT)
    noting = _note_less(t, desk, is_told == 1)
    if word_at(record, MODE) == TRIANGULAR:
        v = try_split_edge_triangular(t, h, weight, False)
    else:
        v = try_split_edge(t, h, weight)
    t.counts[NOTING] = noting
    return _answer(t, desk, v, is_told) if v >= 0 else method(record, arguments, n, names)


@native
def split_face(self: int, arguments: int, n: int, names: int) -> int:
    """``split_face(face, point=None)``."""
    record = record_of(self)
    desk = word_at(record, DESK)
    f = index_in(desk, word_at(arguments, 0), FACE) if n >= 1 and is_open(desk) else -1
    is_told = options_in(desk, arguments, 1, n, names, NO_PLACE) if f >= 0 and _has_room(desk, *OF_SPLIT_FACE) else -1
    if is_told < 0:
        return method(record, arguments, n, names)
    t = topology_at(word_at(desk, TOPOLOGY))
    noting = _note_less(t, desk, is_told == 1)
    v = try_split_face(t, f)
    t.counts[NOTING] = noting
    return _answer(t, desk, v, is_told) if v >= 0 else method(record, arguments, n, names)


@native
def add_vertex(self: int, arguments: int, n: int, names: int) -> int:
    """``add_vertex(point=None)``."""
    record = record_of(self)
    desk = word_at(record, DESK)
    may = is_open(desk) and _has_room(desk, *OF_ADD_VERTEX)
    is_told = options_in(desk, arguments, 0, n, names, NO_PLACE) if may else -1
    if is_told < 0:
        return method(record, arguments, n, names)
    t = topology_at(word_at(desk, TOPOLOGY))
    v = try_add_vertex(t)
    return _answer(t, desk, v, is_told) if v >= 0 else method(record, arguments, n, names)


@native
def add_face(self: int, arguments: int, n: int, names: int) -> int:
    """``add_face(vertices)`` for lists and tuples of three or four."""
    record = record_of(self)
    desk = word_at(record, DESK)
    corners = word_at(arguments, 0)
    size = size_of(desk, corners) if n == 1 and names == 0 and is_open(desk) else -1
    if size < 3 or size > 4 or not _has_room(desk, *OF_ADD_FACE):
        return method(record, arguments, n, names)
    a = index_in(desk, item(desk, corners, 0), VERTEX)
    b = index_in(desk, item(desk, corners, 1), VERTEX)
    c = index_in(desk, item(desk, corners, 2), VERTEX)
    d = index_in(desk, item(desk, corners, size - 1), VERTEX)
    if a < 0 or b < 0 or c < 0 or d < 0:
        return method(record, arguments, n, names)
    t = topology_at(word_at(desk, TOPOLOGY))
    f = try_add_triangle(t, a, b, c) if size == 3 else try_add_quad(t, a, b, c, d)
    if f < 0:
        return method(record, arguments, n, names)
    return handle(desk, FACE, f) if caught_up(t, desk) else 0


@kernel
def _is_living(t: Any, h: int) -> bool:
    return h < 2 * edge_slots(t) and t.next[h] >= 0  # type: ignore[no-any-return]


@kernel
def _has_room(desk: int, n_vertices: int, n_edges: int, n_faces: int) -> bool:
    """Whether no column has to grow: what may run out of memory is left to Python, which can say so."""
    t, points = topology_at(word_at(desk, TOPOLOGY)), positions_at(word_at(desk, POINTS))
    n = t.counts[VERTEX_SLOTS] + n_vertices
    return (  # type: ignore[no-any-return]
        n <= len(t.vertex_halfedge)
        and n <= len(points.values)
        and 2 * (t.counts[EDGE_SLOTS] + n_edges) <= len(t.next)
        and t.counts[FACE_SLOTS] + n_faces <= len(t.face_halfedge)
    )


@kernel
def _note_less(t: Any, desk: int, is_placed: bool) -> int:
    """Have the operator note nothing where nobody follows but the points, and these are told; what to put back."""
    noting = t.counts[NOTING]
    if is_placed and word_at(desk, IS_ONLY) != 0 and noting == VERTICES:
        t.counts[NOTING] = 0
    return noting  # type: ignore[no-any-return]


@kernel
def _answer(t: Any, desk: int, v: int, is_told: int) -> int:
    """Let the points follow, by linear interpolation, put `v` there if it is told; a handle of it."""
    points = positions_at(word_at(desk, POINTS))
    size = t.counts[NOTES_SIZE]
    if size > 0:
        replay_notes(points.values, t.notes, t.weights, size, VERTICES, LERP, False)
        if word_at(desk, IS_ONLY) != 0 and t.counts[NOTING] == VERTICES:  # nobody else follows
            t.counts[NOTES_SIZE] = 0
            t.counts[NEWS] &= ~HAS_NOTES
    if is_told == 1:
        for i in range(3):
            points.values[v, i] = real_at(desk, X + i)
    return handle(desk, VERTEX, v) if caught_up(t, desk) else 0
