"""From columns to parentheses: choose a spanning tree, walk around it, write down what is met.

In every component the tree is grown breadth first, after its boundary loops: a loop is walked along as soon as it is
reached, so that the exterior halfedge of nearly every boundary vertex is the one after its opening parenthesis. What
is left of the edges is a spanning tree of the faces and holes, as every component can be drawn on a sphere.

The tour keeps the tree at its right hand: from `h` on to ``next(h)`` if `h` is of the tree, else, over `h`, to
``cw(h)``. So it comes past every halfedge once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, rule
from halfmesh.compact.directory import add_directory, n_words
from halfmesh.compact.parentheses import is_opening, is_tree
from halfmesh.compact.topology import Arrays, CompactTopology
from halfmesh.compact.words import bit_of
from halfmesh.core.compaction import Maps
from halfmesh.core.counting import components
from halfmesh.core.navigation import (
    cw_of,
    edge_of,
    face_of,
    halfedge_of_vertex,
    halfedge_slots,
    is_exterior,
    is_isolated,
    next_of,
    origin_of,
    prev_of,
    target_of,
    twin_of,
    vertex_slots,
)
from halfmesh.core.topology import N_DEAD_EDGES, N_DEAD_FACES, N_DEAD_VERTICES, N_EXTERIOR, REVISION, Topology
from halfmesh.errors import PreconditionError

__all__ = ["Encoded", "compacted", "maps_of"]

Ints = NDArray[np.int32]

TREE_EDGE, SEEN_FORTH, SEEN_BACK = 1, 2, 4  # four bits for each edge


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
    O(n). It takes, besides the result, 4 bytes per vertex and two bits per edge.
    """
    counts = t.__arrays__().counts
    n = int(counts[1] - counts[N_DEAD_EDGES]) * 2
    n_vertices = int(counts[0] - counts[N_DEAD_VERTICES])
    seen, touches, late = (_bits_for(int(counts[0])) for _ in range(3))
    n_loops = _find_loops.at(n)(t, _bits_for(2 * int(counts[1])), touches) if counts[N_EXTERIOR] else 0
    states, queue = np.zeros(int(counts[1]) // 2 + 1, np.uint8), np.empty(n_vertices, np.int32)
    roots, starts, nodes = (np.zeros(n_vertices + 1, np.int32) for _ in range(3))  # of which little is touched
    out = np.zeros(4, np.int64)
    _plant.at(n)(t, states, seen, touches, late, queue, roots, starts, nodes, out)
    n_components, n_open = int(out[0]), int(out[1])
    del queue, seen, touches
    a = Arrays()
    a.bits = _aligned(n_words(n))
    a.starts, nodes, roots = (x[: n_components + k].copy() for x, k in ((starts, 1), (nodes, 1), (roots, 0)))
    vertices, a.holes = np.empty(n_vertices, np.int32), np.empty(n_loops, np.int32)
    _tour.at(n)(t, roots, states, a.bits, vertices, a.starts, nodes, a.holes, n_loops > n_open, out)
    n_nodes, n_dual_nodes, n_holes = int(out[0]), int(out[1]), int(out[2])
    if n_dual_nodes != counts[2] - counts[N_DEAD_FACES] + n_loops:
        raise _too_many_handles(t)
    a.holes = a.holes[:n_holes].copy()
    a.sizes = np.array([n, n_components, n_open, n_vertices - n_nodes], np.int64)
    a.counts = counts.copy()
    a.counts[:3] = n_vertices, n // 2, counts[2] - counts[N_DEAD_FACES]
    a.counts[3:6] = 0
    a.counts[N_EXTERIOR] = counts[N_EXTERIOR]
    a.counts[REVISION:] = 0
    add_directory(a, n, (n_nodes - n_components, n_dual_nodes - n_components))
    a.gap_vertices = np.flatnonzero(late[vertices >> 3] >> (vertices & 7) & 1).astype(np.int32)
    a.gap_halfedges = np.empty(0, np.int32)
    gaps, a.gap_vertices = a.gap_vertices, np.empty(0, np.int32)
    halfedges = np.empty(len(gaps), np.int32)
    _find_gaps.at(len(gaps))(CompactTopology(a), gaps, halfedges)
    a.gap_vertices, a.gap_halfedges = gaps, halfedges
    return Encoded(CompactTopology(a), vertices, roots)


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
        f"component {c}, that of vertex {v}, has genus {int(found.genus[c])}{others}: only what can be drawn on a sphere "
        "has a compact form; cut it along its handles, or keep it as it is"
    )


