"""Operators on a whole component, or on two meshes: turning around, taking away, putting one behind another.

A component is walked without recursion and without a set of what was seen: that is told by marks in the columns
themselves, which are taken away again before anybody looks. So the cost is that of the component, not of the mesh.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import grown, kernel, operation
from halfmesh.core.navigation import (
    ccw_of,
    edge_slots,
    face_of,
    face_slots,
    halfedge_of_face,
    halfedge_of_vertex,
    next_of,
    origin_of,
    prev_of,
    target_of,
    vertex_slots,
)
from halfmesh.core.notes import CORNERS, CYCLE, add_source, begin_note, is_noting
from halfmesh.core.operators.asking import sides_of, vertex_status
from halfmesh.core.pens import changed, set_halfedge_of_face, set_halfedge_of_vertex, set_next, set_origin, set_prev
from halfmesh.core.slots import delete_edge, delete_face, delete_vertex, is_full, reserve
from halfmesh.core.statuses import OK, TOO_LARGE
from halfmesh.core.topology import (
    DELETED,
    EDGE_SLOTS,
    FACE_SLOTS,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    N_EXTERIOR,
    VERTEX_SLOTS,
)

__all__ = [
    "append",
    "append_status",
    "component_of",
    "remove_component",
    "reverse",
    "reverse_component",
    "try_append",
    "try_remove_component",
    "try_reverse_component",
]

_SEEN = -2  # in place of a vertex's halfedge, while its component is walked


# -- a component ---------------------------------------------------------------------------------------------------


@kernel
def component_of(t: Any, v: int) -> Any:
    """The component of a vertex that has edges: its vertices, as their halfedges, and its edges, as their first ones.

    Breadth first. Each halfedge is in one ring, once, so that each edge is met once as the one with the even index.
    Cost: O(component).
    """
    vertices, edges = np.empty(16, np.int64), np.empty(16, np.int64)
    vertices[0] = halfedge_of_vertex(t, v)
    t.vertex_halfedge[v] = _SEEN
    done, n, m = 0, 1, 0
    while done < n:
        start = vertices[done]
        done += 1
        x = start
        while True:
            if x & 1 == 0:
                if m == len(edges):
                    edges = grown(edges, 2 * m)
                edges[m] = x
                m += 1
            w = target_of(t, x)
            if halfedge_of_vertex(t, w) != _SEEN:
                if n == len(vertices):
                    vertices = grown(vertices, 2 * n)
                vertices[n] = halfedge_of_vertex(t, w)
                t.vertex_halfedge[w] = _SEEN
                n += 1
            x = ccw_of(t, x)
            if x == start:
                break
    for i in range(n):
        t.vertex_halfedge[origin_of(t, vertices[i])] = vertices[i]
    return vertices[:n], edges[:m]


@kernel
def _everything(t: Any) -> Any:
    """The same for all components at once; isolated vertices left out."""
    vertices, edges = np.empty(vertex_slots(t), np.int64), np.empty(edge_slots(t), np.int64)
    n = m = 0
    for v in range(vertex_slots(t)):
        if halfedge_of_vertex(t, v) >= 0:
            vertices[n] = halfedge_of_vertex(t, v)
            n += 1
    for e in range(edge_slots(t)):
        if next_of(t, 2 * e) >= 0:
            edges[m] = 2 * e
            m += 1
    return vertices[:n], edges[:m]


# -- turned around -------------------------------------------------------------------------------------------------


@kernel
def reverse_component(t: Any, v: int) -> None:
    r"""Turn the component of `v` around: what was clockwise is counter-clockwise. Cost: O(component).

    ::

          c                        c
          | \                      ^ \
        g |   ^ k      -->       g |   \ k       around the face: h k g becomes h g k
          v  f  \                  |  f  v
          a -----> b               a <---- b
              h                        h

    Halfedges keep their faces and indices, and run the other way. The face's halfedge is afterwards the one before, so
    that the face begins at the same corner. What is said of corners stays with the corners, which are named by
    other halfedges now.
    """
    if halfedge_of_vertex(t, v) >= 0:
        vertices, edges = component_of(t, v)
        _reverse(t, vertices, edges)
    changed(t)


@operation
def try_reverse_component(t: Any, v: int) -> int:
    """Turn the component of `v` around, if there is such a vertex: 0, or the negative code."""
    status = vertex_status(t, v)
    if status == OK:
        reverse_component(t, v)
    return -status


@kernel
def reverse(t: Any) -> None:
    """Turn all components around, as `reverse_component` does one. Cost: O(mesh)."""
    vertices, edges = _everything(t)
    _reverse(t, vertices, edges)
    changed(t)


@kernel
def _reverse(t: Any, vertices: Any, edges: Any) -> None:
    for i in range(len(edges)):
        for side in range(2):
            if prev_of(t, edges[i] + side) >= 0:
                _begin_loop_elsewhere(t, edges[i] + side)
    for i in range(len(edges)):
        h = edges[i]
        for x in (h, h + 1):
            t.prev[x] = ~t.prev[x]  # unmarked, so that the pen finds what was there
            after, before = next_of(t, x), prev_of(t, x)
            set_next(t, x, before)
            set_prev(t, x, after)
        a, b = origin_of(t, h), origin_of(t, h + 1)
        set_origin(t, h, b)
        set_origin(t, h + 1, a)
    for i in range(len(vertices)):
        set_halfedge_of_vertex(t, target_of(t, vertices[i]), next_of(t, vertices[i]))


@kernel
def _begin_loop_elsewhere(t: Any, h: int) -> None:
    """Choose the halfedge of the face of `h` anew, note how its corners exchange their names, and mark its loop."""
    f = face_of(t, h)
    if f >= 0:
        set_halfedge_of_face(t, f, prev_of(t, halfedge_of_face(t, f)))
    noting = is_noting(t, CORNERS)
    if noting:
        begin_note(t, CYCLE, CORNERS, h, sides_of(t, h) - 1)
    x = h
    while True:
        t.prev[x] = ~t.prev[x]  # below zero: seen
        x = next_of(t, x)
        if x == h:
            break
        if noting:
            add_source(t, x, 1.0)


# -- taken away ----------------------------------------------------------------------------------------------------


@kernel
def remove_component(t: Any, v: int) -> None:
    """Remove all vertices, edges and faces of the component of `v`. Cost: O(component)."""
    if halfedge_of_vertex(t, v) < 0:
        delete_vertex(t, v)
    else:
        vertices, edges = component_of(t, v)
        for i in range(len(vertices)):
            delete_vertex(t, origin_of(t, vertices[i]))
        for i in range(len(edges)):
            for x in (edges[i], edges[i] + 1):
                f = face_of(t, x)
                if f >= 0 and halfedge_of_face(t, f) != DELETED:
                    delete_face(t, f)
            delete_edge(t, edges[i])
    changed(t)


@operation
def try_remove_component(t: Any, v: int) -> int:
    """Remove the component of `v`, if there is such a vertex: 0, or the negative code."""
    status = vertex_status(t, v)
    if status == OK:
        remove_component(t, v)
    return -status


# -- two meshes ----------------------------------------------------------------------------------------------------


@kernel
def append_status(t: Any, s: Any) -> int:
    """Whether the elements of `s` can be numbered after those of `t`: ``OK`` or a code. Cost: O(1)."""
    return TOO_LARGE if is_full(t, vertex_slots(s), edge_slots(s), face_slots(s)) else OK


@kernel
def append(t: Any, s: Any) -> int:
    """Put a copy of mesh `s` behind `t`, which may be the same; returns the first new vertex.

    Indices go on: element `i` of `s` is the first new one of its kind plus `i`. Deleted ones stay deleted.
    Cost: O(size of `s`), amortised.
    """
    v, e, f = vertex_slots(t), edge_slots(t), face_slots(t)
    nv, ne, nf = vertex_slots(s), edge_slots(s), face_slots(s)
    _make_room(t, nv, ne, nf)
    h = 2 * e
    for x in range(2 * ne):
        alive = s.next[x] != DELETED
        t.next[h + x] = s.next[x] + h if alive else DELETED
        t.prev[h + x] = s.prev[x] + h if alive else DELETED
        t.origin[h + x] = s.origin[x] + v if alive else DELETED
        t.face[h + x] = s.face[x] + f if s.face[x] >= 0 else s.face[x]
    for u in range(nv):
        x = s.vertex_halfedge[u]
        t.vertex_halfedge[v + u] = x + h if x >= 0 else x
    for g in range(nf):
        x = s.face_halfedge[g]
        t.face_halfedge[f + g] = x + h if x >= 0 else x
    for place in (N_DEAD_VERTICES, N_DEAD_EDGES, N_DEAD_FACES, N_EXTERIOR):
        t.counts[place] += s.counts[place]
    t.counts[VERTEX_SLOTS] = v + nv
    t.counts[EDGE_SLOTS] = e + ne
    t.counts[FACE_SLOTS] = f + nf
    changed(t)
    return v


@kernel
def _make_room(t: Any, n_vertices: int, n_edges: int, n_faces: int) -> None:
    """As `reserve`, but by half at least of what is there, so that many small meshes may be appended one by one."""
    if vertex_slots(t) + n_vertices > len(t.vertex_halfedge):
        reserve(t, max(n_vertices, vertex_slots(t) // 2), 0, 0)
    if 2 * (edge_slots(t) + n_edges) > len(t.next):
        reserve(t, 0, max(n_edges, edge_slots(t) // 2), 0)
    if face_slots(t) + n_faces > len(t.face_halfedge):
        reserve(t, 0, 0, max(n_faces, face_slots(t) // 2))


@kernel
def try_append(t: Any, s: Any) -> int:
    """Put a copy of mesh `s` behind `t`, if indices go so far: the first new vertex, or the negative code."""
    status = append_status(t, s)
    return -status if status != OK else append(t, s)
