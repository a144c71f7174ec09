"""Operators of one element with the points of the mesh, in one call of compiled code.

The operator notes how attributes are to follow, and Python replays that by the policy of each. For the points, which
every mesh has, that would cost ten times the operator: here they follow before the call returns, and the vertex is put
where it is told.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import filled, kernel, operation
from halfmesh.core.notes import VERTICES
from halfmesh.core.operators.building import try_add_vertex
from halfmesh.core.operators.collapses import try_collapse
from halfmesh.core.operators.splits import try_split_edge, try_split_edge_triangular, try_split_face
from halfmesh.core.topology import HAS_NOTES, NEWS, NOTES_SIZE, NOTING, REPLACED, VERTEX_SLOTS
from halfmesh.mesh.policies import LERP, replay_notes

__all__ = ["collapse_at", "split_edge_at", "split_edge_triangular_at", "split_face_at", "try_add_vertex_at"]


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


# The arguments of all: whether `points` is the only attribute of vertices, whether a place is told, and the place.


@operation
def split_edge_at(
    t: Any, points: Any, is_only: bool, is_told: bool, x: float, y: float, z: float, h: int, weight: float
) -> int:
    """Split the edge of `h` and place the new vertex: it, or the negative code."""
    return _placed(t, points, is_only, is_told, x, y, z, try_split_edge(t, h, weight))


@operation
def split_edge_triangular_at(
    t: Any, points: Any, is_only: bool, is_told: bool, x: float, y: float, z: float, h: int, weight: float
) -> int:
    """Split the edge of `h` and the triangles beside, without parallels, and place the new vertex: it, or the code."""
    return _placed(t, points, is_only, is_told, x, y, z, try_split_edge_triangular(t, h, weight, False))


@operation
def split_face_at(
    t: Any, points: Any, is_only: bool, is_told: bool, x: float, y: float, z: float, f: int, weight: float
) -> int:
    """Split the face and place the new vertex: it, or the negative code. The weight is not used."""
    return _placed(t, points, is_only, is_told, x, y, z, try_split_face(t, f))


@operation
def collapse_at(
    t: Any, points: Any, is_only: bool, is_told: bool, x: float, y: float, z: float, h: int, weight: float
) -> int:
    """Contract `h` and place the vertex that stays: it, or the negative code."""
    return _placed(t, points, is_only, is_told, x, y, z, try_collapse(t, h, weight))


@kernel
def _placed(t: Any, points: Any, is_only: bool, is_told: bool, x: float, y: float, z: float, v: int) -> int:
    """Let the points follow, by linear interpolation, and put `v` there if it is told."""
    if v < 0:
        return v
    n = t.counts[VERTEX_SLOTS]
    if n > len(points.values):
        points.values = filled(points.values, 2 * n, points.default)
        t.counts[NEWS] |= REPLACED
    size = t.counts[NOTES_SIZE]
    if size > 0:
        replay_notes(points.values, t.notes, t.weights, size, VERTICES, LERP, False)
        if is_only and t.counts[NOTING] == VERTICES:  # nobody else follows
            t.counts[NOTES_SIZE] = 0
            t.counts[NEWS] &= ~HAS_NOTES
    if is_told:
        points.values[v, 0] = x
        points.values[v, 1] = y
        points.values[v, 2] = z
    return v
