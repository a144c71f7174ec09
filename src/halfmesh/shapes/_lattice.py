"""Faces of a lattice of vertices, open or wrapped around: what grids, cylinders, tori and disks have in common."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Faces = NDArray[np.int32]
Floats = NDArray[np.float64]


def cells(columns: int, rows: int, *, around: bool = False, over: bool = False) -> Faces:
    """The quads of a lattice, row by row.

    Vertex (column, row) is number ``row * width + column``, where `width` is `columns`, and one more if the columns
    don't close around; likewise the rows close `over`.

    ::

        d --- c      columns run to the right, rows upward,
        |     |      a quad is (a, b, c, d)
        a --- b
    """
    width, height = columns + (not around), rows + (not over)
    left = np.arange(columns, dtype=np.int32)
    right = (left + 1) % np.int32(width)
    low = np.arange(rows, dtype=np.int32)[:, None] * np.int32(width)
    high = np.roll(np.arange(height, dtype=np.int32), -1)[:rows, None] * np.int32(width)
    faces = np.empty((rows, columns, 4), dtype=np.int32)
    for corner, (row, column) in enumerate(((low, left), (low, right), (high, right), (high, left))):
        np.add(row, column, out=faces[:, :, corner])
    return faces.reshape(-1, 4)


def halved(quads: Faces) -> Faces:
    """Two triangles for each quad (a, b, c, d): (a, b, c) and (a, c, d), one after the other."""
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def fan(apex: int, rim: Faces) -> Faces:
    """The triangles between a vertex and each side of a closed rim."""
    return np.stack([np.full_like(rim, apex), rim, np.roll(rim, -1)], axis=1)


def mixed(*parts: Faces) -> tuple[Faces, Faces] | Faces:
    """Several arrays of faces as one face list: an array if all have the same degree, else (indices, offsets)."""
    if len({part.shape[1] for part in parts}) == 1:
        return np.concatenate(parts)
    degrees = np.concatenate([np.full(len(part), part.shape[1], dtype=np.int32) for part in parts])
    offsets = np.zeros(len(degrees) + 1, dtype=np.int32)
    np.cumsum(degrees, out=offsets[1:])
    return np.concatenate([part.reshape(-1) for part in parts]), offsets


def circle(n: int, radius: float = 1.0) -> Floats:
    """Points on a circle in the plane z = 0, counter-clockwise from the x axis; shape (n, 3)."""
    angle = 2 * np.pi / n * np.arange(n)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros(n)], axis=1)
