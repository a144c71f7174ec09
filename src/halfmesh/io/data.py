"""What a mesh file holds, before anybody asks whether it is a mesh that can be held."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Attributes", "Faces", "MeshData"]

Ints = NDArray[np.int32]
Floats = NDArray[np.float64]
Attributes = dict[str, NDArray[Any]]
Faces = Ints | tuple[Ints, Ints]


def _no_edges() -> Ints:
    return np.zeros((0, 2), dtype=np.int32)


@dataclass
class MeshData:
    """The contents of a mesh file as plain arrays, in the order of the file.

    Attributes
    ----------
    indices : ndarray of int32, shape (n_corners,)
        The vertices of all faces, one face after the other.
    offsets : ndarray of int32, shape (n_faces + 1,)
        Where each face begins in `indices`, and the end.
    points : ndarray of float64, shape (n_vertices, 3)
    edges : ndarray of int32, shape (n, 2)
        Edges without faces (the ``l`` elements of OBJ, the segments of ``.poly``).
    vertex, halfedge, edge, face : dict of str to ndarray
        Named attributes, one row for each vertex, corner (in the order of `indices`), row of `edges` and face. Rows
        that the file leaves out are NaN.
    meta : dict
        What is no array: ``comments``, the names behind integer labels (``groups objects materials``),
        ``material_libraries``, the counts ``n_point_elements`` and ``ignored`` (keyword to count); of Triangle's files
        the ``first_number`` that they count from, ``holes`` and ``regions``.

    Examples
    --------
    >>> data = MeshData(np.int32([0, 1, 2]), np.int32([0, 3]), np.zeros((3, 3)))
    >>> data.n_faces, data.faces
    (1, array([[0, 1, 2]], dtype=int32))
    """

    indices: Ints
    offsets: Ints
    points: Floats
    edges: Ints = field(default_factory=_no_edges)
    vertex: Attributes = field(default_factory=dict)
    halfedge: Attributes = field(default_factory=dict)
    edge: Attributes = field(default_factory=dict)
    face: Attributes = field(default_factory=dict)
    meta: dict[str, Any] = field(default_factory=dict)

    @property
    def n_vertices(self) -> int:
        """Number of points."""
        return len(self.points)

    @property
    def n_faces(self) -> int:
        """Number of faces."""
        return len(self.offsets) - 1

    @property
    def degree(self) -> int:
        """Corners of each face if all have equally many, else 0; without faces 3."""
        degree = int(self.offsets[1]) if self.n_faces else 3
        uniform = np.array_equal(self.offsets[1:], np.arange(1, self.n_faces + 1, dtype=np.int64) * degree)
        return degree if uniform else 0

    @property
    def faces(self) -> Faces:
        """The faces as `halfmesh.Mesh` takes them: (n, k) if all have k corners, else (indices, offsets)."""
        degree = self.degree
        return self.indices.reshape(-1, degree) if degree else (self.indices, self.offsets)
