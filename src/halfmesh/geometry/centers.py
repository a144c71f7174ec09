"""Centers of faces and of the whole surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.navigation import face_slots, halfedge_of_face
from halfmesh.errors import PreconditionError
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry.areas import face_areas
from halfmesh.geometry.kernels import face_barycenter, face_centroid

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["centroid", "face_barycenters", "face_centroids"]


def face_barycenters(mesh: Mesh) -> Floats:
    """The mean of the corners of every face.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n face slots, 3)
        A corner that a face passes twice counts twice. Zero for deleted faces.

    Notes
    -----
    O(n), on all threads.

    See Also
    --------
    face_centroids : the center of area, which more corners on one side don't pull away.

    Examples
    --------
    >>> import halfmesh as hm
    >>> house = hm.Mesh([[0, 1, 2, 3, 4]], [[0, 0], [4, 0], [4, 4], [2, 7], [0, 4]])
    >>> hm.geometry.face_barycenters(house).tolist()
    [[2.0, 3.0, 0.0]]
    """
    t = mesh.topology
    n = face_slots(t)
    centers = np.empty((n, 3))
    run(_face_barycenters, n, t, points_of(mesh), centers)
    return centers


def face_centroids(mesh: Mesh) -> Floats:
    """The center of area of every face: where a sheet of that shape balances.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n face slots, 3)
        Exact for flat polygons, convex or not. One that isn't flat is taken as the fan of triangles around its
        barycenter, each weighted by its signed area seen along the face's normal; that doesn't depend on which corner
        comes first. A face without area has its barycenter. Zero for deleted faces.

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> house = hm.Mesh([[0, 1, 2, 3, 4]], [[0, 0], [4, 0], [4, 4], [2, 7], [0, 4]])
    >>> hm.geometry.face_centroids(house).round(9).tolist()
    [[2.0, 2.818181818, 0.0]]
    """
    t = mesh.topology
    n = face_slots(t)
    centers = np.empty((n, 3))
    run(_face_centroids, n, t, points_of(mesh), centers)
    return centers


def centroid(mesh: Mesh) -> Floats:
    """The center of area of the whole surface: where a hollow body with thin walls balances.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (3,)
        The mean of `face_centroids`, weighted by `face_areas`.

    Raises
    ------
    PreconditionError
        If the faces have no area, or there are none.

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.centroid(hm.shapes.cube()).tolist()
    [0.5, 0.5, 0.5]
    """
    areas = face_areas(mesh)
    if not areas.any():
        raise PreconditionError(f"the {mesh.n_faces} faces have no area, so there is no center of it")
    centers = face_centroids(mesh)
    largest = int(areas.argmax())
    weights = areas / areas[largest]
    offsets = centers - centers[largest]
    center: Floats = centers[largest] + (weights[:, None] * offsets).sum(axis=0) / weights.sum()
    return center


@kernel
def _face_barycenters(t: Any, points: Any, centers: Any, low: int, high: int) -> None:
    for f in range(low, high):
        center = (0.0, 0.0, 0.0)
        if halfedge_of_face(t, f) >= 0:
            center = face_barycenter(t, points, f)
        centers[f, 0], centers[f, 1], centers[f, 2] = center


@kernel
def _face_centroids(t: Any, points: Any, centers: Any, low: int, high: int) -> None:
    for f in range(low, high):
        center = (0.0, 0.0, 0.0)
        if halfedge_of_face(t, f) >= 0:
            center = face_centroid(t, points, f)
        centers[f, 0], centers[f, 1], centers[f, 2] = center
