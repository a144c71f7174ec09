"""Writing OFF text: what the format can hold of a mesh."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.errors import FormatError
from halfmesh.io.data import MeshData
from halfmesh.io.text_writing import Corners, Table, face_text, row_text

__all__ = ["off_pieces"]


def off_pieces(data: MeshData, path: str) -> Iterator[bytes | memoryview]:
    """The file, piece by piece.

    Raises
    ------
    FormatError
        If there are edges without faces, which OFF can't hold.
    """
    if len(data.edges):
        raise FormatError(
            f"{len(data.edges)} edges belong to no face, and OFF holds faces only; save as .obj instead", path=path
        )
    keyword, table = _vertex_table(data)
    yield f"{keyword}\n{data.n_vertices} {data.n_faces} 0\n".encode()
    yield from row_text(table)
    colors, dotted = _face_colors(data)
    corners = Corners(data.indices, data.offsets, 0, colors=colors, dotted=dotted)
    yield from face_text(corners, 0, data.n_faces)


def _vertex_table(data: MeshData) -> tuple[str, Table]:
    """The keyword, and all columns side by side in the order that it prescribes."""
    n = data.n_vertices
    columns: list[NDArray[Any]] = [data.points]
    more = column(data.vertex, "more_coordinates", n)
    weight = column(data.vertex, "w", n, (1,))
    normals = column(data.vertex, "normal", n, (3,))
    colors = column(data.vertex, "color", n, (3, 4))
    texture = column(data.vertex, "texcoord", n, (2,))
    keyword = ("ST" if texture is not None else "") + ("C" if colors is not None else "")
    keyword += ("N" if normals is not None else "") + ("4" if weight is not None else "")
    keyword += "OFF" if more is None else f"nOFF\n{3 + more.shape[1]}"
    columns += [extra for extra in (more, weight, normals) if extra is not None]
    dotted = None
    if colors is not None:
        if colors.dtype.kind == "f":
            dotted = sum(x.shape[1] for x in columns)
        columns.append(colors)
    columns += [extra for extra in (texture, _unannounced(data, colors)) if extra is not None]
    return keyword, Table(np.hstack(columns) if len(columns) > 1 else data.points, dotted=dotted)


def _unannounced(data: MeshData, colors: NDArray[Any] | None) -> NDArray[Any] | None:
    """Columns that came with a file whose keyword did not explain them; behind three colours they would be a fourth."""
    if colors is not None and colors.shape[1] == 3:
        return None
    return column(data.vertex, "extra", data.n_vertices)


def _face_colors(data: MeshData) -> tuple[NDArray[np.float64] | None, bool]:
    found = column(data.face, "color", data.n_faces, (3, 4))
    if found is None:
        found = column(data.face, "color_index", data.n_faces, (1,))
    if found is None:
        return None, False
    return found.astype(np.float64), found.dtype.kind == "f"


def column(table: dict[str, NDArray[Any]], name: str, n: int, widths: tuple[int, ...] = ()) -> NDArray[Any] | None:
    """The attribute as (n, k) numbers; None if it is not there, or of another shape than the format takes."""
    if name not in table:
        return None
    values = np.asarray(table[name])
    if values.dtype.kind not in "fiub" or values.ndim not in (1, 2) or len(values) != n:
        return None
    values = values.reshape(n, -1) if n else values.reshape(0, *values.shape[1:2] or (1,))
    return values if values.shape[1] in (widths or (values.shape[1],)) else None
