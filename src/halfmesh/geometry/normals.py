"""Normals of faces and of vertices."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.circulation import face_vertices, outgoing
from halfmesh.core.navigation import (
    face_of,
    face_slots,
    halfedge_of_face,
    next_of,
    origin_of,
    prev_of,
    target_of,
    vertex_slots,
)
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry._ring_normals import buffers, normals_by_angle
from halfmesh.geometry._vectors import Vector, cross, difference, plus, point, scaled, unit
from halfmesh.geometry.angles import corner_angles
from halfmesh.geometry.kernels import face_normal, face_vector

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["face_normals", "vertex_normals"]


def face_normals(mesh: Mesh) -> Floats:
    """The unit normal of every face; the face is counter-clockwise seen from its tip.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n face slots, 3)
        The directions of :func:`face_vectors`: for a polygon that isn't flat, the one along which its shadow is
        largest. Zero for faces without area and for deleted faces.

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.face_normals(hm.shapes.grid(1, 1)).tolist()
    [[0.0, 0.0, 1.0]]
    """
    t = mesh.topology
    n = face_slots(t)
    normals = np.empty((n, 3))
    run(_face_normals, n, t, points_of(mesh), normals)
    return normals


def vertex_normals(mesh: Mesh, *, weights: Literal["angle", "area"] = "angle") -> Floats:
    """The unit normal of every vertex: the weighted mean of the normals of its faces.

    Parameters
    ----------
    mesh : Mesh
    weights : {"angle", "area"}
        How much each face counts: by its angle at the vertex, which makes the normal independent of how the surface
        is cut into faces (Thürmer and Wüthrich 1998), or by its area, which costs half as much.

    Returns
    -------
    ndarray of float64, shape (n vertex slots, 3)
        Zero where there is none: at isolated and deleted vertices, or where the faces cancel each other.

    Raises
    ------
    ValueError
        If `weights` is neither.

    Notes
    -----
    O(n). By angle, each vertex gathers along its ring, on all threads; meshes of triangles take one pass, others
    measure the faces first. By area, each face adds its vector to its corners, on one thread: that computes it once
    instead of at every corner, and beats two threads that gather. Either way the order of the sum is fixed.

    References
    ----------
    G. Thürmer, C. A. Wüthrich, "Computing vertex normals from polygonal facets", Journal of Graphics Tools 3 (1998).
    N. Max, "Weights for computing vertex normals from facet normals", Journal of Graphics Tools 4 (1999), compares
    these weights and others.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.vertex_normals(hm.shapes.octahedron())[0].tolist()
    [1.0, 0.0, 0.0]
    """
    if weights not in ("angle", "area"):
        raise ValueError(f"weights must be 'angle' or 'area', not {weights!r}")
    t, points = mesh.topology, points_of(mesh)
    n = vertex_slots(t)
    normals = np.empty((n, 3))
    if weights == "angle" and mesh.is_triangular:
        run(normals_by_angle, n, t, points, normals, scratch=buffers)
    elif weights == "angle":
        run(_weighted_means, n, t, face_normals(mesh), corner_angles(mesh), normals)
    else:
        _add_faces.at(n)(t, points, normals)
        run(_make_unit, n, normals)
    return normals


@kernel
def _face_normals(t: Any, points: Any, normals: Any, low: int, high: int) -> None:
    for f in range(low, high):
        normal = (0.0, 0.0, 0.0)
        if halfedge_of_face(t, f) >= 0:
            normal = face_normal(t, points, f)
        normals[f, 0], normals[f, 1], normals[f, 2] = normal


@kernel
def _weighted_means(t: Any, vectors: Any, weights: Any, means: Any, low: int, high: int) -> None:
    for v in range(low, high):
        mean = (0.0, 0.0, 0.0)
        for h in outgoing(t, v):
            f = face_of(t, h)
            if f >= 0:
                mean = plus(mean, scaled(point(vectors, f), weights[h]))
        means[v, 0], means[v, 1], means[v, 2] = unit(mean)


@kernel
def _add_faces(t: Any, points: Any, sums: Any) -> None:
    """Add the area vector of each face to its corners, in the order of the faces."""
    for v in range(len(sums)):
        sums[v, 0] = sums[v, 1] = sums[v, 2] = 0.0
    for f in range(face_slots(t)):
        if halfedge_of_face(t, f) < 0:
            continue
        h = halfedge_of_face(t, f)
        a, b, c = origin_of(t, h), target_of(t, h), origin_of(t, prev_of(t, h))
        if next_of(t, next_of(t, h)) == prev_of(t, h):
            corner = point(points, a)  # a triangle, without a walk: twice as fast
            vector = cross(difference(point(points, b), corner), difference(point(points, c), corner))
            for v in (a, b, c):
                _add(sums, v, vector)
        else:
            vector = scaled(face_vector(t, points, f), 2.0)
            for v in face_vertices(t, f):
                _add(sums, v, vector)


@kernel
def _add(sums: Any, v: int, vector: Vector) -> None:
    sums[v, 0] += vector[0]
    sums[v, 1] += vector[1]
    sums[v, 2] += vector[2]


@kernel
def _make_unit(vectors: Any, low: int, high: int) -> None:
    for v in range(low, high):
        vectors[v, 0], vectors[v, 1], vectors[v, 2] = unit(point(vectors, v))
