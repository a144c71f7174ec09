"""Meshes to begin with: solids, spheres, grids and surfaces of revolution, and the ones that every test needs.

Every function returns a :class:`~halfmesh.Mesh` with points (but for `moebius_faces`, which no mesh can hold). Closed
shapes face outward, flat ones face up (+z). Sizes are plain and round, so that areas and volumes can be told by heart:
move and scale ``mesh.points`` for others.
"""

from __future__ import annotations

from halfmesh.shapes.domains import gear, lake
from halfmesh.shapes.known import moebius_faces, seed_triangulation
from halfmesh.shapes.solids import cube, dodecahedron, icosahedron, octahedron, tetrahedron
from halfmesh.shapes.spheres import icosphere
from halfmesh.shapes.surfaces import cone_fan, cylinder, disk, grid, polygon, torus
from halfmesh.shapes.triangulations import delaunay, random_triangulation

__all__ = [
    "cone_fan",
    "cube",
    "cylinder",
    "delaunay",
    "disk",
    "dodecahedron",
    "gear",
    "grid",
    "icosahedron",
    "icosphere",
    "lake",
    "moebius_faces",
    "octahedron",
    "polygon",
    "random_triangulation",
    "seed_triangulation",
    "tetrahedron",
    "torus",
]
