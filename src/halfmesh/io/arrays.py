"""The border where a user's arrays become a :class:`MeshData`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from halfmesh.core.facelist import as_face_list, as_indices
from halfmesh.errors import InvalidMeshError
from halfmesh.io.data import Attributes, MeshData

__all__ = ["as_data"]

Table = Mapping[str, ArrayLike] | None


def as_data(
    faces: Any,
    points: ArrayLike,
    edges: ArrayLike | None,
    vertex: Table,
    halfedge: Table,
    edge: Table,
    face: Table,
    meta: Mapping[str, Any] | None,
) -> MeshData:
    """Cast and check; indices must be in range, everything else is the file's own matter."""
    positions = _as_points(points)
    n = len(positions)
    face_list = as_face_list(faces, n_points=n)
    _check_range(face_list.corners, n, "faces")
    data = MeshData(face_list.corners, face_list.begins(), positions)
    _check_degrees(data)
    if edges is not None:
        data.edges = as_indices(edges, "edges", 2)
        _check_range(data.edges, n, "edges")
    data.vertex = _as_attributes(vertex, n, "vertex")
    data.halfedge = _as_attributes(halfedge, len(data.indices), "corner")
    data.edge = _as_attributes(edge, len(data.edges), "edge")
    data.face = _as_attributes(face, data.n_faces, "face")
    data.meta = dict(meta or {})
    return data


def _as_points(points: ArrayLike) -> NDArray[np.float64]:
    try:
        given = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InvalidMeshError(
            f"points must be numbers of shape (n, 3) or (n, 2): {error}", reason="bad_shape"
        ) from None
    if given.size == 0 and given.ndim == 1:
        given = given.reshape(0, 3)
    if given.ndim != 2 or given.shape[1] not in (2, 3):
        raise InvalidMeshError(f"points has shape {given.shape}; expected (n, 3) or (n, 2)", reason="bad_shape")
    if given.shape[1] == 3:
        return np.ascontiguousarray(given)
    return np.column_stack([given, np.zeros(len(given))])


def _check_range(indices: NDArray[np.int32], n: int, what: str) -> None:
    if indices.size and not 0 <= indices.min() <= indices.max() < n:
        bad = np.unique(indices[(indices < 0) | (indices >= n)])
        raise InvalidMeshError(
            f"{what} refer to vertices outside 0..{n - 1} (given {n} points): {bad[:5].tolist()}",
            reason="index_out_of_range",
            elements={"vertices": bad},
        )


def _check_degrees(data: MeshData) -> None:
    small = np.flatnonzero(np.diff(data.offsets) < 3)
    if len(small):
        raise InvalidMeshError(
            f"{len(small)} faces have fewer than 3 vertices: {small[:5].tolist()}; pass edges as edges=",
            reason="small_face",
            elements={"faces": small},
        )


def _as_attributes(table: Table, n: int, kind: str) -> Attributes:
    named = {name: np.asarray(values) for name, values in (table or {}).items()}
    for name, values in named.items():
        if values.ndim == 0 or len(values) != n:
            raise InvalidMeshError(
                f"{kind} attribute {name!r} has shape {values.shape}; expected {n} rows", reason="bad_shape"
            )
    return named
