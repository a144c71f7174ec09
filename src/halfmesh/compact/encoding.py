"""From columns to parentheses: choose a spanning tree, walk around it, write down what is met.

What is left of the edges when a tree has taken its own is a tree of the faces and holes, in every component that can
be drawn on a sphere.

The tour keeps the tree at its right hand: from `h` on to ``next(h)`` if `h` is of the tree, else, over `h`, to
``cw(h)``. So it comes past every halfedge once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.compact.carrier import counts_of
from halfmesh.compact.directory import add_directory, n_words
from halfmesh.compact.navigation import first_of_node
from halfmesh.compact.parentheses import is_opening, is_tree
from halfmesh.compact.planting import find_loops, has_bit, plant
from halfmesh.compact.topology import Arrays, CompactTopology
from halfmesh.compact.touring import tour
from halfmesh.core.compaction import Maps
from halfmesh.core.counting import components
from halfmesh.core.navigation import cw_of, edge_of, face_of, is_exterior, next_of, twin_of
from halfmesh.core.topology import (
    EDGE_SLOTS,
    FACE_SLOTS,
    N_DEAD_EDGES,
    N_DEAD_FACES,
    N_DEAD_VERTICES,
    N_EXTERIOR,
    VERTEX_SLOTS,
    Topology,
)
from halfmesh.errors import PreconditionError

__all__ = ["Encoded", "compacted", "maps_of"]

Ints = NDArray[np.int32]


@dataclass(frozen=True)
class Encoded:
    """What an encoding gives: the compact mesh, and where its elements come from.

    Attributes
    ----------
    topology : CompactTopology
    vertices : ndarray of int32
        The old index of every new vertex: ``points[vertices]`` are the points of the compact mesh.
    roots : ndarray of int32
        The old index of the first halfedge of every component; what `maps_of` begins with.
    """

    topology: CompactTopology
    vertices: Ints
    roots: Ints


def compacted(t: Topology) -> Encoded:
    """Encode a mesh of which every component can be drawn on a sphere; what was deleted is left out.

    Raises
    ------
    PreconditionError
        If a component has handles; it says which one and how many.

    Notes
    -----
    O(n). It takes, besides the result, 4 bytes per vertex and four bits per edge.

    Examples
    --------
    >>> import halfmesh as hm
    >>> from halfmesh.compact.encoding import compacted
    >>> made = compacted(hm.shapes.grid(100, 100).topology)
    >>> made.topology
    <CompactTopology: 10201 vertices, 20200 edges, 10000 faces>
    >>> round(made.topology.bits_per_edge, 1)
    4.7
    """
    n_vertices, n_edges, n_faces = _living(t)
    n_slots = [int(n) for n in t.__arrays__().counts[:3]]
    has_boundary = t.__arrays__().counts[N_EXTERIOR] > 0
    touches, late = _bits_for(n_slots[0]), _bits_for(n_slots[0])
    n_loops = find_loops.at(n_edges)(t, _bits_for(2 * n_slots[1]), touches) if has_boundary else 0
    states = np.zeros(n_slots[1] // 2 + 1, np.uint8)
    forest = _plant_trees(t, states, touches, late, n_vertices)
    a, out = Arrays(), np.zeros(3, np.int64)
    a.bits, a.starts = _aligned(n_words(2 * n_edges)), forest.starts
    vertices, holes = np.empty(n_vertices, np.int32), np.empty(n_loops, np.int32)
    has_holes = n_loops > forest.n_open
    tour.at(n_edges)(t, forest.roots, states, a.bits, vertices, forest.starts, forest.nodes, holes, has_holes, out)
    n_nodes, n_dual_nodes, n_holes = map(int, out)
    if n_dual_nodes != n_faces + n_loops:
        raise _too_many_handles(t)
    n_components = len(forest.roots)
    a.holes = holes[:n_holes].copy()
    a.sizes = np.array([2 * n_edges, n_components, forest.n_open, n_vertices - n_nodes], np.int64)
    a.counts = counts_of(n_vertices, n_edges, n_faces, int(t.__arrays__().counts[N_EXTERIOR]))
    add_directory(a, 2 * n_edges, (n_nodes - n_components, n_dual_nodes - n_components))
    return Encoded(_with_gaps(a, vertices, late, n_loops), vertices, forest.roots)


def _living(t: Topology) -> tuple[int, int, int]:
    """How many vertices, edges and faces there are."""
    counts = t.__arrays__().counts
    return (
        int(counts[VERTEX_SLOTS] - counts[N_DEAD_VERTICES]),
        int(counts[EDGE_SLOTS] - counts[N_DEAD_EDGES]),
        int(counts[FACE_SLOTS] - counts[N_DEAD_FACES]),
    )


@dataclass(frozen=True)
class _Forest:
    """The trees of all components: the first halfedge of each, and what the ones before have (one entry more).

    ``starts`` counts halfedges, ``nodes`` vertices but the roots; the first `n_open` have a boundary.
    """

    roots: Ints
    starts: Ints
    nodes: Ints
    n_open: int


def _plant_trees(t: Topology, states: Any, touches: Any, late: Any, n_vertices: int) -> _Forest:
    seen, queue, out = np.zeros_like(late), np.empty(n_vertices, np.int32), np.zeros(2, np.int64)
    roots, starts, nodes = (np.zeros(n_vertices + 1, np.int32) for _ in range(3))  # little of them is touched
    plant.at(n_vertices)(t, states, seen, touches, late, queue, roots, starts, nodes, out)
    n, n_open = map(int, out)
    return _Forest(roots[:n].copy(), starts[: n + 1].copy(), nodes[: n + 1].copy(), n_open)


def _with_gaps(a: Arrays, vertices: Ints, late: Any, n_loops: int) -> CompactTopology:
    """The mesh, with the exterior halfedges of vertices that were reached from elsewhere: at most one for each loop."""
    gaps = np.empty(n_loops, np.int32)
    a.gap_vertices = gaps[: _list_late.at(len(vertices))(vertices, late, gaps) if n_loops else 0].copy()
    halfedges = np.zeros(len(a.gap_vertices), np.int32)
    a.gap_halfedges = halfedges.view()
    made = CompactTopology(a)
    _find_gaps.at(len(halfedges))(made, a.gap_vertices, halfedges)
    return made


def _bits_for(n: int) -> NDArray[np.uint8]:
    return np.zeros(n // 8 + 1, np.uint8)


def _aligned(n: int) -> NDArray[np.int64]:
    """Zeros that begin with a cache line."""
    memory = np.empty(n + 8, np.int64)
    skip = -(memory.ctypes.data // 8) % 8
    words = memory[skip : skip + n]
    words[:] = 0
    return words


def _too_many_handles(t: Topology) -> PreconditionError:
    found = components(t)
    c = int(np.flatnonzero(found.genus > 0)[0])
    v = int(np.flatnonzero(found.vertex_component == c)[0])
    n = int((found.genus > 0).sum())
    others = f" (and {n - 1} more)" if n > 1 else ""
    return PreconditionError(
        f"component {c}, that of vertex {v}, has genus {int(found.genus[c])}{others}: only what can be drawn on a "
        "sphere has a compact form; cut it along its handles, or keep it as it is"
    )


@kernel
def _list_late(vertices: Any, late: Any, gaps: Any) -> int:
    """The new indices of the old vertices that are marked."""
    n = 0
    for v in range(len(vertices)):
        if has_bit(late, vertices[v]) and n < len(gaps):
            gaps[n] = v
            n += 1
    return n


@kernel
def _find_gaps(t: Any, gaps: Any, halfedges: Any) -> None:
    """The exterior halfedge of each of these vertices, among those that leave it."""
    for k in range(len(gaps)):
        h = first_of_node(t, gaps[k], 0)
        while not is_exterior(t, h):
            h = cw_of(t, h)
        halfedges[k] = h


# -- the maps ----------------------------------------------------------------------------------------------------------


def maps_of(t: Topology, encoded: Encoded) -> Maps:
    """The new index of every old element: -1 for what was deleted. Complexity: O(n)."""
    counts = t.__arrays__().counts
    vertices, edges, faces = (np.full(int(n), -1, np.int32) for n in counts[:3])
    halfedges = np.full(2 * int(counts[1]), -1, np.int32)
    vertices[encoded.vertices] = np.arange(len(encoded.vertices), dtype=np.int32)
    compact = encoded.topology
    _number.at(len(halfedges))(t, compact, encoded.roots, halfedges, edges, faces)
    return Maps(vertices, halfedges, edges, faces)


@kernel
def _number(t: Any, compact: Any, roots: Any, halfedges: Any, edges: Any, faces: Any) -> None:
    """Walk the tour again."""
    i, n_edges, n_faces = 0, 0, 0
    for c in range(len(roots)):
        if not is_exterior(t, roots[c]):
            faces[face_of(t, roots[c])] = n_faces
            n_faces += 1
    for c in range(len(roots)):
        h = roots[c]
        while True:
            halfedges[h] = i
            tree = is_tree(compact, i)
            if is_opening(compact, i):
                edges[edge_of(t, h)] = n_edges
                n_edges += 1
                twin = twin_of(t, h)
                if not tree and not is_exterior(t, twin):
                    faces[face_of(t, twin)] = n_faces
                    n_faces += 1
            i += 1
            h = next_of(t, h) if tree else cw_of(t, h)
            if h == roots[c]:
                break
