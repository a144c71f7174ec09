"""Lengths and directions of edges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.navigation import edge_slots, halfedge_of_edge, next_of
from halfmesh.geometry._passes import Floats, points_of, run
from halfmesh.geometry.kernels import edge_length, edge_vector

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

__all__ = ["edge_lengths", "edge_vectors"]


def edge_lengths(mesh: Mesh) -> Floats:
    """The length of every edge.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n edge slots,)
        In the unit of the points; 0 for deleted edges.

    Notes
    -----
    O(n), on all threads. Right between 1e-150 and 1e150, where the square of a length would overflow or vanish.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.edge_lengths(hm.Mesh([[0, 1, 2]], [[0, 0], [3, 0], [3, 4]])).tolist()
    [3.0, 4.0, 5.0]
    """
    t = mesh.topology
    n = edge_slots(t)
    lengths = np.empty(n)
    run(_edge_lengths, n, t, points_of(mesh), lengths)
    return lengths


def edge_vectors(mesh: Mesh) -> Floats:
    """From the origin to the target of the first halfedge of every edge.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    ndarray of float64, shape (n edge slots, 3)
        Zero for deleted edges. The second halfedge of edge `e`, ``2 * e + 1``, runs the other way.

    Notes
    -----
    O(n), on all threads.

    Examples
    --------
    >>> import halfmesh as hm
    >>> hm.geometry.edge_vectors(hm.Mesh([[0, 1, 2]], [[0, 0], [3, 0], [3, 4]])).tolist()
    [[3.0, 0.0, 0.0], [0.0, 4.0, 0.0], [-3.0, -4.0, 0.0]]
    """
    t = mesh.topology
    n = edge_slots(t)
    vectors = np.empty((n, 3))
    run(_edge_vectors, n, t, points_of(mesh), vectors)
    return vectors


@kernel
def _edge_lengths(t: Any, points: Any, lengths: Any, low: int, high: int) -> None:
    for e in range(low, high):
        lengths[e] = edge_length(t, points, e) if next_of(t, halfedge_of_edge(t, e)) >= 0 else 0.0


@kernel
def _edge_vectors(t: Any, points: Any, vectors: Any, low: int, high: int) -> None:
    for e in range(low, high):
        vector = (0.0, 0.0, 0.0)
        if next_of(t, halfedge_of_edge(t, e)) >= 0:
            vector = edge_vector(t, points, e)
        vectors[e, 0], vectors[e, 1], vectors[e, 2] = vector
