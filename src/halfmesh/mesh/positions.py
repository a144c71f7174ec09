"""The border where positions of vertices are cast and checked."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from halfmesh.errors import InvalidMeshError

__all__ = ["as_point", "as_points"]


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


def as_point(point: ArrayLike) -> NDArray[np.float64]:
    """Three finite numbers, or two with z = 0."""
    try:
        given = np.asarray(point)
    except ValueError as error:
        raise InvalidMeshError(f"{point!r} is no point: {error}", reason="bad_points") from None
    if given.dtype.kind not in "iuf" or isinstance(point, np.ma.MaskedArray):
        raise InvalidMeshError(f"{point!r} is no point: it takes real numbers", reason="bad_points")
    array = given.astype(np.float64)
    if array.shape not in ((2,), (3,)):
        raise InvalidMeshError(f"a point has 2 or 3 coordinates; got shape {array.shape}", reason="bad_points")
    if not np.isfinite(array).all():
        raise InvalidMeshError(f"a point must be finite; got {array.tolist()}", reason="bad_points")
    return array if len(array) == 3 else np.append(array, 0.0)
