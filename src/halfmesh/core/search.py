"""Finding the halfedge between two vertices."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import operation
from halfmesh.core.navigation import ccw_of, halfedge_of_vertex, halfedge_slots, target_of, twin_of

__all__ = ["find_halfedge"]


@operation
def find_halfedge(t: Any, u: int, v: int) -> int:
    """The first halfedge from `u` to `v` that turns up, -1 if there is none.

    Walks the rings of both ends in lockstep, so the cost is the smaller of the two degrees.
    """
    start_u, start_v = halfedge_of_vertex(t, u), halfedge_of_vertex(t, v)
    if start_u < 0 or start_v < 0:
        return -1
    h, g = start_u, start_v
    for _ in range(halfedge_slots(t)):
        if target_of(t, h) == v:
            return h  # type: ignore[no-any-return]
        if target_of(t, g) == u:
            return twin_of(t, g)  # type: ignore[no-any-return]
        h, g = ccw_of(t, h), ccw_of(t, g)
        if h == start_u or g == start_v:
            break
    return -1
