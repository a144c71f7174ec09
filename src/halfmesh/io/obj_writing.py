"""Writing Wavefront OBJ."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh.io.data import MeshData
from halfmesh.io.obj_labels import LABELS
from halfmesh.io.off_writing import column
from halfmesh.io.text_writing import Corners, Table, face_text, row_text

__all__ = ["obj_pieces"]

Piece = bytes | memoryview


def obj_pieces(data: MeshData, path: str) -> Iterator[Piece]:
    """The file, piece by piece: vertices, texture coordinates, normals, faces under their labels, wire."""
    for library in data.meta.get("material_libraries", ()):
        yield _line("mtllib", library)
    yield from row_text(_vertex_table(data))
    texture = _indexed(data, "texcoord", (1, 2, 3))
    normals = _indexed(data, "normal", (3,))
    for rows, prefix in ((texture, b"vt"), (normals, b"vn")):
        if rows is not None:
            yield from row_text(Table(rows.values, prefix))
    corners = Corners(data.indices, data.offsets, 1, b"f", texture and texture.rows, normals and normals.rows)
    yield from _labelled(data, corners)
    wire = Corners(data.edges.reshape(-1), np.arange(0, 2 * len(data.edges) + 1, 2, dtype=np.int32), 1, b"l")
    yield from face_text(wire, 0, len(data.edges))


def _vertex_table(data: MeshData) -> Table:
    colors = column(data.vertex, "color", data.n_vertices, (3, 4))
    if colors is not None:  # OBJ knows colours from 0 to 1
        if colors.dtype.kind != "f":
            colors = colors / 255.0
        return Table(np.hstack([data.points, colors]), b"v", dotted=3, optional=3)
    weight = column(data.vertex, "w", data.n_vertices, (1,))
    return Table(data.points if weight is None else np.hstack([data.points, weight]), b"v")


class _Indexed(NamedTuple):
    """Distinct rows, and which of them each corner has, -1 for none."""

    values: NDArray[np.float64]
    rows: NDArray[np.int32]


def _indexed(data: MeshData, name: str, widths: tuple[int, ...]) -> _Indexed | None:
    """What the corners have, or else what the vertices have."""
    values = column(data.halfedge, name, len(data.indices), widths)
    if values is not None:
        return _distinct(values.astype(np.float64))
    values = column(data.vertex, name, data.n_vertices, widths)
    return None if values is None else _Indexed(values.astype(np.float64), data.indices)


def _distinct(values: NDArray[np.float64]) -> _Indexed:
    """Equal rows, to the bit, become one; numbered by first appearance. O(n log n)."""
    n = len(values)
    bits = np.ascontiguousarray(values).view(np.int64)
    order = np.lexsort(bits.T)
    first = np.ones(n, dtype=bool)
    first[1:] = (bits[order[1:]] != bits[order[:-1]]).any(axis=1)
    appears = np.minimum.reduceat(order, np.flatnonzero(first)) if n else order
    chosen = np.sort(appears[~np.isnan(values[appears]).any(axis=1)])
    number = np.full(n, -1, dtype=np.int32)
    number[chosen] = np.arange(len(chosen), dtype=np.int32)
    index = np.empty(n, dtype=np.int32)
    index[order] = number[appears][np.cumsum(first) - 1]
    return _Indexed(values[chosen], index)


def _labelled(data: MeshData, corners: Corners) -> Iterator[Piece]:
    """Faces in their order, with a line wherever a label changes."""
    columns = _label_columns(data)
    if not columns:
        yield from face_text(corners, 0, data.n_faces)
        return
    table = np.stack([labels for _, _, labels in columns], axis=1)
    changes = np.ones(table.shape, dtype=bool)
    changes[1:] = table[1:] != table[:-1]
    begins = np.flatnonzero(changes.any(axis=1))
    for begin, end in zip(begins.tolist(), [*begins[1:].tolist(), data.n_faces], strict=True):
        for (word, names, labels), changed in zip(columns, changes[begin].tolist(), strict=True):
            if changed and not (begin == 0 and labels[0] < 0):
                yield _line(word, _name(names, int(labels[begin])))
        yield from face_text(corners, begin, end)


def _label_columns(data: MeshData) -> list[tuple[str, list[str] | None, NDArray[Any]]]:
    found: list[tuple[str, list[str] | None, NDArray[Any]]] = []
    for word, (name, names) in {**LABELS, b"s": ("smoothing", "")}.items():
        labels = column(data.face, name, data.n_faces, (1,))
        if labels is not None and labels.dtype.kind in "iu":
            found.append((word.decode(), data.meta.get(names) if names else None, labels[:, 0]))
    return found


def _name(names: list[str] | None, label: int) -> str:
    if names is not None and 0 <= label < len(names):
        return names[label]
    return str(label) if label >= 0 else ""


def _line(word: str, text: str) -> bytes:
    return f"{word} {' '.join(str(text).split())}".rstrip().encode() + b"\n"
