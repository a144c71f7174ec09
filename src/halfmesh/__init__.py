"""Half-edge meshes for Python, at the speed of C++, in your own loops too.

>>> import halfmesh as hm
>>> mesh = hm.shapes.icosphere(2)
>>> mesh
<Mesh: 162 vertices, 480 edges, 320 faces, closed>
>>> mesh.vertices[0].degree
5
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from halfmesh._jit import kernel
from halfmesh.core import operators as _operators
from halfmesh.core.circulation import (
    edges_around,
    face_edges,
    face_halfedges,
    face_neighbors,
    face_vertices,
    faces_around,
    incoming,
    loop,
    neighbors,
    outgoing,
)
from halfmesh.core.navigation import (
    ccw_of,
    cw_of,
    edge_of,
    edge_slots,
    face_of,
    face_slots,
    halfedge_of_edge,
    halfedge_of_face,
    halfedge_of_vertex,
    halfedge_slots,
    is_boundary_edge,
    is_boundary_vertex,
    is_exterior,
    is_isolated,
    next_of,
    opposite_face_of,
    origin_of,
    prev_of,
    target_of,
    twin_of,
    vertex_slots,
)
from halfmesh.core.operators import *  # noqa: F403 - all of them, by the list in that file
from halfmesh.core.search import find_halfedge
from halfmesh.errors import (
    ElementError,
    FormatError,
    HalfmeshError,
    InvalidMeshError,
    PreconditionError,
    StaleElementError,
    TopologyError,
)
from halfmesh.mesh import Edge, Face, Halfedge, Mesh, Vertex

if TYPE_CHECKING:
    from halfmesh import algorithms, geometry, io, shapes, testing, viewer
    from halfmesh.algorithms import (
        PolyllaReport,
        polylla,
        triangulate,
        triangulate_face,
        triangulate_face_status,
        triangulated,
    )
    from halfmesh.io import load, save
    from halfmesh.mesh.compact_mesh import CompactMesh
    from halfmesh.mesh.triangle_mesh import TriangleMesh
    from halfmesh.shapes import delaunay

__version__ = "0.1.0"

_ROOMS = ("algorithms", "geometry", "io", "shapes", "testing", "viewer")
_LATER = dict.fromkeys(_ROOMS, "") | {
    "CompactMesh": "mesh.compact_mesh",
    "PolyllaReport": "algorithms",
    "TriangleMesh": "mesh.triangle_mesh",
    "delaunay": "shapes",
    "load": "io",
    "polylla": "algorithms",
    "save": "io",
    "triangulate": "algorithms",
    "triangulate_face": "algorithms",
    "triangulate_face_status": "algorithms",
    "triangulated": "algorithms",
}


def __getattr__(name: str) -> Any:
    """Import a room when it is first used, so that ``import halfmesh`` costs little more than NumPy."""
    if name not in _LATER:
        raise AttributeError(f"module 'halfmesh' has no attribute {name!r}")
    room = importlib.import_module(f"halfmesh.{_LATER[name] or name}")
    value = getattr(room, name) if _LATER[name] else room
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*__all__, "__version__"})


__all__ = [
    "CompactMesh",
    "Edge",
    "ElementError",
    "Face",
    "FormatError",
    "Halfedge",
    "HalfmeshError",
    "InvalidMeshError",
    "Mesh",
    "PolyllaReport",
    "PreconditionError",
    "StaleElementError",
    "TopologyError",
    "TriangleMesh",
    "Vertex",
    "algorithms",
    "ccw_of",
    "cw_of",
    "delaunay",
    "edge_of",
    "edge_slots",
    "edges_around",
    "face_edges",
    "face_halfedges",
    "face_neighbors",
    "face_of",
    "face_slots",
    "face_vertices",
    "faces_around",
    "find_halfedge",
    "geometry",
    "halfedge_of_edge",
    "halfedge_of_face",
    "halfedge_of_vertex",
    "halfedge_slots",
    "incoming",
    "io",
    "is_boundary_edge",
    "is_boundary_vertex",
    "is_exterior",
    "is_isolated",
    "kernel",
    "load",
    "loop",
    "neighbors",
    "next_of",
    "opposite_face_of",
    "origin_of",
    "outgoing",
    "polylla",
    "prev_of",
    "save",
    "shapes",
    "target_of",
    "testing",
    "triangulate",
    "triangulate_face",
    "triangulate_face_status",
    "triangulated",
    "twin_of",
    "vertex_slots",
    "viewer",
]
__all__ += _operators.__all__
