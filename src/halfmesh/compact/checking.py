"""Whether arrays are a compact mesh: what a file is asked before anything else is."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.compact.directory import add_directory
from halfmesh.compact.navigation import first_of_node
from halfmesh.compact.parentheses import depth_at, is_opening, is_tree, opens_before
from halfmesh.compact.topology import N_COMPONENTS, N_ISOLATED, N_OPEN, N_SYMBOLS, Arrays, CompactTopology
from halfmesh.core.navigation import halfedge_of_vertex, is_exterior, next_of, origin_of
from halfmesh.core.topology import EDGE_SLOTS, N_EXTERIOR, VERTEX_SLOTS

__all__ = ["complaint"]


def complaint(a: Arrays) -> str:
    """What is wrong with these arrays, whose lengths are right; empty if nothing is. Complexity: O(n).

    Any two sequences of balanced parentheses, mixed in whatever way, are the tour of some mesh. So it is enough that
    they are balanced in every component, and that all else is what follows from them.
    """
    n, n_components = int(a.sizes[N_SYMBOLS]), int(a.sizes[N_COMPONENTS])
    n_vertices = int(a.counts[VERTEX_SLOTS] - a.sizes[N_ISOLATED])
    n_opens = n_vertices - n_components
    if a.starts[0] != 0 or a.starts[-1] != n or not _ascend(a.starts, 0, n):
        return "the components do not follow each other"
    made = Arrays()
    made.bits = a.bits
    add_directory(made, n, (n_opens, n // 2 - n_opens))
    for name in ("records", "supers", "minima", "samples"):
        if not np.array_equal(getattr(made, name), getattr(a, name)):
            return f"the directory {name!r} does not agree with the symbols"
    if not _ascend(a.holes, n_components, n_components + n // 2 - n_opens - 1):
        return "the holes are not nodes of the dual trees, in ascending order"
    if len(a.gap_vertices) != len(a.gap_halfedges) or not _ascend(a.gap_vertices, 0, n_vertices - 1):
        return "the vertices with a gap are not vertices, in ascending order"
    if len(a.gap_halfedges) and not 0 <= a.gap_halfedges.min() <= a.gap_halfedges.max() < n:
        return "the halfedges along gaps are not halfedges"
    t = CompactTopology(a)
    if a.minima.min() < 0 or not _is_balanced.at(n_components)(t, n_opens):
        return "the parentheses are not balanced"
    if _count_exterior.at(int(a.counts[N_EXTERIOR]))(t) != a.counts[N_EXTERIOR]:
        return "the halfedges along the boundary are not as many as it says, or their vertices do not know of them"
    return ""


def _ascend(values: NDArray[np.int32], low: int, high: int) -> bool:
    return not len(values) or bool((values[1:] > values[:-1]).all() and low <= values[0] and values[-1] <= high)


@kernel
def _is_balanced(t: Any, n_opens: int) -> bool:
    """Whether nothing is open where a component ends, and all that is behind the last one are '('.

    The tree has `n_opens` opening parentheses.
    """
    n = t.sizes[N_SYMBOLS]
    for i in range(n, 32 * len(t.bits)):
        if not is_tree(t, i) or not is_opening(t, i):
            return False
    if n == 0:
        return n_opens == 0
    for c in range(1, t.sizes[N_COMPONENTS]):
        if depth_at(t, t.starts[c], 0) != 0 or depth_at(t, t.starts[c], 1) != 0:
            return False
    last, dual = n - 1, 1 - is_tree(t, n - 1)
    if is_opening(t, last) or depth_at(t, last, dual) != 1 or depth_at(t, last, 1 - dual) != 0:
        return False
    return opens_before(t, last, 0) == n_opens and opens_before(t, last, 1) == t.counts[EDGE_SLOTS] - n_opens  # type: ignore[no-any-return]


@kernel
def _count_exterior(t: Any) -> int:
    """How many halfedges run along the boundary; -1 if one of their vertices, or of those with a gap, gives another."""
    for k in range(len(t.gap_vertices)):
        if not _leaves(t, t.gap_halfedges[k], t.gap_vertices[k]):
            return -1
    n, n_open = 0, t.sizes[N_OPEN]
    for k in range(n_open + len(t.holes)):
        start = first_of_node(t, k if k < n_open else t.holes[k - n_open], 1)
        h = start
        while True:
            n += 1
            v = origin_of(t, h)
            if not _leaves(t, halfedge_of_vertex(t, v), v):
                return -1
            h = next_of(t, h)
            if h == start:
                break
    return n


@kernel
def _leaves(t: Any, h: int, v: int) -> bool:
    return h >= 0 and origin_of(t, h) == v and is_exterior(t, h)
