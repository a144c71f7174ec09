"""The one border where face lists are cast and checked: kernels behind it see int32 and nothing else.

A face list is flat: the vertices of all faces one after the other (the *corners*), and where each face begins.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.core.topology import LIMIT
from halfmesh.errors import InvalidMeshError

__all__ = ["FaceList", "as_corner_data", "as_face_list", "as_indices"]

Ints = NDArray[np.int32]

_NOTHING = np.zeros(1, dtype=np.int32)


@dataclass(frozen=True)
class FaceList:
    """Faces as flat arrays.

    Attributes
    ----------
    corners : ndarray of int32, shape (n_corners,)
        The vertices of all faces.
    degree : int
        Corners of each face if all have equally many, else 0.
    offsets : ndarray of int32
        Where each face begins, and the end: shape (n_faces + 1,); a single 0 if `degree` says it.
    n_faces, n_vertices : int
    """

    corners: Ints
    degree: int
    offsets: Ints
    n_faces: int
    n_vertices: int

    @property
    def n_corners(self) -> int:
        """Sum of the face degrees."""
        return len(self.corners)

    def begins(self) -> Ints:
        """Where each face begins, and the end; shape (n_faces + 1,)."""
        if self.degree:
            return np.arange(0, self.n_corners + 1, self.degree, dtype=np.int32)
        return self.offsets

    def corner_faces(self) -> Ints:
        """The face of each corner; a placeholder where division gives it."""
        if self.degree:
            return _NOTHING
        return np.repeat(np.arange(self.n_faces, dtype=np.int32), np.diff(self.offsets))


def as_face_list(
    faces: Any, n_vertices: int | None = None, n_points: int | None = None, wire: Ints | None = None
) -> FaceList:
    """Cast what a user calls faces.

    Parameters
    ----------
    faces : (n, k) array_like of int, sequence of sequences of int, or (indices, offsets)
        Any integer dtype and memory order; the ragged pair only as a tuple of two 1-D integer arrays.
    n_vertices, n_points : int, optional
        The number of vertices, as said and as given by the points.
    wire : ndarray of shape (n, 2), optional
        Edges without faces: they count where neither says the number of vertices.

    Raises
    ------
    InvalidMeshError
        For anything else, with what would be accepted.
    """
    corners, degree, offsets = _flat(faces)
    n_faces = len(offsets) - 1 if degree == 0 else len(corners) // degree
    if len(corners) > LIMIT:
        raise InvalidMeshError(f"{len(corners)} corners are more than int32 indices can name", reason="too_large")
    n = _vertex_count(corners, n_vertices, n_points, wire)
    return FaceList(_as_int32(corners), degree, offsets, n_faces, n)


def _flat(faces: Any) -> tuple[NDArray[np.integer], int, Ints]:
    if isinstance(faces, tuple) and len(faces) == 2 and all(isinstance(x, np.ndarray) and x.ndim == 1 for x in faces):
        return _flat_ragged(faces[0], faces[1])
    if isinstance(faces, np.ndarray):
        return _flat_array(faces)
    return _flat_lists(faces)


def _flat_array(faces: NDArray[Any]) -> tuple[NDArray[np.integer], int, Ints]:
    if faces.dtype == object and faces.ndim == 1:
        return _flat_lists(list(faces))
    if faces.size == 0 and (faces.ndim == 1 or (faces.ndim == 2 and len(faces) == 0)):
        return np.zeros(0, dtype=np.int32), 3, _NOTHING
    if faces.ndim != 2:
        raise InvalidMeshError(
            f"faces has shape {faces.shape}; expected (n, k), a list of lists, or a tuple (indices, offsets)",
            reason="bad_shape",
        )
    if faces.shape[1] < 3:
        _check_integers(faces, "faces")
        raise InvalidMeshError(
            f"all {len(faces)} faces have {faces.shape[1]} vertices, a face needs at least 3; pass edges as edges=",
            reason="small_face",
            elements={"faces": np.arange(len(faces))},
        )
    _check_integers(faces, "faces")
    return np.ascontiguousarray(faces).reshape(-1), faces.shape[1], _NOTHING


def _flat_ragged(indices: NDArray[Any], offsets: NDArray[Any]) -> tuple[NDArray[np.integer], int, Ints]:
    _check_integers(indices, "indices")
    _check_integers(offsets, "offsets")
    if len(offsets) == 0 or offsets[0] != 0 or offsets[-1] != len(indices) or np.any(offsets[1:] < offsets[:-1]):
        raise InvalidMeshError(
            f"offsets must begin with 0, never decrease and end with len(indices) = {len(indices)}",
            reason="bad_offsets",
        )
    return np.ascontiguousarray(indices), 0, _as_int32(np.ascontiguousarray(offsets))


def _flat_lists(faces: Iterable[Any]) -> tuple[NDArray[np.integer], int, Ints]:
    try:
        rows = [row if isinstance(row, list | tuple | np.ndarray) else list(row) for row in faces]
    except TypeError:
        raise InvalidMeshError(
            f"faces is {type(faces).__name__}; expected an (n, k) int array, a list of lists, or (indices, offsets)",
            reason="bad_shape",
        ) from None
    if not rows:
        return np.zeros(0, dtype=np.int32), 3, _NOTHING
    lengths = np.fromiter(map(len, rows), dtype=np.int64, count=len(rows))
    flat = [v for row in rows for v in row]
    try:
        corners = np.array(flat) if flat else np.zeros(0, dtype=np.int64)
    except (ValueError, OverflowError) as error:
        raise InvalidMeshError(f"faces must hold integers: {error}", reason="bad_dtype") from None
    if corners.ndim != 1:
        raise InvalidMeshError("faces is nested too deeply; expected a list of lists of ints", reason="bad_shape")
    if any(isinstance(v, bool | np.bool_) for v in flat):
        raise InvalidMeshError("faces holds booleans; expected vertex indices", reason="bad_dtype")
    _check_integers(corners, "faces")
    if int(lengths.min()) == int(lengths.max()) >= 3:
        return corners, int(lengths[0]), _NOTHING
    offsets = np.zeros(len(rows) + 1, dtype=np.int64)
    np.cumsum(lengths, out=offsets[1:])
    return corners, 0, _as_int32(offsets)


def as_indices(array: Any, name: str, width: int | None = None) -> Ints:
    """Cast an array of indices: (n,) or, with `width`, (n, width)."""
    array = _as_array(array, name)
    if array.size == 0:
        return np.zeros((0,) if width is None else (0, width), dtype=np.int32)
    _check_integers(array, name)
    if width is not None and (array.ndim != 2 or array.shape[1] != width):
        raise InvalidMeshError(f"{name} has shape {array.shape}; expected (n, {width})", reason="bad_shape")
    return _as_int32(np.ascontiguousarray(array))


def _as_array(nested: Any, name: str) -> NDArray[Any]:
    if isinstance(nested, np.ndarray):
        return nested
    try:
        array = np.asarray(nested)
    except (ValueError, OverflowError) as error:
        raise InvalidMeshError(f"{name} is no array of integers: {error}", reason="bad_shape") from None
    if array.ndim and array.dtype != object and any(isinstance(v, bool | np.bool_) for v in _leaves(nested)):
        raise InvalidMeshError(f"{name} holds booleans; expected indices", reason="bad_dtype")
    return array


def _leaves(nested: Any) -> Iterator[Any]:
    if isinstance(nested, list | tuple):
        for item in nested:
            yield from _leaves(item)
    else:
        yield nested


def as_corner_data(values: Any, name: str) -> Ints:
    """Cast indices that come one for each corner: flat, or in the shape of the faces."""
    if not isinstance(values, np.ndarray) and any(isinstance(row, list | tuple | np.ndarray) for row in values):
        values = [v for row in values for v in row]
    return as_indices(values, name).reshape(-1)


def _check_integers(array: NDArray[Any], name: str) -> None:
    if isinstance(array, np.ma.MaskedArray):
        raise InvalidMeshError(f"{name} is a masked array; fill or drop the masked entries first", reason="bad_dtype")
    if not np.issubdtype(array.dtype, np.integer):
        hint = ""
        if np.issubdtype(array.dtype, np.floating):
            bad = int(np.count_nonzero(~np.isfinite(array)))
            hint = f" ({bad} of them not finite)" if bad else "; if they are whole numbers, use .astype(int)"
        raise InvalidMeshError(
            f"{name} has dtype {array.dtype}; expected integer vertex indices{hint}", reason="bad_dtype"
        )


def _as_int32(array: NDArray[np.integer]) -> Ints:
    """int32 without wrapping around: what does not fit becomes -2, which is out of range and found as such.

    Always a copy: nobody may change the indices between the kernel that checks their range and those that follow them.
    In C order, aligned and writable: anything else is another type to a compiler, and would be compiled for again.
    """
    if array.dtype == np.int32 and array.dtype.isnative:
        return np.array(array, order="C", subok=False)
    if array.size and not np.can_cast(array.dtype, np.int32):
        low, high = int(array.min()), int(array.max())
        if low < -(2**31) or high >= 2**31:
            return np.where((array < -1) | (array > LIMIT), -2, array).astype(np.int32)
    return array.astype(np.int32)


def _vertex_count(corners: NDArray[np.integer], n_vertices: int | None, n_points: int | None, wire: Ints | None) -> int:
    if n_points is not None:
        if n_vertices is not None and n_vertices != n_points:
            raise InvalidMeshError(f"n_vertices is {n_vertices} but there are {n_points} points", reason="bad_count")
        return n_points
    if n_vertices is not None:
        if isinstance(n_vertices, bool) or not isinstance(n_vertices, int | np.integer) or n_vertices < 0:
            raise InvalidMeshError(f"n_vertices is {n_vertices!r}; expected a number", reason="bad_count")
        if n_vertices > LIMIT:
            raise InvalidMeshError(f"{n_vertices} vertices are more than int32 indices can name", reason="too_large")
        return int(n_vertices)
    mentions = [corners] if wire is None else [corners, wire]
    top = max((int(array.max()) for array in mentions if array.size), default=-1)
    n = sum(array.size for array in mentions)
    if top > 16 * n + 1024:  # one stray index must not allocate gigabytes
        raise InvalidMeshError(
            f"the largest index is {top} but faces and edges have only {n} entries; "
            "pass points or n_vertices if so many isolated vertices are meant",
            reason="index_out_of_range",
            elements={"corners": np.flatnonzero(corners > 16 * n + 1024)},
        )
    return max(top + 1, 0)
