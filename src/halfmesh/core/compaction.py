"""Removing what was deleted: the living move together, in their order, and old indices are mapped to new."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.topology import (
    DELETED,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    REVISION,
    Topology,
    empty_columns,
)

__all__ = ["Maps", "compact", "numbered"]

Ints = NDArray[np.int32]


@dataclass(frozen=True)
class Maps:
    """The new index of every old one, by kind; -1 for what was deleted.

    Attributes
    ----------
    vertices, halfedges, edges, faces : ndarray of int32
        One entry for each old index. Where ``map >= 0`` they ascend: the order is kept.
    """

    vertices: Ints
    halfedges: Ints
    edges: Ints
    faces: Ints


def compact(t: Topology) -> Maps:
    """Remove what was deleted from the columns, which are replaced by new ones without spare room. O(n)."""
    old = t.__arrays__()
    maps = numbered(t.vertex_halfedge != DELETED, t.next[::2] != DELETED, t.face_halfedge != DELETED)
    vertices, edges, faces = maps.vertices, maps.edges, maps.faces
    if not old.counts[N_DEAD_VERTICES : N_DEAD_FACES + 1].any():
        return maps
    sizes = [int((of >= 0).sum()) for of in (vertices, edges, faces)]
    made = empty_columns(*sizes)
    new = [made.next, made.prev, made.origin, made.face, made.vertex_halfedge, made.face_halfedge]
    _move.at(len(t.next))(t, vertices, maps.halfedges, faces, *new)
    made.counts = old.counts
    made.counts[:3] = sizes
    made.counts[[N_DEAD_VERTICES, N_DEAD_EDGES, N_DEAD_FACES]] = 0
    made.counts[REVISION] += 1
    t._replace(made)
    return maps


def numbered(vertices: NDArray[np.bool_], edges: NDArray[np.bool_], faces: NDArray[np.bool_]) -> Maps:
    """The maps that keep the order of those that are to stay."""
    of_edges = _numbered(edges)
    halfedges = np.where(of_edges >= 0, 2 * of_edges, -1).repeat(2)
    halfedges[1::2] += halfedges[1::2] >= 0
    return Maps(_numbered(vertices), halfedges.astype(np.int32), of_edges, _numbered(faces))


def _numbered(alive: NDArray[np.bool_]) -> Ints:
    return np.where(alive, np.cumsum(alive) - 1, -1).astype(np.int32)


@kernel
def _move(
    t: Any, vertices: Any, halfedges: Any, faces: Any,
    next: Any, prev: Any, origin: Any, face: Any, vertex_halfedge: Any, face_halfedge: Any,
) -> None:  # fmt: skip
    for h in range(len(halfedges)):
        x = halfedges[h]
        if x >= 0:
            next[x] = halfedges[t.next[h]]
            prev[x] = halfedges[t.prev[h]]
            origin[x] = vertices[t.origin[h]]
            face[x] = faces[t.face[h]] if t.face[h] >= 0 else -1
    for v in range(len(vertices)):
        if vertices[v] >= 0:
            g = t.vertex_halfedge[v]
            vertex_halfedge[vertices[v]] = halfedges[g] if g >= 0 else -1
    for f in range(len(faces)):
        if faces[f] >= 0:
            face_halfedge[faces[f]] = halfedges[t.face_halfedge[f]]
