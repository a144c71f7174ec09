"""Angles at the corners of faces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.core.circulation import face_halfedges
from halfmesh.core.navigation import halfedge_of_face, next_of, origin_of, prev_of
from halfmesh.geometry._passes import Floats, points_of, ranges, run
from halfmesh.geometry._vectors import Vector, cross, difference, dot, length, point, unit
from halfmesh.geometry.kernels import angle_from, corner_turn, face_normal

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["corner_angles"]


def corner_angles(mesh: Mesh) -> Floats:
    """The angle of every corner: inside the face of a halfedge, at its origin.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n halfedge slots,)
        In radians, from 0 to 2 pi: a corner of a polygon that turns inward is more than pi, by the polygon's normal;
        the end of a slit is 2 pi. Exterior and deleted halfedges have 0, so that
        ``np.bincount(t.origin, weights=angles)`` are the angles around the vertices (in a mesh without deleted
        elements).

    Notes
    -----
    ``atan2(|a x b|, a . b)`` for the two edges `a`, `b` of the corner, which is accurate for small and for flat
    angles (Kahan, "How futile are mindless assessments of roundoff in floating-point computation?", 2006, section 12).
    An edge without length gives the angle 0. O(n), on all threads.

    Examples
    --------
    >>> import numpy as np, halfmesh as hm
    >>> mesh = hm.Mesh([[0, 1, 2]], [[0, 0], [1, 0], [0, 1]])
    >>> angles = np.degrees(hm.geometry.corner_angles(mesh))
    >>> angles[mesh.corner_halfedges()].round(9).tolist()
    [90.0, 45.0, 45.0]
    >>> float(angles[mesh.topology.face < 0].max())
    0.0
    """
    return normals_and_angles(mesh)[1]


def normals_and_angles(mesh: Mesh) -> tuple[Floats, Floats]:
    """The unit normals of the faces and the angles of the corners, from one pass over the faces."""
    t = mesh.topology
    n = len(t.face_halfedge)
    normals, sines, cosines = np.empty((n, 3)), np.zeros(len(t.next)), np.zeros(len(t.next))
    run(_corner_turns, n, t, points_of(mesh), normals, sines, cosines)
    # a loop of its own over plain arrays: there the compiler takes four angles at a time
    parallel(_angles_from.at(n), [(sines[i:j], cosines[i:j]) for i, j in ranges(len(t.next))])
    return normals, sines


@kernel
def _corner_turns(t: Any, points: Any, normals: Any, sines: Any, cosines: Any, low: int, high: int) -> None:
    for f in range(low, high):
        first = halfedge_of_face(t, f)
        normal = (0.0, 0.0, 0.0)
        if first >= 0:
            if next_of(t, next_of(t, first)) == prev_of(t, first):
                normal = _triangle_turns(t, points, first, sines, cosines)
            else:
                normal = _polygon_turns(t, points, f, sines, cosines)
        normals[f, 0], normals[f, 1], normals[f, 2] = normal


@kernel
def _triangle_turns(t: Any, points: Any, h: int, sines: Any, cosines: Any) -> Vector:
    """One vector product serves the three corners: half the time of the general loop."""
    i, j = next_of(t, h), prev_of(t, h)
    a, b, c = point(points, origin_of(t, h)), point(points, origin_of(t, i)), point(points, origin_of(t, j))
    ab, bc, ca = difference(b, a), difference(c, b), difference(a, c)
    normal = cross(ab, difference(c, a))
    sine = length(normal)
    sines[h] = sine
    sines[i] = sine
    sines[j] = sine
    cosines[h] = -dot(ab, ca)
    cosines[i] = -dot(bc, ab)
    cosines[j] = -dot(ca, bc)
    return unit(normal)


@kernel
def _polygon_turns(t: Any, points: Any, f: int, sines: Any, cosines: Any) -> Vector:
    normal = face_normal(t, points, f)
    for h in face_halfedges(t, f):
        sines[h], cosines[h] = corner_turn(t, points, h, normal)
    return normal


@kernel
def _angles_from(sines: Any, cosines: Any) -> None:
    for i in range(len(sines)):
        sines[i] = angle_from(sines[i], cosines[i])
