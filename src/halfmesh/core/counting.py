"""Counts that need a pass over the mesh: components, boundary loops, vertices by kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.navigation import (
    edge_slots,
    halfedge_of_edge,
    is_boundary_vertex,
    next_of,
    origin_of,
    target_of,
    vertex_slots,
)
from halfmesh.core.topology import DELETED, Topology

__all__ = ["Components", "boundary_loops", "components", "vertex_kinds"]

Ints = NDArray[np.int32]


@dataclass(frozen=True)
class Components:
    """The connected components of a mesh, in the order of their lowest vertex; isolated vertices are components.

    Attributes
    ----------
    vertex_component : ndarray of int32, shape (n vertex slots,)
        The component of each vertex, -1 for deleted ones.
    n_vertices, n_edges, n_faces, n_boundary_loops : ndarray of int64, shape (n_components,)
    """

    vertex_component: Ints
    n_vertices: NDArray[np.int64]
    n_edges: NDArray[np.int64]
    n_faces: NDArray[np.int64]
    n_boundary_loops: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.n_vertices)

    @property
    def euler_characteristic(self) -> NDArray[np.int64]:
        """V - E + F of each component."""
        return self.n_vertices - self.n_edges + self.n_faces

    @property
    def genus(self) -> NDArray[np.int64]:
        """Handles of each component with its holes capped; 0 for an isolated vertex."""
        capped = self.euler_characteristic + self.n_boundary_loops
        return np.where(self.n_edges == 0, 0, (2 - capped) // 2)


def components(t: Topology) -> Components:
    """Find the connected components: vertices joined by edges. Complexity: O(n)."""
    n = len(t.vertex_halfedge)
    label = np.empty(max(n, 1), dtype=np.int32)
    _join.at(n)(t, label)
    label = label[:n]
    alive = t.vertex_halfedge != DELETED
    roots = np.flatnonzero(alive & (label == np.arange(n)))
    number = np.full(max(n, 1), -1, dtype=np.int32)
    number[roots] = np.arange(len(roots), dtype=np.int32)
    of_vertex = np.where(alive, number[label], -1).astype(np.int32)

    def tally(vertices: Any) -> NDArray[np.int64]:
        return np.bincount(of_vertex[vertices], minlength=len(roots))

    halfedges, offsets = boundary_loops(t)
    sides = halfedge_of_edge(t, np.arange(edge_slots(t)))
    living_faces = t.face_halfedge[t.face_halfedge != DELETED]
    return Components(
        of_vertex,
        tally(np.flatnonzero(alive)),
        tally(t.origin[sides[t.next[sides] != DELETED]]),
        tally(t.origin[living_faces]),
        tally(t.origin[halfedges[offsets[:-1]]]),
    )


@kernel
def _join(t: Any, label: Any) -> None:
    """Union-find over the edges, the lower vertex as root; flat afterwards."""
    for v in range(vertex_slots(t)):
        label[v] = v
    for e in range(edge_slots(t)):
        h = halfedge_of_edge(t, e)
        if next_of(t, h) >= 0:
            a, b = origin_of(t, h), target_of(t, h)
            while label[a] != a:
                label[a] = label[label[a]]
                a = label[a]
            while label[b] != b:
                label[b] = label[label[b]]
                b = label[b]
            if a < b:
                label[b] = a
            elif b < a:
                label[a] = b
    for v in range(vertex_slots(t)):
        label[v] = label[label[v]]


def boundary_loops(t: Topology) -> tuple[Ints, Ints]:
    """The exterior halfedges, loop after loop, and where each loop begins: (halfedges, offsets).

    Each loop starts at its lowest halfedge; the loops are in the order of their first. Complexity: O(n).
    """
    exterior = np.flatnonzero((t.face < 0) & (t.next >= 0)).astype(np.int32)
    seen = np.zeros(max(len(t.next), 1), dtype=np.uint8)
    halfedges = np.empty(max(len(exterior), 1), dtype=np.int32)
    offsets = np.zeros(len(exterior) + 1, dtype=np.int32)
    n = _trace.at(len(exterior))(t, exterior, seen, halfedges, offsets)
    return halfedges[: len(exterior)], offsets[: n + 1]


@kernel
def _trace(t: Any, exterior: Any, seen: Any, halfedges: Any, offsets: Any) -> int:
    """Follow next from each exterior halfedge not seen yet; returns the number of loops."""
    n, place = 0, 0
    for i in range(len(exterior)):
        h = exterior[i]
        if seen[h] == 0:
            while seen[h] == 0:
                seen[h] = 1
                halfedges[place] = h
                place += 1
                h = next_of(t, h)
            n += 1
            offsets[n] = place
    return n


def vertex_kinds(t: Topology) -> tuple[int, int, int]:
    """How many vertices are interior, boundary, isolated. Complexity: O(n)."""
    v = np.arange(len(t.vertex_halfedge))
    n_alive = int(np.count_nonzero(t.vertex_halfedge != DELETED))
    n_isolated = int(np.count_nonzero(t.vertex_halfedge == -1))
    n_boundary = int(np.count_nonzero(is_boundary_vertex(t, v))) if len(v) else 0
    return n_alive - n_boundary - n_isolated, n_boundary, n_isolated
