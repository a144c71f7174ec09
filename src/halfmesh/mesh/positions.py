"""The border where positions of vertices are cast and checked."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from halfmesh.errors import InvalidMeshError

__all__ = ["as_points"]


def as_points(points: ArrayLike) -> NDArray[np.float64]:
    """Float64 of shape (n, 3), a copy; 2-D points get z = 0."""
    if isinstance(points, np.ma.MaskedArray):
        raise InvalidMeshError("points is a masked array; fill or drop the masked rows first", reason="bad_points")
    try:
        array = np.asarray(points)
    except ValueError as error:
        raise InvalidMeshError(f"points is no array of numbers: {error}", reason="bad_points") from None
    if array.size == 0 and array.ndim <= 2:
        return np.zeros((0, 3))
    if array.dtype.kind not in "iuf":
        raise InvalidMeshError(f"points has dtype {array.dtype}; expected real numbers", reason="bad_points")
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise InvalidMeshError(f"points has shape {array.shape}; expected (n, 3) or (n, 2)", reason="bad_points")
    if array.shape[1] == 3:
        return np.array(array, dtype=np.float64, order="C", subok=False)
    made = np.zeros((len(array), 3))
    made[:, :2] = array
    return made
