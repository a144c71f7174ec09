"""The polygons as columns, written directly: the columns that the construction would make of their face list.

Edges are numbered as the polygons come to them first, wire after them; ``2e`` runs in the direction of that polygon.
Exterior halfedges keep their neighbors: the loops around holes stay what they were.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import OUTSIDE, Bytes, Ints
from halfmesh.algorithms._polylla_travel import Walks
from halfmesh.core.navigation import halfedge_of_edge, halfedge_of_vertex, next_of, origin_of, twin_of
from halfmesh.core.topology import N_EXTERIOR, Arrays, empty_columns
from halfmesh.geometry._passes import ranges

__all__ = ["Numbering", "number", "old_halfedges", "write"]


class Numbering(NamedTuple):
    """The new halfedge of every corner, and how many edges there are."""

    halfedges: Ints
    n_edges: int


def number(t: Any, marks: Bytes, walks: Walks, n_edges: int, n_wire: int) -> Numbering:
    """Number the frontier edges by first appearance. In `places`, outer halfedges get their new numbers."""
    halfedges = np.empty(len(walks.corners), dtype=np.int32)
    source = (t, marks, walks.corners, walks.places)
    new = parallel(_count_edges.at(len(marks)), [(*source, *stretch) for stretch in walks.stretches[:-1]])
    jobs = [(*source, halfedges, sum(new[:i]), *stretch) for i, stretch in enumerate(walks.stretches)]
    ends = parallel(_number_edges.at(len(marks)), jobs)
    if n_wire:
        _number_wire.at(n_edges)(t, marks, walks.places, ends[-1], n_edges)
    return Numbering(halfedges, ends[-1] + n_wire)


@kernel
def _count_edges(t: Any, marks: Any, corners: Any, places: Any, low: int, high: int) -> int:
    """How many corners are the first of their edge."""
    n = 0
    for c in range(low, high):
        if corners[c] >= 0:
            g = twin_of(t, corners[c])
            n += (marks[g] & OUTSIDE) != 0 or places[g] > c
    return n


@kernel
def _number_edges(
    t: Any, marks: Any, corners: Any, places: Any, halfedges: Any, n_before: int, low: int, high: int
) -> int:
    """The first corner of an edge gives it its number; returns how many there are up to here."""
    x = 2 * n_before
    for c in range(low, high):
        if corners[c] < 0:
            continue
        g = twin_of(t, corners[c])
        if marks[g] & OUTSIDE:
            halfedges[c] = x
            places[g] = x + 1
            x += 2
        elif places[g] > c:
            halfedges[c] = x
            halfedges[places[g]] = x + 1
            x += 2
    return x >> 1


@kernel
def _number_wire(t: Any, marks: Any, places: Any, e: int, n_edges: int) -> None:
    for i in range(n_edges):
        h = halfedge_of_edge(t, i)
        g = twin_of(t, h)
        if marks[h] & marks[g] & OUTSIDE:
            places[h] = 2 * e
            places[g] = 2 * e + 1
            e += 1


def write(t: Any, marks: Bytes, walks: Walks, numbering: Numbering, n_vertices: int, n_edges: int) -> Arrays:
    """The columns. O(n), on all threads."""
    n_polygons, n_corners = len(walks.begins), int(walks.degrees.sum())
    arrays = empty_columns(n_vertices, numbering.n_edges, n_polygons)
    arrays.vertex_halfedge[:] = -1
    columns = (arrays.next, arrays.prev, arrays.origin, arrays.face)
    source = (walks.vertices, walks.begins, walks.degrees, numbering.halfedges)
    jobs: list[tuple[Any, ...]] = [
        (_write_halfedges.at(n_corners), *source, *columns, arrays.face_halfedge, *piece)
        for piece in ranges(n_polygons)
    ]
    parallel(_do, [*jobs, (_write_first_halfedges.at(n_corners), *source, arrays.vertex_halfedge)])
    n_exterior = 2 * numbering.n_edges - n_corners
    if n_exterior:
        outer = (t, marks, walks.places, *columns, arrays.vertex_halfedge)
        parallel(_write_outside.at(len(marks)), [(*outer, *piece) for piece in ranges(n_edges)])
    arrays.counts[N_EXTERIOR] = n_exterior
    return arrays


def _do(function: Any, *arguments: Any) -> Any:
    return function(*arguments)


@kernel
def _write_halfedges(
    vertices: Any, begins: Any, degrees: Any, halfedges: Any,
    next: Any, prev: Any, origin: Any, face: Any, face_halfedge: Any, low: int, high: int,
) -> None:  # fmt: skip
    for p in range(low, high):
        begin, end = begins[p], begins[p] + degrees[p]
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
def _write_first_halfedges(vertices: Any, begins: Any, degrees: Any, halfedges: Any, vertex_halfedge: Any) -> None:
    """Backwards, so that the first corner of each vertex has the last word."""
    for p in range(len(begins) - 1, -1, -1):
        for c in range(begins[p] + degrees[p] - 1, begins[p] - 1, -1):
            vertex_halfedge[vertices[c]] = halfedges[c]


@kernel
def _write_outside(
    t: Any, marks: Any, places: Any, next: Any, prev: Any, origin: Any, face: Any, vertex_halfedge: Any,
    low: int, high: int,
) -> None:  # fmt: skip
    for e in range(low, high):
        h = halfedge_of_edge(t, e)
        for _ in range(2):
            if marks[h] & OUTSIDE:
                x, y = places[h], places[next_of(t, h)]
                v = origin_of(t, h)
                next[x] = y
                prev[y] = x
                origin[x] = v
                face[x] = -1
                if halfedge_of_vertex(t, v) == h:
                    vertex_halfedge[v] = x
            h = twin_of(t, h)


def old_halfedges(marks: Bytes, walks: Walks, numbering: Numbering) -> NDArray[np.int64]:
    """The halfedge that each new one was, in the triangulation."""
    used = np.concatenate([np.arange(*stretch) for stretch in walks.stretches])
    used = used[walks.corners[used] >= 0]
    outside = np.flatnonzero(marks[: 2 * (len(marks) // 2)] & OUTSIDE)
    old = np.empty(2 * numbering.n_edges, dtype=np.int64)
    old[numbering.halfedges[used]] = walks.corners[used]
    old[walks.places[outside]] = outside
    return old
