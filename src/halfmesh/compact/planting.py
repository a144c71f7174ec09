"""A spanning tree of every component: breadth first, but along a boundary loop as soon as it is reached.

So the exterior halfedge of nearly every boundary vertex is the one after its opening parenthesis. Breadth first since
then partners are near each other: three of four lie in the same block, with a depth-first tree one of fourteen.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, rule
from halfmesh.core.navigation import (
    cw_of,
    edge_of,
    halfedge_of_vertex,
    halfedge_slots,
    is_exterior,
    next_of,
    origin_of,
    target_of,
    twin_of,
    vertex_slots,
)
from halfmesh.core.topology import N_EXTERIOR

__all__ = ["TREE_EDGE", "find_loops", "has_bit", "plant", "put_bit"]

TREE_EDGE = 1  # of the four bits that each edge has; `touring` has two of the others


@rule
def has_bit(bits: Any, i: Any) -> Any:
    """1 if element `i` is marked, 0 if not."""
    return (bits[i >> 3] >> (i & 7)) & 1


@kernel
def put_bit(bits: Any, i: int) -> None:
    """Mark element `i`."""
    bits[i >> 3] |= 1 << (i & 7)


@kernel
def find_loops(t: Any, seen: Any, touches: Any) -> int:
    """How many boundary loops there are; mark the vertices along them."""
    n = 0
    for start in range(halfedge_slots(t)):
        if is_exterior(t, start) and next_of(t, start) >= 0 and not has_bit(seen, start):
            n += 1
            h = start
            while not has_bit(seen, h):
                put_bit(seen, h)
                put_bit(touches, origin_of(t, h))
                h = next_of(t, h)
    return n


@kernel
def plant(
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
            if has_bit(touches, v) and not has_bit(seen, v):
                roots[n] = halfedge_of_vertex(t, v)
                _grow(t, n, roots, starts, nodes, states, seen, touches, late, queue)
                n += 1
    out[1] = n
    for v in range(vertex_slots(t)):
        if not has_bit(seen, v):
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
    put_bit(seen, v)
    queue[0] = root
    n = _follow(t, root, states, seen, queue, 1) if has_bit(touches, v) else 1
    i, n_halfedges = 0, 0
    while i < n:
        start = queue[i]
        i += 1
        h = start
        while True:
            n_halfedges += 1
            v = target_of(t, h)
            if not has_bit(seen, v):
                n = _add(t, h, v, states, seen, queue, n)
                if has_bit(touches, v):
                    if not is_exterior(t, h):
                        put_bit(late, v)
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
        if not has_bit(seen, v):
            n = _add(t, h, v, states, seen, queue, n)
        h = next_of(t, h)
        if h == start:
            return n


@kernel
def _add(t: Any, h: int, v: int, states: Any, seen: Any, queue: Any, n: int) -> int:
    put_bit(seen, v)
    e = edge_of(t, h)
    states[e >> 1] |= TREE_EDGE << (4 * (e & 1))
    queue[n] = twin_of(t, h)
    return n + 1
