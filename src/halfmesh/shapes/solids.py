"""The five Platonic solids. The cube has edges of length 1; the others have their vertices on the unit sphere."""

from __future__ import annotations

import numpy as np

from halfmesh.mesh.mesh import Mesh

__all__ = ["cube", "dodecahedron", "icosahedron", "octahedron", "tetrahedron"]

_GOLDEN = (1 + 5**0.5) / 2

TETRAHEDRON_FACES = [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)]
OCTAHEDRON_FACES = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
CUBE_FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
ICOSAHEDRON_FACES = [
    (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11),
    (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
    (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9),
    (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1),
]  # fmt: skip
ICOSAHEDRON_POINTS = [
    (-1, _GOLDEN, 0), (1, _GOLDEN, 0), (-1, -_GOLDEN, 0), (1, -_GOLDEN, 0),
    (0, -1, _GOLDEN), (0, 1, _GOLDEN), (0, -1, -_GOLDEN), (0, 1, -_GOLDEN),
    (_GOLDEN, 0, -1), (_GOLDEN, 0, 1), (-_GOLDEN, 0, -1), (-_GOLDEN, 0, 1),
]  # fmt: skip


def tetrahedron() -> Mesh:
    """The regular tetrahedron: 4 vertices on the unit sphere, 6 edges, 4 triangles.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.tetrahedron()
    <Mesh: 4 vertices, 6 edges, 4 faces, closed>
    """
    corners = np.array([(1, 1, 1), (-1, -1, 1), (1, -1, -1), (-1, 1, -1)])
    return Mesh(TETRAHEDRON_FACES, corners / 3**0.5)


def cube() -> Mesh:
    """The cube between (0, 0, 0) and (1, 1, 1): 8 vertices, 12 edges, 6 quads.

    The bits of a vertex's number are its coordinates: vertex 5 is (1, 0, 1).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.cube().points[5].tolist()
    [1.0, 0.0, 1.0]
    """
    return Mesh(CUBE_FACES, np.arange(8)[:, None] >> np.arange(3) & 1)


def octahedron() -> Mesh:
    """The regular octahedron, its vertices at 1 and -1 on the axes x, y, z: 6 vertices, 12 edges, 8 triangles.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.octahedron()
    <Mesh: 6 vertices, 12 edges, 8 faces, closed>
    """
    return Mesh(OCTAHEDRON_FACES, np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]))


def icosahedron() -> Mesh:
    """The regular icosahedron: 12 vertices on the unit sphere, 30 edges, 20 triangles.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.icosahedron()
    <Mesh: 12 vertices, 30 edges, 20 faces, closed>
    """
    return Mesh(ICOSAHEDRON_FACES, np.array(ICOSAHEDRON_POINTS) / (1 + _GOLDEN**2) ** 0.5)


def dodecahedron() -> Mesh:
    """The regular dodecahedron: 20 vertices on the unit sphere, 30 edges, 12 pentagons.

    Its vertices are the faces of `icosahedron`, its faces are the rings around that one's vertices.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.dodecahedron()
    <Mesh: 20 vertices, 30 edges, 12 faces, closed>
    """
    dual = icosahedron()
    middles = dual.points[dual.triangles()].sum(axis=1)
    rings, _ = dual.vertex_faces()
    return Mesh(rings.reshape(-1, 5), middles / np.linalg.norm(middles, axis=1, keepdims=True))
