"""The triangle layout: half the bytes of the columns, nothing but origin and twin, read only.

For meshes of triangles that do not change: 26 bytes a triangle, where the columns of a mesh that can be edited take
54. Questions are answered at half the speed or better. The halves of an array: Campagna, Kobbelt & Seidel (1998),
"Directed edges: a scalable representation for triangle meshes", J. Graphics Tools 3(4).
"""

from __future__ import annotations

import numpy as np

from halfmesh import _jit
from halfmesh.compact import triangle_rules
from halfmesh.compact.carrier import ReadOnly, counts_of, rules_of, views_class
from halfmesh.core import tables
from halfmesh.core.navigation import is_exterior, twin_of
from halfmesh.core.topology import Topology

__all__ = ["TriangleTopology"]

_FIELDS = ("twin", "origin", "vertex_halfedge", "exterior_next", "exterior_prev", "edges_before", "counts")
_RULES = rules_of(triangle_rules)


class TriangleTopology(ReadOnly):
    """The connectivity of triangles as origin and twin: see `triangle_rules` for what is where."""

    fields = _FIELDS
    carrier = _jit.declare_carrier("TriangleTopology", _FIELDS)
    views = views_class(_RULES)

    @classmethod
    def of(cls, t: Topology) -> TriangleTopology:
        """The layout of a mesh that has only triangles and nothing deleted. Complexity: O(n)."""
        corners = tables.corner_halfedges(t)[0]
        exterior = np.flatnonzero(is_exterior(t, np.arange(len(t.next)))).astype(np.int32)
        order = np.concatenate([corners, exterior])
        new = np.empty(len(order) + 1, dtype=np.int32)
        new[order] = np.arange(len(order))
        new[-1] = -1  # for vertices without a halfedge
        twin = new[twin_of(t, order)]
        ahead = np.cumsum(twin > np.arange(len(twin)), dtype=np.int32)
        starts = np.arange(0, max(len(twin), 1), triangle_rules.BLOCK)
        arrays = {
            "twin": twin,
            "origin": t.origin[order],
            "vertex_halfedge": new[t.vertex_halfedge],
            "exterior_next": new[t.next[exterior]],
            "exterior_prev": new[t.prev[exterior]],
            "edges_before": np.append(np.int32(0), ahead)[starts].astype(np.int32),
            "counts": counts_of(len(t.vertex_halfedge), len(t.next) // 2, len(t.face_halfedge), len(exterior)),
        }
        return cls({name: array if len(array) else np.full(1, -1, np.int32) for name, array in arrays.items()})


TriangleTopology.carrier.bind(_RULES)
