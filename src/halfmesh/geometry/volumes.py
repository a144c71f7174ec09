"""The volume inside a closed surface."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.navigation import face_slots, halfedge_of_face
from halfmesh.errors import PreconditionError
from halfmesh.geometry._passes import points_of, run
from halfmesh.geometry._vectors import dot
from halfmesh.geometry.boxes import bounding_box
from halfmesh.geometry.kernels import face_barycenter, face_vector

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["volume"]


def volume(mesh: Mesh) -> float:
    r"""The volume inside a closed surface.

    .. math:: V = \tfrac13 \sum_f b_f \cdot \vec A_f

    with the barycenters and the area vectors of the faces: the divergence theorem for the field x.

    Parameters
    ----------
    mesh : Mesh
        Closed: every edge has two faces, or none. Several components add up.

    Returns
    -------
    float
        Positive if the faces look outward, negative if they look inward; what is inside twice counts twice. A polygon
        that isn't flat bounds as the fan of triangles around its barycenter.

    Raises
    ------
    PreconditionError
        If an edge has a face on one side only; it names one.

    Notes
    -----
    O(n), on all threads. Measured from the middle of the mesh, so nothing is lost far away from the origin.

    Examples
    --------
    >>> import halfmesh as hm
    >>> round(hm.geometry.volume(hm.shapes.cube()), 12)
    1.0
    >>> hm.geometry.volume(hm.shapes.grid(1, 1))
    Traceback (most recent call last):
        ...
    halfmesh.errors.PreconditionError: a closed surface is needed, but 4 edges have a face on one side only, e.g. edge 0
    """
    if mesh.has_boundary:
        _refuse_open(mesh)
    if mesh.n_faces == 0:
        return 0.0
    t = mesh.topology
    cones = np.empty(face_slots(t))
    run(_cones, len(cones), t, points_of(mesh) - bounding_box(mesh).mean(axis=0), cones)
    return float(cones.sum()) / 3


def _refuse_open(mesh: Mesh) -> None:
    outside = mesh.topology.face < 0
    open_edges = np.flatnonzero(outside[::2] != outside[1::2])
    if len(open_edges):
        raise PreconditionError(
            f"a closed surface is needed, but {len(open_edges)} edges have a face on one side only, "
            f"e.g. edge {open_edges[0]}"
        )


@kernel
def _cones(t: Any, points: Any, cones: Any, low: int, high: int) -> None:
    """Three times the signed volumes between the origin and the faces low..high."""
    for f in range(low, high):
        cones[f] = 0.0
        if halfedge_of_face(t, f) >= 0:
            cones[f] = dot(face_barycenter(t, points, f), face_vector(t, points, f))
