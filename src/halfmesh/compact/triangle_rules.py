r"""The rules of the triangle layout: a triangle is its three halfedges, in a row.

::

             2                halfedge 3f + k leaves corner k of face f, so next, prev and face are arithmetic
            / \               only origin and twin are stored
    3f + 2 /   \ 3f + 1
          /  f  \             exterior halfedges come after all others; they keep their next and prev, since loops
         0-------1            that meet at a vertex could be linked in several ways
          3f + 0

An edge has no number that is stored: edges are counted by their first halfedges, which is their order in a mesh made
from the same face list. How many came before is kept for every 64 halfedges; the rest is counted when asked for.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import rule
from halfmesh.core.topology import FACE_SLOTS

__all__ = [
    "ccw_of",
    "cw_of",
    "edge_of",
    "face_of",
    "halfedge_of_edge",
    "halfedge_of_face",
    "is_boundary_edge",
    "is_boundary_vertex",
    "is_exterior",
    "next_of",
    "opposite_face_of",
    "prev_of",
    "target_of",
    "twin_of",
]

BLOCK = 64  # halfedges; 4 bytes for each so many: 0.19 bytes a triangle


@rule
def twin_of(t: Any, h: Any) -> Any:
    return t.twin[h]


@rule
def face_of(t: Any, h: Any) -> Any:
    return h // 3 if h < 3 * t.counts[FACE_SLOTS] else -1


@rule
def next_of(t: Any, h: Any) -> Any:
    if h < 3 * t.counts[FACE_SLOTS]:
        return h - 2 if h % 3 == 2 else h + 1
    return t.exterior_next[h - 3 * t.counts[FACE_SLOTS]]


@rule
def prev_of(t: Any, h: Any) -> Any:
    if h < 3 * t.counts[FACE_SLOTS]:
        return h + 2 if h % 3 == 0 else h - 1
    return t.exterior_prev[h - 3 * t.counts[FACE_SLOTS]]


@rule
def target_of(t: Any, h: Any) -> Any:
    return t.origin[t.twin[h]]


@rule
def opposite_face_of(t: Any, h: Any) -> Any:
    return face_of(t, t.twin[h])


@rule
def ccw_of(t: Any, h: Any) -> Any:
    return t.twin[prev_of(t, h)]


@rule
def cw_of(t: Any, h: Any) -> Any:
    return next_of(t, t.twin[h])


@rule
def is_exterior(t: Any, h: Any) -> Any:
    return h >= 3 * t.counts[FACE_SLOTS]


@rule
def is_boundary_edge(t: Any, e: Any) -> Any:
    return is_exterior(t, t.twin[halfedge_of_edge(t, e)])


@rule
def is_boundary_vertex(t: Any, v: Any) -> Any:
    return t.vertex_halfedge[v] >= 3 * t.counts[FACE_SLOTS]


@rule
def halfedge_of_face(t: Any, f: Any) -> Any:
    return 3 * f


# -- edges, counted by their first halfedges ------------------------------------------------------------------------


@rule
def edge_of(t: Any, h: Any) -> Any:
    first = min(h, t.twin[h])
    e = t.edges_before[first // BLOCK]
    for x in range(first // BLOCK * BLOCK, first):
        e += int(t.twin[x] > x)
    return e


@rule
def halfedge_of_edge(t: Any, e: Any) -> Any:
    low, high = 0, len(t.edges_before) - 1  # the block is the last that begins with no more than e before it
    while low < high:
        middle = (low + high + 1) // 2
        if t.edges_before[middle] <= e:
            low = middle
        else:
            high = middle - 1
    left = e - t.edges_before[low]
    h = low * BLOCK
    while left > 0 or t.twin[h] < h:
        left -= int(t.twin[h] > h)
        h += 1
    return h
