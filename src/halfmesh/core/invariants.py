"""The laws of a valid mesh, one line each: the definition of "valid", and the oracle of every test.

A law returns the elements that break it. All but the two orbit laws are vectorised; the orbit laws walk, at most as
far as there are halfedges, so that corrupt data is reported and never hangs the check.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.topology import (
    DELETED,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    N_EXTERIOR,
    Topology,
)
from halfmesh.errors import InvalidMeshError

__all__ = ["LAWS", "check"]

Bad = NDArray[np.integer]


def check(t: Topology) -> None:
    """Raise :class:`InvalidMeshError` if a law is broken, naming the law and the elements. Complexity: O(n)."""
    for law, kind in LAWS.items():
        bad = law(t)
        if len(bad):
            shown = ", ".join(map(str, bad[:5])) + (", ..." if len(bad) > 5 else "")
            raise InvalidMeshError(
                f"law '{law.__name__}' is broken by {len(bad)} {kind}: {shown}. {law.__doc__}",
                reason=law.__name__,
                elements={kind: bad},
            )


def _halfedges(t: Topology) -> Bad:
    return np.flatnonzero(t.next != DELETED)


def _vertices(t: Topology) -> Bad:
    return np.flatnonzero(t.vertex_halfedge >= 0)


def _faces(t: Topology) -> Bad:
    return np.flatnonzero(t.face_halfedge != DELETED)


# -- ranges: checked first, the other laws may then look up what they like ------------------------------------------


def halfedge_links_in_range(t: Topology) -> Bad:
    """Next and prev are halfedges, origin is a vertex, face is a face or -1."""
    n, h = len(t.next), _halfedges(t)
    linked = (t.next[h] >= 0) & (t.next[h] < n) & (t.prev[h] >= 0) & (t.prev[h] < n)
    placed = (t.origin[h] >= 0) & (t.origin[h] < len(t.vertex_halfedge))
    return h[~(linked & placed & (t.face[h] >= -1) & (t.face[h] < len(t.face_halfedge)))]


def vertex_halfedge_in_range(t: Topology) -> Bad:
    """The halfedge of a vertex is a halfedge, or -1 if the vertex is isolated."""
    v = np.flatnonzero(t.vertex_halfedge != DELETED)
    return v[(t.vertex_halfedge[v] < -1) | (t.vertex_halfedge[v] >= len(t.next))]


def face_halfedge_in_range(t: Topology) -> Bad:
    """The halfedge of a face is a halfedge."""
    f = _faces(t)
    return f[(t.face_halfedge[f] < 0) | (t.face_halfedge[f] >= len(t.next))]


def edges_live_whole(t: Topology) -> Bad:
    """The two halfedges of an edge are deleted together."""
    return np.flatnonzero((t.next[::2] == DELETED) != (t.next[1::2] == DELETED))


def the_deleted_are_marked_throughout(t: Topology) -> Bad:
    """A deleted halfedge has the mark in all four columns, which is how handles notice."""
    marks = np.stack([t.next == DELETED, t.prev == DELETED, t.origin == DELETED, t.face == DELETED])
    return np.flatnonzero(marks.any(axis=0) & ~marks.all(axis=0))


def nothing_alive_refers_to_deleted(t: Topology) -> Bad:
    """next, prev, origin and face of a living halfedge are alive."""
    h = _halfedges(t)
    f = face_of(t, h)
    dead_face = np.zeros(len(h), dtype=bool)
    dead_face[f >= 0] = t.face_halfedge[f[f >= 0]] == DELETED
    dead = (t.next[next_of(t, h)] == DELETED) | (t.next[prev_of(t, h)] == DELETED)
    return h[dead | (t.vertex_halfedge[origin_of(t, h)] == DELETED) | dead_face]


def vertex_halfedge_is_alive(t: Topology) -> Bad:
    """The halfedge of a vertex is alive."""
    v = _vertices(t)
    return v[t.next[t.vertex_halfedge[v]] == DELETED]


def face_halfedge_is_alive(t: Topology) -> Bad:
    """The halfedge of a face is alive."""
    f = _faces(t)
    return f[t.next[t.face_halfedge[f]] == DELETED]


# -- links ----------------------------------------------------------------------------------------------------------


def prev_undoes_next(t: Topology) -> Bad:
    """prev(next(h)) = h and next(prev(h)) = h."""
    h = _halfedges(t)
    return h[(prev_of(t, next_of(t, h)) != h) | (next_of(t, prev_of(t, h)) != h)]


def next_starts_where_this_ends(t: Topology) -> Bad:
    """origin(next(h)) = target(h)."""
    h = _halfedges(t)
    return h[origin_of(t, next_of(t, h)) != target_of(t, h)]


def next_stays_in_the_face(t: Topology) -> Bad:
    """face(next(h)) = face(h)."""
    h = _halfedges(t)
    return h[face_of(t, next_of(t, h)) != face_of(t, h)]


def vertex_halfedge_leaves_the_vertex(t: Topology) -> Bad:
    """origin(halfedge(v)) = v."""
    v = _vertices(t)
    return v[origin_of(t, t.vertex_halfedge[v]) != v]


def face_halfedge_is_in_the_face(t: Topology) -> Bad:
    """face(halfedge(f)) = f."""
    f = _faces(t)
    return f[face_of(t, t.face_halfedge[f]) != f]


def isolated_vertices_have_no_halfedge(t: Topology) -> Bad:
    """No halfedge leaves a vertex whose halfedge is -1."""
    h = _halfedges(t)
    return np.unique(origin_of(t, h[t.vertex_halfedge[origin_of(t, h)] == -1]))


def gaps_are_found_at_once(t: Topology) -> Bad:
    """The halfedge of a vertex that touches a gap is exterior."""
    h = _halfedges(t)
    v = np.unique(origin_of(t, h[is_exterior(t, h)]))
    return v[~is_exterior(t, t.vertex_halfedge[v])] if len(v) else v


# -- orbits ---------------------------------------------------------------------------------------------------------


def one_ring_holds_all_of_a_vertex(t: Topology) -> Bad:
    """Turning ccw from halfedge(v) meets every halfedge that leaves v, once."""
    halfedges = np.arange(len(t.next), dtype=np.int32)
    return _broken_orbits(t.vertex_halfedge, ccw_of(t, halfedges), origin_of(t, _halfedges(t)))


def one_loop_holds_all_of_a_face(t: Topology) -> Bad:
    """Following next from halfedge(f) meets every halfedge of f, once."""
    f = face_of(t, _halfedges(t))
    return _broken_orbits(t.face_halfedge, t.next, f[f >= 0])


def _broken_orbits(starts: Any, follower: Any, members: Any) -> Bad:
    """The elements whose orbit from `starts` along `follower` does not close after as many steps as it has members."""
    sizes = np.bincount(members, minlength=max(len(starts), 1)).astype(np.int32)
    bad = np.zeros(len(sizes), dtype=np.uint8)
    _walk_orbits.at(len(follower))(np.array(starts), np.array(follower), sizes, bad)
    return np.flatnonzero(bad)


@kernel
def _walk_orbits(starts: Any, follower: Any, sizes: Any, bad: Any) -> None:
    for x in range(len(starts)):
        start = starts[x]
        if start >= 0:
            h, n = follower[start], 1
            while h != start and n <= sizes[x]:
                h = follower[h]
                n += 1
            bad[x] = n != sizes[x]


def counts_are_true(t: Topology) -> Bad:
    """The kept numbers of deleted elements and of exterior halfedges are right; the places in `counts` are named."""
    counts, h = t.__arrays__().counts, _halfedges(t)
    found = {
        N_DEAD_VERTICES: np.count_nonzero(t.vertex_halfedge == DELETED),
        N_DEAD_EDGES: np.count_nonzero(t.next == DELETED) // 2,
        N_DEAD_FACES: np.count_nonzero(t.face_halfedge == DELETED),
        N_EXTERIOR: np.count_nonzero(is_exterior(t, h)),
    }
    return np.array([place for place, n in found.items() if counts[place] != n], dtype=np.int64)


LAWS: dict[Callable[[Topology], Bad], str] = {
    halfedge_links_in_range: "halfedges",
    vertex_halfedge_in_range: "vertices",
    face_halfedge_in_range: "faces",
    edges_live_whole: "edges",
    the_deleted_are_marked_throughout: "halfedges",
    nothing_alive_refers_to_deleted: "halfedges",
    vertex_halfedge_is_alive: "vertices",
    face_halfedge_is_alive: "faces",
    prev_undoes_next: "halfedges",
    next_starts_where_this_ends: "halfedges",
    next_stays_in_the_face: "halfedges",
    vertex_halfedge_leaves_the_vertex: "vertices",
    face_halfedge_is_in_the_face: "faces",
    isolated_vertices_have_no_halfedge: "vertices",
    gaps_are_found_at_once: "vertices",
    one_ring_holds_all_of_a_vertex: "vertices",
    one_loop_holds_all_of_a_face: "faces",
    counts_are_true: "counts",
}
"""Every law and the kind of element it names; in this order, since the later ones rely on the earlier."""
