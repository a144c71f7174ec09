"""What is made and placed in one step: vertices are added by the million, and each call from Python counts."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import operation
from halfmesh.core.operators.building import try_add_vertex
from halfmesh.core.topology import NEWS, REPLACED

__all__ = ["try_add_vertex_at"]


@operation
def try_add_vertex_at(t: Any, points: Any, x: float, y: float, z: float) -> int:
    """Add an isolated vertex at a point: its index, or the negative code. The column of the points grows by itself.

    Whether anything was replaced, Python looks at in one place only.
    """
    v = try_add_vertex(t)
    if v >= 0:
        if v >= len(points.values):
            t.counts[NEWS] |= REPLACED
        points[v, 0] = x
        points[v, 1] = y
        points[v, 2] = z
    return v
