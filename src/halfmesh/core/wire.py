"""Wire: edges without faces, hung into the gaps of a mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.listing import listed
from halfmesh.core.topology import N_EXTERIOR, Arrays, Topology, empty_columns
from halfmesh.errors import InvalidMeshError

__all__ = ["with_wire"]

Ints = NDArray[np.int32]


def with_wire(t: Topology, edges: Ints) -> Topology:
    """The topology with these edges added, numbered after the edges of faces, in their order.

    Parameters
    ----------
    edges : ndarray of shape (n, 2)
        Pairs of vertices. Neither loops, nor an edge twice, nor one that a face has already.

    Raises
    ------
    InvalidMeshError
        Naming all edges that can't be added: out of range, loops, parallels, or at a vertex closed by faces.
    """
    _refuse_bad_ends(t, edges)
    _refuse_parallels(t, edges)
    old = t.__arrays__()
    n_old, n_new = int(old.counts[1]), len(edges)
    arrays = empty_columns(len(t.vertex_halfedge), n_old + n_new, len(t.face_halfedge))
    for name in ("next", "prev", "origin", "face"):
        getattr(arrays, name)[: 2 * n_old] = getattr(t, name)
    arrays.vertex_halfedge[:] = old.vertex_halfedge
    arrays.face_halfedge[:] = old.face_halfedge
    arrays.origin[2 * n_old :] = edges.reshape(-1)
    arrays.face[2 * n_old :] = -1
    arrays.counts[N_EXTERIOR] = old.counts[N_EXTERIOR] + 2 * n_new
    made = Topology(arrays)
    closed = np.flatnonzero(_closed(arrays, edges))
    if len(closed):
        raise InvalidMeshError(
            f"edges: {listed(closed, 'row ')} end at a vertex that faces close all around, where no edge fits in; "
            "open a gap there, or leave the edge out",
            reason="closed_vertex",
            elements={"edges": edges[closed], "rows": closed},
        )
    _attach_all.at(n_new)(made, n_old)
    return made


def _closed(arrays: Arrays, edges: Ints) -> Any:
    start = arrays.vertex_halfedge[edges]
    return ((start >= 0) & (arrays.face[np.maximum(start, 0)] >= 0)).any(axis=1)


def _refuse_bad_ends(t: Topology, edges: Ints) -> None:
    n = len(t.vertex_halfedge)
    wild = np.flatnonzero(((edges < 0) | (edges >= n)).any(axis=1))
    if len(wild):
        raise InvalidMeshError(
            f"edges: {listed(wild, 'row ')} have an index out of range 0..{n - 1}",
            reason="index_out_of_range",
            elements={"rows": wild},
        )
    loops = np.flatnonzero(edges[:, 0] == edges[:, 1])
    if len(loops):
        raise InvalidMeshError(
            f"edges: {listed(loops, 'row ')} join a vertex to itself; loop edges come from add_edge or twins=",
            reason="loop_edge",
            elements={"rows": loops, "edges": edges[loops]},
        )


def _refuse_parallels(t: Topology, edges: Ints) -> None:
    n = max(len(t.vertex_halfedge), 1)
    keys = np.r_[_keys(t.origin.reshape(-1, 2), n), _keys(edges, n)]
    _, first = np.unique(keys, return_index=True)
    is_first = np.zeros(len(keys), dtype=bool)
    is_first[first] = True
    again = np.flatnonzero(~is_first[len(t.next) // 2 :])
    if len(again):
        raise InvalidMeshError(
            f"edges: {listed(again, 'row ')} join vertices that an edge joins already; "
            "drop them (parallel edges come from add_edge or twins=)",
            reason="parallel_edge",
            elements={"rows": again, "edges": edges[again]},
        )


def _keys(pairs: Ints, n: int) -> NDArray[np.int64]:
    low, high = np.sort(pairs, axis=1).T.astype(np.int64)
    return low * n + high  # type: ignore[no-any-return]


@kernel
def _attach_all(t: Any, first: int) -> None:
    for e in range(first, t.counts[1]):
        _attach_end(t, 2 * e)
        _attach_end(t, 2 * e + 1)


@kernel
def _attach_end(t: Any, h: int) -> None:
    r"""Hang the origin of the new halfedge `h` into the gap of its vertex.

    ::

        before \      / gap           before \   h    / gap
                v    v          -->            v ^  | v
                  (v)                           (v)
    """
    v = t.origin[h]
    gap = t.vertex_halfedge[v]
    before = h ^ 1
    if gap >= 0:
        before = t.prev[gap]
        t.next[h ^ 1] = gap
        t.prev[gap] = h ^ 1
    else:
        t.vertex_halfedge[v] = h
    t.next[before] = h
    t.prev[h] = before
