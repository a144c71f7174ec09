"""The box around a mesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from halfmesh.core.topology import DELETED
from halfmesh.errors import PreconditionError
from halfmesh.geometry._passes import Floats

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["bounding_box"]


def bounding_box(mesh: Mesh) -> Floats:
    """The smallest box along the axes that holds all vertices, isolated ones included.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (2, 3)
        The lowest and the highest coordinates. A coordinate that is NaN somewhere is NaN here.

    Raises
    ------
    PreconditionError
        If there are no vertices.

    Notes
    -----
    O(n).

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.bounding_box(hm.shapes.grid(3, 2)).tolist()
    [[0.0, 0.0, 0.0], [3.0, 2.0, 0.0]]
    """
    if mesh.n_vertices == 0:
        raise PreconditionError("a mesh without vertices has no bounding box")
    columns = mesh.points.T
    if mesh.n_vertices < len(mesh.points):
        columns = columns[:, mesh.topology.vertex_halfedge != DELETED]
    return np.array([[column.min() for column in columns], [column.max() for column in columns]])
