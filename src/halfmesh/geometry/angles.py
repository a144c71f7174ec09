"""Angles at the corners of faces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel
from halfmesh.core.circulation import face_halfedges
from halfmesh.core.navigation import face_slots, halfedge_of_face, halfedge_slots, next_of, origin_of, prev_of, twin_of
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry._vectors import cross, difference, dot, length, point
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
    t = mesh.topology
    angles = np.zeros(halfedge_slots(t))
    run(_corner_angles, face_slots(t), t, points_of(mesh), angles, scratch=_buffers)
    return angles


# Corners are collected in a buffer that stays in the cache; when it is full, the compiler can take several angles at a
# time, several times as fast as one by one.
_BUFFER = 512

FULL_TURN = -1e-300  # the sine at the end of a slit, a hair below zero: the face is all around


def _buffers() -> tuple[NDArray[np.int32], Floats, Floats]:
    return np.empty(_BUFFER, dtype=np.int32), np.empty(_BUFFER), np.empty(_BUFFER)


@kernel
def _corner_angles(
    t: Any, points: Any, angles: Any, corners: Any, sines: Any, cosines: Any, low: int, high: int
) -> None:
    n = 0
    for f in range(low, high):
        first = halfedge_of_face(t, f)
        if first < 0:
            continue
        if next_of(t, next_of(t, first)) == prev_of(t, first):
            if n + 3 > len(corners):
                n = _settled(n, corners, sines, cosines, angles)
            n = _triangle_turns(t, points, first, n, corners, sines, cosines)
        else:
            normal = face_normal(t, points, f)
            for h in face_halfedges(t, f):
                if n == len(corners):
                    n = _settled(n, corners, sines, cosines, angles)
                corners[n] = h
                if prev_of(t, h) == twin_of(t, h):
                    sines[n], cosines[n] = FULL_TURN, 1.0
                else:
                    sines[n], cosines[n] = corner_turn(t, points, h, normal)
                n += 1
    _settled(n, corners, sines, cosines, angles)


@kernel
def _triangle_turns(t: Any, points: Any, h: int, n: int, corners: Any, sines: Any, cosines: Any) -> int:
    """One vector product serves the three corners: half the time of the general loop."""
    i, j = next_of(t, h), prev_of(t, h)
    a, b, c = point(points, origin_of(t, h)), point(points, origin_of(t, i)), point(points, origin_of(t, j))
    ab, bc, ca = difference(b, a), difference(c, b), difference(a, c)
    sine = length(cross(ab, bc))
    corners[n], sines[n], cosines[n] = h, sine, -dot(ab, ca)
    corners[n + 1], sines[n + 1], cosines[n + 1] = i, sine, -dot(bc, ab)
    corners[n + 2], sines[n + 2], cosines[n + 2] = j, sine, -dot(ca, bc)
    return n + 3


@kernel
def _settled(n: int, corners: Any, sines: Any, cosines: Any, angles: Any) -> int:
    """Empty the buffer: the angles go to their halfedges."""
    for i in range(n):
        sines[i] = angle_from(sines[i], cosines[i])
    for i in range(n):
        angles[corners[i]] = sines[i]
    return 0
