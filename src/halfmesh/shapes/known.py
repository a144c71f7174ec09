"""Two small face lists that the literature knows."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from halfmesh.mesh.mesh import Mesh
from halfmesh.shapes._lattice import cells, halved
from halfmesh.shapes._parameters import holdable, whole

__all__ = ["moebius_faces", "seed_triangulation"]

# the example file of Salinas-Fernández, "Implementing Half-edge data structure in C++"; its points lie in a square of
# side 10,000, its faces are as listed there
SEED_POINTS = [
    (0, 0), (5434.9668391472287, 0), (1934.3633489238321, 4501.0628511691029), (0, 10000), (0, 4430.4242110758132),
    (7177.2771157039515, 10000), (2082.4882032210944, 10000), (3703.7846356429982, 2339.6091203110768),
    (10000, 10000), (10000, 0), (6988.9064005448017, 4883.8440215972032),
]  # fmt: skip
SEED_FACES = [
    (4, 0, 2), (3, 2, 6), (2, 3, 4), (6, 2, 10), (0, 7, 2), (10, 7, 1),
    (1, 7, 0), (10, 1, 9), (10, 8, 5), (8, 10, 9), (5, 6, 10), (10, 2, 7),
]  # fmt: skip


def seed_triangulation() -> Mesh:
    """The triangulation of a square that introduces half-edges in an article by Salinas-Fernández.

    11 vertices, 22 edges, 12 triangles; 8 vertices and 8 edges are on the boundary.

    Examples
    --------
    >>> import halfmesh as hm
    >>> mesh = hm.shapes.seed_triangulation()
    >>> mesh.n_vertices, mesh.n_edges, mesh.n_faces, mesh.n_boundary_vertices
    (11, 22, 12, 8)
    """
    return Mesh(SEED_FACES, SEED_POINTS)


def moebius_faces(n: int = 12, *, triangles: bool = False) -> NDArray[np.int32]:
    """The faces of a Moebius strip, which no half-edge mesh can hold: they can't be oriented alike.

    Parameters
    ----------
    n : int
        Number of quads, at least 3.
    triangles : bool
        Two triangles for each quad.

    Returns
    -------
    ndarray of int32, shape (n, 4) or (2 n, 3)
        Faces on 2 n vertices: those of the lower rim, then those of the upper rim, which are the same rim in truth.

    Raises
    ------
    ValueError
        If `n` is less than 3.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.shapes.moebius_faces(3).tolist()
    [[0, 1, 4, 3], [1, 2, 5, 4], [2, 3, 0, 5]]
    >>> hm.Mesh(hm.shapes.moebius_faces())
    Traceback (most recent call last):
        ...
    halfmesh.errors.InvalidMeshError: ...
    """
    n = whole("n", n, 3)
    holdable((6 if triangles else 4) * n, f"moebius_faces({n})")
    quads = cells(n, 1, around=True)
    quads[-1, [1, 2]] = quads[-1, [2, 1]]  # the twist: the last quad meets the first one upside down
    return halved(quads) if triangles else quads
