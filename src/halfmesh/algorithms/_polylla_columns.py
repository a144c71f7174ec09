"""The polygons as columns, written directly: the columns that the construction would make of their face list.

Edges are numbered as the polygons come to them first, wire after them; ``2e`` runs in the direction of that polygon.
Exterior halfedges keep their neighbors: the loops around holes stay what they were.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import OUTSIDE, Bytes, Ints
from halfmesh.algorithms._polylla_travel import Polygons
from halfmesh.core.navigation import halfedge_of_edge, halfedge_of_vertex, next_of, origin_of, twin_of
from halfmesh.core.topology import N_EXTERIOR, Arrays, empty_columns
from halfmesh.geometry._passes import ranges

__all__ = ["Numbering", "number", "old_halfedges", "write"]


class Numbering(NamedTuple):
    """The new halfedge of every corner, and how many edges there are."""

    halfedges: Ints
    n_edges: int


def number(t: Any, marks: Bytes, polygons: Polygons, n_edges: int, n_wire: int) -> Numbering:
    """Number the frontier edges by first appearance. In `places`, outer halfedges get their new numbers."""
    n = len(polygons.corners)
    halfedges = np.empty(max(n, 1), dtype=np.int32)
    pieces = ranges(n)
    source = (t, marks, polygons.corners, polygons.places)
    new = parallel(_count_edges.at(n), [(*source, *piece) for piece in pieces])
    jobs = [(*source, halfedges, sum(new[:i]), *piece) for i, piece in enumerate(pieces)]
    parallel(_number_edges.at(n), jobs)
    if n_wire:
        _number_wire.at(n_edges)(t, marks, polygons.places, sum(new), n_edges)
    return Numbering(halfedges[:n], sum(new) + n_wire)


@kernel
def _count_edges(t: Any, marks: Any, corners: Any, places: Any, low: int, high: int) -> int:
    """How many corners are the first of their edge."""
    n = 0
    for c in range(low, high):
        g = twin_of(t, corners[c])
        n += (marks[g] & OUTSIDE) != 0 or places[g] > c
    return n


@kernel
def _number_edges(
    t: Any, marks: Any, corners: Any, places: Any, halfedges: Any, n_before: int, low: int, high: int
) -> None:
    x = 2 * n_before
    for c in range(low, high):
        g = twin_of(t, corners[c])
        if marks[g] & OUTSIDE:
            halfedges[c] = x
            places[g] = x + 1
            x += 2
        elif places[g] > c:
            halfedges[c] = x
            halfedges[places[g]] = x + 1
            x += 2


@kernel
def _number_wire(t: Any, marks: Any, places: Any, e: int, n_edges: int) -> None:
    for i in range(n_edges):
        h = halfedge_of_edge(t, i)
        g = twin_of(t, h)
        if marks[h] & marks[g] & OUTSIDE:
            places[h] = 2 * e
            places[g] = 2 * e + 1
            e += 1


def write(t: Any, marks: Bytes, polygons: Polygons, numbering: Numbering, n_vertices: int) -> Arrays:
    """The columns. O(n), on all threads."""
    n_polygons, n_corners = len(polygons.offsets) - 1, len(polygons.corners)
    arrays = empty_columns(n_vertices, numbering.n_edges, n_polygons)
    arrays.vertex_halfedge[:] = -1
    columns = (arrays.next, arrays.prev, arrays.origin, arrays.face)
    source = (polygons.vertices, polygons.offsets, numbering.halfedges)
    jobs: list[tuple[Any, ...]] = [
        (_write_halfedges.at(n_corners), *source, *columns, arrays.face_halfedge, *piece)
        for piece in ranges(n_polygons)
    ]
    first = (polygons.vertices, numbering.halfedges, arrays.vertex_halfedge)
    parallel(_do, [*jobs, (_write_first_halfedges.at(n_corners), *first)])
    n_exterior = 2 * numbering.n_edges - n_corners
    if n_exterior:
        outer = (t, marks, polygons.places, *columns, arrays.vertex_halfedge)
        parallel(_write_outside.at(len(marks)), [(*outer, *piece) for piece in ranges(2 * (len(marks) // 2))])
    arrays.counts[N_EXTERIOR] = n_exterior
    return arrays


def _do(function: Any, *arguments: Any) -> Any:
    return function(*arguments)


@kernel
def _write_halfedges(
    vertices: Any, offsets: Any, halfedges: Any,
    next: Any, prev: Any, origin: Any, face: Any, face_halfedge: Any, low: int, high: int,
) -> None:  # fmt: skip
    for p in range(low, high):
        begin, end = offsets[p], offsets[p + 1]
        face_halfedge[p] = halfedges[begin]
        before = halfedges[end - 1]
        for c in range(begin, end):
            x = halfedges[c]
            prev[x] = before
            next[before] = x
            origin[x] = vertices[c]
            face[x] = p
            before = x


@kernel
def _write_first_halfedges(vertices: Any, halfedges: Any, vertex_halfedge: Any) -> None:
    """Backwards, so that the first corner of each vertex has the last word."""
    for c in range(len(vertices) - 1, -1, -1):
        vertex_halfedge[vertices[c]] = halfedges[c]


@kernel
def _write_outside(
    t: Any, marks: Any, places: Any, next: Any, prev: Any, origin: Any, face: Any, vertex_halfedge: Any,
    low: int, high: int,
) -> None:  # fmt: skip
    for h in range(low, high):
        if marks[h] & OUTSIDE:
            x, y = places[h], places[next_of(t, h)]
            v = origin_of(t, h)
            next[x] = y
            prev[y] = x
            origin[x] = v
            face[x] = -1
            if halfedge_of_vertex(t, v) == h:
                vertex_halfedge[v] = x


def old_halfedges(marks: Bytes, polygons: Polygons, numbering: Numbering) -> Ints:
    """The halfedge that each new one was, in the triangulation."""
    old = np.empty(2 * numbering.n_edges, dtype=np.int32)
    old[numbering.halfedges] = polygons.corners
    outside = np.flatnonzero(marks & OUTSIDE)
    outside = outside[outside < len(polygons.places)]
    old[polygons.places[outside]] = outside
    return old
