"""Areas of faces and of the whole surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.navigation import face_slots, halfedge_of_face
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry.kernels import face_area, face_vector

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["area", "face_areas", "face_vectors"]


def area(mesh: Mesh) -> float:
    """The area of the whole surface: the sum of `face_areas`.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    float

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.area(hm.shapes.cube())
    6.0
    """
    return float(face_areas(mesh).sum())


def face_areas(mesh: Mesh) -> Floats:
    """The area of every face.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n face slots,)
        The lengths of `face_vectors`: true for every flat polygon that doesn't cross itself, convex or not. The area
        of a polygon that isn't flat is that of its shadow along its normal, the largest that it casts. 0 for
        deleted faces.

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> arrow = hm.Mesh([[0, 1, 2, 3]], [[0, 0], [2, 1], [0, 2], [1, 1]])
    >>> hm.geometry.face_areas(arrow).tolist()
    [1.0]
    """
    t = mesh.topology
    n = face_slots(t)
    areas = np.empty(n)
    run(_face_areas, n, t, points_of(mesh), areas)
    return areas


def face_vectors(mesh: Mesh) -> Floats:
    r"""The area vector of every face: perpendicular to it, as long as it is large.

    .. math:: \vec A_f = \tfrac12 \sum_i p_i \times p_{i+1}

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n face slots, 3)
        The components are the signed areas of the face's shadows on the three coordinate planes. Over a closed
        surface they add up to zero. Zero for deleted faces.

    Notes
    -----
    Newell's formula: Sutherland, Sproull and Schumacker, "A characterization of ten hidden-surface algorithms", ACM
    Computing Surveys 6 (1974). Each face is measured from its own first corner, so nothing is lost far away from the
    origin. O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.face_vectors(hm.shapes.grid(2, 1)).tolist()
    [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]
    """
    t = mesh.topology
    n = face_slots(t)
    vectors = np.empty((n, 3))
    run(_face_vectors, n, t, points_of(mesh), vectors)
    return vectors


@kernel
def _face_areas(t: Any, points: Any, areas: Any, low: int, high: int) -> None:
    for f in range(low, high):
        areas[f] = face_area(t, points, f) if halfedge_of_face(t, f) >= 0 else 0.0


@kernel
def _face_vectors(t: Any, points: Any, vectors: Any, low: int, high: int) -> None:
    for f in range(low, high):
        vector = (0.0, 0.0, 0.0)
        if halfedge_of_face(t, f) >= 0:
            vector = face_vector(t, points, f)
        vectors[f, 0], vectors[f, 1], vectors[f, 2] = vector