# -- bits --------------------------------------------------------------------------------------------------------------


@rule
def _has(bits: Any, i: Any) -> Any:
    return (bits[i >> 3] >> (i & 7)) & 1


@kernel
def _put(bits: Any, i: int) -> None:
    bits[i >> 3] |= 1 << (i & 7)


# -- the tree ----------------------------------------------------------------------------------------------------------


@kernel
def _find_loops(t: Any, seen: Any, touches: Any) -> int:
    """How many boundary loops there are; mark the vertices along them."""
    n = 0
    for start in range(halfedge_slots(t)):
        if is_exterior(t, start) and next_of(t, start) >= 0 and not _has(seen, start):
            n += 1
            h = start
            while not _has(seen, h):
                _put(seen, h)
                _put(touches, origin_of(t, h))
                h = next_of(t, h)
    return n


@kernel
def _plant(
    t: Any, states: Any, seen: Any, touches: Any, late: Any, queue: Any, roots: Any, starts: Any, nodes: Any, out: Any
) -> None:
    """Mark the edges of a spanning tree of every component, those with a boundary first.

    `touches` has the vertices along boundary loops; `late` gets those of them that were not reached along one.
    `roots` gets the first halfedges of the components; `starts` and `nodes` how many halfedges, and vertices but the
    roots, the components before each have.
    """
    n = 0
    if t.counts[N_EXTERIOR] > 0:
        for v in range(vertex_slots(t)):
            if _has(touches, v) and not _has(seen, v):
                roots[n] = halfedge_of_vertex(t, v)
                _grow(t, n, roots, starts, nodes, states, seen, touches, late, queue)
                n += 1
    out[1] = n
    for v in range(vertex_slots(t)):
        if not _has(seen, v):
            h = halfedge_of_vertex(t, v)
            if h >= 0:
                roots[n] = h
                _grow(t, n, roots, starts, nodes, states, seen, touches, late, queue)
                n += 1
    out[0] = n


@kernel
def _grow(
    t: Any, c: int, roots: Any, starts: Any, nodes: Any, states: Any, seen: Any, touches: Any, late: Any, queue: Any
) -> None:
    """The tree of one component; the queue holds a halfedge that leaves each vertex."""
    root = roots[c]
    v = origin_of(t, root)
    _put(seen, v)
    queue[0] = root
    n = _follow(t, root, states, seen, queue, 1) if _has(touches, v) else 1
    i, n_halfedges = 0, 0
    while i < n:
        start = queue[i]
        i += 1
        h = start
        while True:
            n_halfedges += 1
            v = target_of(t, h)
            if not _has(seen, v):
                n = _add(t, h, v, states, seen, queue, n)
                if _has(touches, v):
                    if not is_exterior(t, h):
                        _put(late, v)
                    n = _follow(t, halfedge_of_vertex(t, v), states, seen, queue, n)
            h = cw_of(t, h)
            if h == start:
                break
    starts[c + 1] = starts[c] + n_halfedges
    nodes[c + 1] = nodes[c] + n - 1


@kernel
def _follow(t: Any, start: int, states: Any, seen: Any, queue: Any, n: int) -> int:
    """Add the vertices along a boundary loop."""
    h = start
    while True:
        v = target_of(t, h)
        if not _has(seen, v):
            n = _add(t, h, v, states, seen, queue, n)
        h = next_of(t, h)
        if h == start:
            return n


@kernel
def _add(t: Any, h: int, v: int, states: Any, seen: Any, queue: Any, n: int) -> int:
    _put(seen, v)
    e = edge_of(t, h)
    states[e >> 1] |= TREE_EDGE << (4 * (e & 1))
    queue[n] = twin_of(t, h)
    return n + 1


