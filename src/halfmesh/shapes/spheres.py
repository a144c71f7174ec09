"""Spheres of triangles, all of nearly the same size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from halfmesh.mesh.mesh import Mesh
from halfmesh.shapes._parameters import holdable, whole
from halfmesh.shapes.solids import ICOSAHEDRON_FACES, icosahedron

__all__ = ["icosphere"]

Faces = NDArray[np.int32]
Floats = NDArray[np.float64]


def icosphere(level: int = 3) -> Mesh:
    """The unit sphere as an icosahedron, each of whose triangles is cut in four, `level` times over.

    Parameters
    ----------
    level : int
        0 is the icosahedron. There are ``20 * 4**level`` triangles and ``10 * 4**level + 2`` vertices.

    Returns
    -------
    Mesh
        Twelve vertices have degree 5, all others 6. The vertices of a level come first in the next; the midpoints
        follow in the order of their edge (lower end, higher end). Faces come in four blocks: the parts at corner 0,
        at corner 1, at corner 2, and the central ones.

    Raises
    ------
    ValueError
        If `level` is negative, or the mesh would be too large for int32 indices.

    Notes
    -----
    O(n log n) for n triangles, for the sorting of edges: a million in a fraction of a second.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.icosphere(1)
    <Mesh: 42 vertices, 120 edges, 80 faces, closed>
    """
    level = whole("level", level, 0)
    holdable(60 * 4 ** min(level, 40), f"icosphere({level})")
    faces, points = np.array(ICOSAHEDRON_FACES, dtype=np.int32), icosahedron().points
    for _ in range(level):
        faces, points = _quartered(faces, points)
    return Mesh(faces, points)


def _quartered(faces: Faces, points: Floats) -> tuple[Faces, Floats]:
    """Every triangle in four, the new vertices on the sphere."""
    u, v = faces, np.roll(faces, -1, axis=1)
    keys = np.minimum(u, v) * np.int64(len(points)) + np.maximum(u, v)
    upward = u < v  # the surface is closed and oriented: every edge runs once upward and once downward
    middle = np.empty_like(faces)
    edges = np.sort(keys[upward])
    for way in (upward, ~upward):
        numbers = np.empty(len(edges), dtype=np.int32)
        numbers[np.argsort(keys[way])] = np.arange(len(points), len(points) + len(edges), dtype=np.int32)
        middle[way] = numbers
    (a, b, c), (ab, bc, ca) = faces.T, middle.T
    blocks = ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))
    finer = np.concatenate([np.stack(block, axis=1) for block in blocks])
    low, high = np.divmod(edges, len(points))
    middles = points[low] + points[high]
    middles /= np.sqrt(np.einsum("ij,ij->i", middles, middles))[:, None]
    return finer, np.concatenate([points, middles])
