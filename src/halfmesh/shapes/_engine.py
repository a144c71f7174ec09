"""The border to CDT, the library that triangulates points: what goes in is checked, what it refuses is explained."""

from __future__ import annotations

import re
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from halfmesh.errors import InvalidMeshError

__all__ = ["Triangles", "triangles_of"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]

_CROSSING = re.compile(r"\((\d+), (\d+)\) intersects \((\d+), (\d+)\)")
_DUPLICATE = "Duplicate vertex"


class Triangles(NamedTuple):
    """A triangulation of the convex hull.

    Attributes
    ----------
    faces : ndarray of int32, shape (n, 3)
        Counter-clockwise.
    pieces : ndarray of int32, shape (m, 2)
        The edges that lie on segments: a segment that passes through points is in several pieces.
    segment : ndarray of int32, shape (m,)
        The segment that each piece lies on.
    """

    faces: Ints
    pieces: Ints
    segment: Ints


def triangles_of(xy: Floats, segments: Ints) -> Triangles:
    """The (constrained) Delaunay triangulation of finite points; of points that are equal the first is used."""
    engine = _engine()
    size = np.frexp(np.abs(xy).max(initial=0.0))[1]
    scaled = np.ldexp(xy, -size)  # exact, and then no product overflows or vanishes
    number, first = None, None
    try:
        made = _inserted(engine, scaled)
    except RuntimeError as error:
        if _DUPLICATE not in str(error):
            raise
        scaled, number, first = _distinct(scaled)
        made = _inserted(engine, scaled)
    inner = segments if number is None else number[segments]
    kept = inner[:, 0] != inner[:, 1]
    if kept.any():
        _constrain(made, inner[kept], segments[kept])
    made.erase_super_triangle()
    pieces, segment = _pieces(made, inner, kept)
    faces = np.ascontiguousarray(made.triangles_array(copy=False)["vertices"]).view(np.int32)
    return Triangles(*((faces, pieces) if first is None else (first[faces], first[pieces])), segment)


def _engine() -> Any:
    try:
        import pythoncdt
    except ImportError as error:
        raise ImportError(
            "triangulating points needs the library CDT: pip install halfmesh[delaunay], or pip install pythoncdt"
        ) from error
    return pythoncdt


def _inserted(engine: Any, xy: Floats) -> Any:
    made = engine.Triangulation(engine.VertexInsertionOrder.AUTO, engine.IntersectingConstraintEdges.NOT_ALLOWED, 0.0)
    made.insert_vertices(xy)
    return made


def _distinct(xy: Floats) -> tuple[Floats, Ints, Ints]:
    """The points without repetition in the order of their first appearance, the number of each, and who is first."""
    _, first, group = np.unique(xy[:, 0] + 1j * xy[:, 1], return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(first), dtype=np.int32)
    rank[order] = np.arange(len(first), dtype=np.int32)
    chosen = first[order].astype(np.int32)
    return np.ascontiguousarray(xy[chosen]), rank[group.reshape(-1)], chosen


def _constrain(made: Any, inner: Ints, segments: Ints) -> None:
    try:
        made.insert_edges(np.ascontiguousarray(inner, dtype=np.uintc))
    except RuntimeError as error:
        _refuse(error, inner, segments)


def _refuse(error: RuntimeError, inner: Ints, segments: Ints) -> NoReturn:
    found = _CROSSING.search(str(error))
    if found is None:
        raise InvalidMeshError(
            f"the segments can't be part of a triangulation: {str(error).splitlines()[0]}", reason="bad_segments"
        ) from None
    numbers = [int(x) for x in found.groups()]
    ends = np.array([_as_given(numbers[i : i + 2], inner, segments) for i in (0, 2)], dtype=np.int32)
    raise InvalidMeshError(
        f"the segments {ends[0].tolist()} and {ends[1].tolist()} cross; put a point where they do, and cut them there",
        reason="crossing_segments",
        elements={"edges": ends},
    ) from None


def _as_given(pair: list[int], inner: Ints, segments: Ints) -> list[int]:
    """The segment between these two distinct points, by the points that the caller named; a piece is left as it is."""
    same = np.flatnonzero((np.sort(inner, axis=1) == np.sort(pair)).all(axis=1))
    return [int(v) for v in segments[same[0]]] if len(same) else pair


def _pieces(made: Any, inner: Ints, kept: NDArray[np.bool_]) -> tuple[Ints, Ints]:
    """The edges on segments, and the segment of each; the first of those that run along the same edge."""
    whole = {(a, b): i for i, (a, b) in reversed(list(enumerate(np.sort(inner, axis=1).tolist()))) if kept[i]}
    found = dict(whole)
    for piece, originals in made.piece_to_originals.items():
        along = [_key(x) for x in originals]
        for key in along:
            found.pop(key, None)
        found[_key(piece)] = min(whole[key] for key in [*along, _key(piece)] if key in whole)
    pairs = np.array(list(found), dtype=np.int32).reshape(-1, 2)
    return pairs, np.array(list(found.values()), dtype=np.int32)


def _key(edge: Any) -> tuple[int, int]:
    return (edge.v1, edge.v2) if edge.v1 < edge.v2 else (edge.v2, edge.v1)