# -- the tour ----------------------------------------------------------------------------------------------------------


@kernel
def _tour(
    t: Any, roots: Any, states: Any, bits: Any, vertices: Any, starts: Any, nodes: Any, holes: Any, has_holes: bool,
    out: Any,
) -> None:  # fmt: skip
    """Write the symbols; list the old vertices in the new order, and the nodes that are holes and not roots."""
    n_components, n_holes = len(roots), 0
    for c in range(n_components):
        vertices[c] = origin_of(t, roots[c])
        n_holes = _tour_of_component(t, c, roots, states, bits, vertices, starts, nodes, holes, has_holes, n_holes)
    n_nodes = n_components + nodes[n_components]
    out[0], out[1], out[2] = n_nodes, n_components + starts[n_components] // 2 - nodes[n_components], n_holes
    for i in range(starts[n_components], 32 * len(bits)):
        _write(bits, i, 1, 1)
    for v in range(vertex_slots(t)):
        if n_nodes == len(vertices):
            break
        if is_isolated(t, v):
            vertices[n_nodes] = v
            n_nodes += 1


@kernel
def _tour_of_component(
    t: Any, c: int, roots: Any, states: Any, bits: Any, vertices: Any, starts: Any, nodes: Any, holes: Any,
    has_holes: bool, n_holes: int,
) -> int:  # fmt: skip
    """From both ends at once, until the two meet: in memory that is not at hand a step waits for the one before it.

    Which of the two halfedges of an edge comes first is known all the same: for the walk forth it is the first that
    it meets itself, for the walk back the second.
    """
    n_components = len(roots)
    i, j = starts[c], starts[c + 1] - 1
    first, last = n_components + nodes[c], n_components + nodes[c + 1] - 1
    first_dual = n_components + i // 2 - nodes[c]
    last_dual = n_components + (j + 1) // 2 - nodes[c + 1] - 1
    n_back, h, g = 0, roots[c], roots[c]
    while i <= j:
        e = edge_of(t, h)
        state = states[e >> 1] >> (4 * (e & 1))
        tree = state & TREE_EDGE
        opens = 0 if state & SEEN_FORTH else 1
        _write(bits, i, tree, opens)
        i += 1
        if opens:
            states[e >> 1] |= SEEN_FORTH << (4 * (e & 1))
            if tree:
                vertices[first] = target_of(t, h)
                first += 1
            else:
                if has_holes and is_exterior(t, twin_of(t, h)) and n_holes + n_back < len(holes):
                    holes[n_holes] = first_dual
                    n_holes += 1
                first_dual += 1
        h = next_of(t, h) if tree else cw_of(t, h)
        if i > j:
            break
        g = prev_of(t, g)
        e = edge_of(t, g)
        state = states[e >> 1] >> (4 * (e & 1))
        tree = state & TREE_EDGE
        opens = 1 if state & SEEN_BACK else 0
        g = g if tree else twin_of(t, g)
        _write(bits, j, tree, opens)
        j -= 1
        if not opens:
            states[e >> 1] |= SEEN_BACK << (4 * (e & 1))
        elif tree:
            vertices[last] = target_of(t, g)
            last -= 1
        else:
            if has_holes and is_exterior(t, twin_of(t, g)) and n_holes + n_back < len(holes):
                n_back += 1
                holes[len(holes) - n_back] = last_dual
            last_dual -= 1
    for k in range(len(holes) - n_back, len(holes)):
        holes[n_holes] = holes[k]
        n_holes += 1
    return n_holes


@kernel
def _write(bits: Any, i: int, tree: int, opens: int) -> None:
    bit = bit_of(i)
    bits[i >> 5] |= (tree << bit) | ((opens << (bit + 4)) if bit < 59 else -opens << 63)  # the last bit is the sign


@kernel
def _find_gaps(t: Any, gaps: Any, halfedges: Any) -> None:
    """The exterior halfedge of each of these vertices."""
    for k in range(len(gaps)):
        h = halfedge_of_vertex(t, gaps[k])
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
