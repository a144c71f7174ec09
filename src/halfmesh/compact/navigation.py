"""The rules of a compact mesh: the same names as in `core.navigation`, over parentheses.

A halfedge is its place in the tour around the tree, see `encoding`. With ``match`` for its partner among the
parentheses of its own kind::

    twin(i) = match(i)                                      next(i) = (tree edge ? i : match(i)) + 1
     cw(i)  = (tree edge ? match(i) : i) + 1                ccw(i)  = i - 1 is tree edge ? match(i - 1) : i - 1
                                                            prev(i) = i - 1 is tree edge ? i - 1 : match(i - 1)

where + 1 and - 1 go around in the component. The origin is the node of the tree that is open at `i`, the face that
of the dual tree. The nodes are numbered in the order in which they open, the roots of all components before them.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import rule
from halfmesh.compact.parentheses import (
    depth_at,
    is_opening,
    is_tree,
    match,
    opening,
    openings_before,
    opens_before,
    select,
)
from halfmesh.compact.topology import CARRIER, N_COMPONENTS, N_ISOLATED, N_OPEN, N_SYMBOLS, Views
from halfmesh.core import navigation
from halfmesh.core.topology import VERTEX_SLOTS

__all__ = ["first_of_node"]
__all__ += [name for name in navigation.__all__ if not name.endswith("_slots")]  # the sizes stand where core has them

# -- from a halfedge ---------------------------------------------------------------------------------------------


@rule
def twin_of(t: Any, h: Any) -> Any:
    """The other halfedge of the same edge."""
    return match(t, h)


@rule
def edge_of(t: Any, h: Any) -> Any:
    """The edge of a halfedge."""
    return openings_before(t, h if is_opening(t, h) else match(t, h))


@rule
def next_of(t: Any, h: Any) -> Any:
    """The halfedge after `h` around its face or boundary loop."""
    return _after(t, h if is_tree(t, h) else match(t, h))


@rule
def prev_of(t: Any, h: Any) -> Any:
    """The halfedge before `h` around its face or boundary loop."""
    p = _before(t, h)
    return p if is_tree(t, p) else match(t, p)


@rule
def origin_of(t: Any, h: Any) -> Any:
    """The vertex that `h` leaves."""
    return _vertex(t, opening(t, h, 0), h)


@rule
def target_of(t: Any, h: Any) -> Any:
    """The vertex that `h` arrives at."""
    if is_tree(t, h):
        if is_opening(t, h):
            return _node(t, h, 0)
        return _vertex(t, opening(t, h + 1, 0), h)
    twin = match(t, h)
    return _vertex(t, opening(t, twin, 0), twin)


@rule
def face_of(t: Any, h: Any) -> Any:
    """The face on the left of `h`, -1 for an exterior halfedge."""
    return _face(t, opening(t, h, 1), h)


@rule
def opposite_face_of(t: Any, h: Any) -> Any:
    """The face on the right of `h`, -1 if its twin is exterior."""
    if is_tree(t, h):
        twin = match(t, h)
        return _face(t, opening(t, twin, 1), twin)
    return _face(t, opening(t, h + 1, 1), h)


@rule
def ccw_of(t: Any, h: Any) -> Any:
    """The next halfedge counter-clockwise around the origin of `h`."""
    p = _before(t, h)
    return match(t, p) if is_tree(t, p) else p


@rule
def cw_of(t: Any, h: Any) -> Any:
    """The next halfedge clockwise around the origin of `h`."""
    return _after(t, match(t, h) if is_tree(t, h) else h)


@rule
def is_exterior(t: Any, h: Any) -> Any:
    """Whether there is no face on the left of `h`."""
    if len(t.holes) == 0:  # then only the roots of the first components
        return h < t.starts[t.sizes[N_OPEN]] and depth_at(t, h, 1) == 0
    return face_of(t, h) < 0


# -- from an edge, a vertex, a face ------------------------------------------------------------------------------


@rule
def halfedge_of_edge(t: Any, e: Any) -> Any:
    """The first of the two halfedges of an edge."""
    return select(t, e, 2)


@rule
def halfedge_of_vertex(t: Any, v: Any) -> Any:
    """A halfedge that leaves `v`: an exterior one if there is any; -1 if `v` is isolated."""
    if is_isolated(t, v):
        return -1
    if len(t.gap_vertices) > 0:
        i = _place(t.gap_vertices, v)
        if i < len(t.gap_vertices) and t.gap_vertices[i] == v:
            return t.gap_halfedges[i]
    return first_of_node(t, v, 0)


@rule
def halfedge_of_face(t: Any, f: Any) -> Any:
    """A halfedge of face `f`."""
    return first_of_node(t, f + t.sizes[N_OPEN] + _holes_before_face(t, f), 1)


@rule
def is_boundary_edge(t: Any, e: Any) -> Any:
    """Whether one side of the edge (or both) has no face."""
    h = halfedge_of_edge(t, e)
    return is_exterior(t, h) or is_exterior(t, match(t, h))


@rule
def is_isolated(t: Any, v: Any) -> Any:
    """Whether no edge touches `v`."""
    return v >= t.counts[VERTEX_SLOTS] - t.sizes[N_ISOLATED]


@rule
def is_boundary_vertex(t: Any, v: Any) -> Any:
    """Whether `v` touches a gap; an isolated vertex does not."""
    h = halfedge_of_vertex(t, v)
    return h >= 0 and is_exterior(t, h)


# -- nodes of the trees ------------------------------------------------------------------------------------------


@rule
def _node(t: Any, i: Any, kind: Any) -> Any:
    """The node that opens at `i`."""
    return t.sizes[N_COMPONENTS] + opens_before(t, i, kind)


@rule
def _vertex(t: Any, i: Any, h: Any) -> Any:
    """The vertex that opens at `i`; the root of the component of `h` if that is -1."""
    return _component_of(t, h) if i < 0 else _node(t, i, 0)


@rule
def _face(t: Any, i: Any, h: Any) -> Any:
    """The face that opens at `i`, or the root of the component of `h`; -1 if it is a hole."""
    node = _component_of(t, h) if i < 0 else _node(t, i, 1)
    n_open = t.sizes[N_OPEN]
    if node < n_open:
        return -1
    if len(t.holes) == 0:
        return node - n_open
    k = _place(t.holes, node)
    return -1 if k < len(t.holes) and t.holes[k] == node else node - n_open - k


@rule
def first_of_node(t: Any, node: Any, kind: Any) -> Any:
    """The halfedge after the parenthesis that opens a node."""
    if node < t.sizes[N_COMPONENTS]:
        return t.starts[node]
    return select(t, node - t.sizes[N_COMPONENTS], kind) + 1


@rule
def _holes_before_face(t: Any, f: Any) -> Any:
    """How many holes, roots apart, have a node with a lower number than face `f`."""
    low, high = 0, len(t.holes)
    while low < high:
        middle = (low + high) >> 1
        if t.holes[middle] - middle - t.sizes[N_OPEN] <= f:
            low = middle + 1
        else:
            high = middle
    return low


@rule
def _place(values: Any, value: Any) -> Any:
    """Where in ascending values the first is that is not less."""
    low, high = 0, len(values)
    while low < high:
        middle = (low + high) >> 1
        if values[middle] < value:
            low = middle + 1
        else:
            high = middle
    return low


# -- components --------------------------------------------------------------------------------------------------


@rule
def _component_of(t: Any, h: Any) -> Any:
    if t.sizes[N_COMPONENTS] == 1:
        return 0
    low, high = 0, t.sizes[N_COMPONENTS] - 1
    while low < high:
        middle = (low + high + 1) >> 1
        if t.starts[middle] <= h:
            low = middle
        else:
            high = middle - 1
    return low


@rule
def _after(t: Any, i: Any) -> Any:
    """The place after `i` in the tour of its component."""
    i += 1
    if t.sizes[N_COMPONENTS] == 1:
        return 0 if i == t.sizes[N_SYMBOLS] else i
    c = _component_of(t, i - 1)
    return t.starts[c] if i == t.starts[c + 1] else i


@rule
def _before(t: Any, i: Any) -> Any:
    """The place before `i` in the tour of its component."""
    if t.sizes[N_COMPONENTS] == 1:
        return (t.sizes[N_SYMBOLS] if i == 0 else i) - 1
    c = _component_of(t, i)
    return (t.starts[c + 1] if i == t.starts[c] else i) - 1


_HERE = {getattr(navigation, name): globals()[name] for name in navigation.__all__ if name in globals()}
CARRIER.bind(_HERE)
Views.rules = _HERE
