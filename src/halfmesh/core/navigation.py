r"""The rules: how to get from one element to another. Each is one line, and stands nowhere else.

::

                     target
                       o
              next    /|\        twin(h) = h ^ 1      the same edge, the other way
                <--  / | \       edge(h) = h >> 1
                    /  |  \
        face(h)    /   |h  \     ccw(h) = twin(prev)   the next halfedge around the origin, counter-clockwise
                   \   |   /      cw(h) = next(twin)    ... clockwise
                    \  |  /
                -->  \ | /
              prev    \|/
                       o
                     origin

A rule works on an int and, but for the last two, on an array of ints (one line per law in `invariants`). It serves
compiled kernels, interpreted handles and the validator alike. Rules do not check: following a -1 is the caller's
mistake, and array rules that might meet one range-check it themselves.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import rule
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, VERTEX_SLOTS

__all__ = [
    "ccw_of",
    "cw_of",
    "edge_of",
    "edge_slots",
    "face_of",
    "face_slots",
    "halfedge_of_edge",
    "halfedge_of_face",
    "halfedge_of_vertex",
    "halfedge_slots",
    "is_boundary_edge",
    "is_boundary_vertex",
    "is_exterior",
    "is_isolated",
    "next_of",
    "opposite_face_of",
    "origin_of",
    "prev_of",
    "target_of",
    "twin_of",
    "vertex_slots",
]

# -- from a halfedge ---------------------------------------------------------------------------------------------


@rule
def twin_of(t: Any, h: Any) -> Any:
    """The other halfedge of the same edge."""
    return h ^ 1


@rule
def edge_of(t: Any, h: Any) -> Any:
    """The edge of a halfedge."""
    return h >> 1


@rule
def next_of(t: Any, h: Any) -> Any:
    """The halfedge after `h` around its face or boundary loop."""
    return t.next[h]


@rule
def prev_of(t: Any, h: Any) -> Any:
    """The halfedge before `h` around its face or boundary loop."""
    return t.prev[h]


@rule
def origin_of(t: Any, h: Any) -> Any:
    """The vertex that `h` leaves."""
    return t.origin[h]


@rule
def target_of(t: Any, h: Any) -> Any:
    """The vertex that `h` arrives at."""
    return t.origin[h ^ 1]


@rule
def face_of(t: Any, h: Any) -> Any:
    """The face on the left of `h`, -1 for an exterior halfedge."""
    return t.face[h]


@rule
def opposite_face_of(t: Any, h: Any) -> Any:
    """The face on the right of `h`, -1 if its twin is exterior."""
    return t.face[h ^ 1]


@rule
def ccw_of(t: Any, h: Any) -> Any:
    """The next halfedge counter-clockwise around the origin of `h`."""
    return t.prev[h] ^ 1


@rule
def cw_of(t: Any, h: Any) -> Any:
    """The next halfedge clockwise around the origin of `h`."""
    return t.next[h ^ 1]


@rule
def is_exterior(t: Any, h: Any) -> Any:
    """Whether there is no face on the left of `h`."""
    return t.face[h] < 0


# -- from an edge, a vertex, a face ------------------------------------------------------------------------------


@rule
def halfedge_of_edge(t: Any, e: Any) -> Any:
    """The first of the two halfedges of an edge."""
    return e << 1


@rule
def halfedge_of_vertex(t: Any, v: Any) -> Any:
    """A halfedge that leaves `v`: an exterior one if there is any; -1 if `v` is isolated."""
    return t.vertex_halfedge[v]


@rule
def halfedge_of_face(t: Any, f: Any) -> Any:
    """A halfedge of face `f`: that of the first listed corner, in a mesh made from a face list."""
    return t.face_halfedge[f]


@rule
def is_boundary_edge(t: Any, e: Any) -> Any:
    """Whether one side of the edge (or both) has no face."""
    return (t.face[2 * e] < 0) | (t.face[2 * e + 1] < 0)


@rule
def is_isolated(t: Any, v: Any) -> Any:
    """Whether no edge touches `v`."""
    return t.vertex_halfedge[v] == -1


@rule
def is_boundary_vertex(t: Any, v: Any) -> Any:
    """Whether `v` touches a gap; an isolated vertex does not."""
    # the product turns -1 (isolated) into 0, which may be looked at, without a branch
    return (t.vertex_halfedge[v] >= 0) & (t.face[t.vertex_halfedge[v] * (t.vertex_halfedge[v] >= 0)] < 0)


# -- sizes: indices run below these, deleted elements included ---------------------------------------------------


@rule
def vertex_slots(t: Any) -> Any:
    """Vertex indices are below this number."""
    return t.counts[VERTEX_SLOTS]


@rule
def halfedge_slots(t: Any) -> Any:
    """Halfedge indices are below this number."""
    return 2 * t.counts[EDGE_SLOTS]


@rule
def edge_slots(t: Any) -> Any:
    """Edge indices are below this number."""
    return t.counts[EDGE_SLOTS]


@rule
def face_slots(t: Any) -> Any:
    """Face indices are below this number."""
    return t.counts[FACE_SLOTS]
