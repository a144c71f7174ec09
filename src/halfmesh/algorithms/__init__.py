"""What changes a mesh as a whole: one concept per file.

==================  ================================================================================================
`triangulate`       cut faces into triangles by diagonals, in place; `triangulated` gives a new mesh
`triangulate_face`  the same for one face, in your own kernels
`polylla`           join triangles into simple polygons; with a report, `PolyllaReport`
==================  ================================================================================================
"""

from __future__ import annotations

from halfmesh.algorithms.polylla_mesh import PolyllaReport, polylla
from halfmesh.algorithms.triangulation import (
    triangulate,
    triangulate_face,
    triangulate_face_status,
    triangulated,
)

__all__ = ["PolyllaReport", "polylla", "triangulate", "triangulate_face", "triangulate_face_status", "triangulated"]
