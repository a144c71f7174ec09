"""From parentheses back to columns, in one tour with two stacks."""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.compact.parentheses import is_opening, is_tree
from halfmesh.compact.topology import N_COMPONENTS, N_OPEN, CompactTopology
from halfmesh.core.topology import N_EXTERIOR, Topology, empty_columns

__all__ = ["decoded"]


def decoded(compact: CompactTopology) -> Topology:
    """The ordinary form, which can be changed: with the same vertices, edges and faces.

    Returns
    -------
    Topology
        The halfedges of edge `e` are ``2e`` and ``2e + 1``, in the order in which the compact mesh has them.

    Notes
    -----
    O(n). It takes, besides the result, 4 bytes per edge.
    """
    a = compact.__arrays__()
    n = compact.n_edges
    made = empty_columns(compact.n_vertices, n, compact.n_faces)
    made.counts[N_EXTERIOR] = a.counts[N_EXTERIOR]
    made.vertex_halfedge[:] = -1
    stack = np.empty(max(n, 1), np.int32)
    _unfold.at(2 * n)(
        compact, stack, made.next, made.prev, made.origin, made.face, made.vertex_halfedge, made.face_halfedge
    )
    return Topology(made)


@kernel
def _unfold(
    t: Any, stack: Any, next: Any, prev: Any, origin: Any, face: Any, vertex_halfedge: Any, face_halfedge: Any
) -> None:
    """Walk the tour. `stack` holds the open edges, those of the tree from its begin and the others from its end."""
    n_open, n_components = t.sizes[N_OPEN], t.sizes[N_COMPONENTS]
    n_vertices, n_nodes, n_holes, n_edges = n_components, n_components, 0, 0
    low, high = 0, len(stack)
    for c in range(n_components):
        vertex = c
        f = c - n_open if c >= n_open else -1
        before, first = -1, 2 * n_edges
        for i in range(t.starts[c], t.starts[c + 1]):
            tree = is_tree(t, i)
            is_new = is_opening(t, i)
            if is_new:
                h = 2 * n_edges
                n_edges += 1
            elif tree:
                low -= 1
                h = 2 * stack[low] + 1
            else:
                h = 2 * stack[high] + 1
                high += 1
            origin[h], face[h] = vertex, f
            if vertex_halfedge[vertex] < 0 or f < 0:
                vertex_halfedge[vertex] = h
            if f >= 0:
                face_halfedge[f] = h
            if before >= 0:
                next[before], prev[h] = h, before
            before = h if tree else h ^ 1
            if not is_new:
                if tree:
                    vertex = origin[h ^ 1]
                else:
                    f = face[h ^ 1]
            elif tree:
                stack[low] = h >> 1
                low += 1
                vertex = n_vertices
                n_vertices += 1
            else:
                high -= 1
                stack[high] = h >> 1
                if n_holes < len(t.holes) and t.holes[n_holes] == n_nodes:
                    f = -1
                    n_holes += 1
                else:
                    f = n_nodes - n_open - n_holes
                n_nodes += 1
        next[before], prev[first] = first, before
