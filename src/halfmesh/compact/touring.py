"""The tour around the trees, which writes the symbols."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel
from halfmesh.compact.planting import TREE_EDGE
from halfmesh.compact.words import bit_of
from halfmesh.core.navigation import (
    cw_of,
    edge_of,
    is_exterior,
    is_isolated,
    next_of,
    origin_of,
    prev_of,
    target_of,
    twin_of,
    vertex_slots,
)

__all__ = ["tour"]

SEEN_FORTH, SEEN_BACK = 2, 4  # of the four bits that each edge has


@kernel
def tour(
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
