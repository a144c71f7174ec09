"""Measures of a mesh: arrays in, arrays out, by compiled loops.

Every function takes a :class:`~halfmesh.Mesh`, changes nothing and keeps nothing: move the points and ask again. Row
`i` of a result belongs to the element in slot `i`, halfedges included; rows of deleted elements are 0, so that sums
are those of the living. The single-element formulas are in `halfmesh.geometry.kernels`, for your own kernels.

==============  ====================================================================================================
of edges        `edge_lengths` `edge_vectors`
of faces        `face_areas` `face_normals` `face_vectors` `face_centroids` `face_barycenters` `polygon_quality`
of corners      `corner_angles`
of vertices     `vertex_normals`
of the whole    `area` `volume` `centroid` `bounding_box`
==============  ====================================================================================================

A face may be any polygon, flat or not, convex or not. What has no size (an edge without length, a face without area)
measures 0 and its normal is zero: never an exception, a warning or a NaN. Lengths are in the unit of the points.
Distances between points may be as small as 1e-150 and as large as 1e150, if the result is a number that float64 holds;
a NaN or an infinite coordinate spoils only the elements that touch it.

Results don't depend on the number of threads, and compiled kernels give the same bits as interpreted ones.
"""

from __future__ import annotations

from halfmesh.geometry import kernels
from halfmesh.geometry.angles import corner_angles
from halfmesh.geometry.areas import area, face_areas, face_vectors
from halfmesh.geometry.boxes import bounding_box
from halfmesh.geometry.centers import centroid, face_barycenters, face_centroids
from halfmesh.geometry.lengths import edge_lengths, edge_vectors
from halfmesh.geometry.normals import face_normals, vertex_normals
from halfmesh.geometry.quality import PolygonQuality, QualitySummary, polygon_quality
from halfmesh.geometry.volumes import volume

__all__ = [
    "PolygonQuality",
    "QualitySummary",
    "area",
    "bounding_box",
    "centroid",
    "corner_angles",
    "edge_lengths",
    "edge_vectors",
    "face_areas",
    "face_barycenters",
    "face_centroids",
    "face_normals",
    "face_vectors",
    "kernels",
    "polygon_quality",
    "vertex_normals",
    "volume",
]
