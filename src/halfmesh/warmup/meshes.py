"""The meshes that the jobs work on."""

from __future__ import annotations

import numpy as np

import halfmesh as hm

__all__ = ["decorated", "polygons"]


def polygons() -> hm.Mesh:
    """A square and a triangle, with a boundary, and an isolated vertex."""
    return hm.Mesh([[0, 1, 2, 3], [1, 4, 2]], np.array([[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5], [3, 3]]))


def decorated() -> hm.Mesh:
    """The same with attributes of every kind that files carry."""
    mesh = polygons()
    mesh.vertex_data["normal"] = np.tile([0.0, 0.0, 1.0], (mesh.n_vertices, 1))
    mesh.vertex_data["color"] = np.full((mesh.n_vertices, 4), 0.5)
    mesh.halfedge_data["texcoord"] = np.zeros((mesh.n_halfedges, 2))
    return mesh
