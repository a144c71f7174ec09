"""Many faces added at once to a mesh that has some, at about the speed of building them.

===========  =====================================================================================================
pass         does
===========  =====================================================================================================
distribute   the new corners to blocks of vertices, as construction does
replay       adds the faces at each vertex, in its cache, and finds which halfedges are there (see `replaying`)
number       new edges by first appearance, as construction does
make room    for them, in larger columns if need be
write        new halfedges by edge, as construction does; those that were there and get a face; vertices and gaps
===========  =====================================================================================================

Until the last pass nothing of the mesh is written, so a refusal has nothing to undo.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, parallel
from halfmesh.core.construction import number_edges, write_halfedges
from halfmesh.core.facelist import FaceList
from halfmesh.core.matching import NONE, Defective, after, before, corner_range, in_blocks, parts, runs
from halfmesh.core.replaying import REFUSED, SPOKE, halfedge_of, replay_blocks
from halfmesh.core.topology import EDGE_SLOTS, FACE_SLOTS, LIMIT, N_EXTERIOR, REVISION, Topology

__all__ = ["sewn"]

Ints = NDArray[np.int32]


class _Seams(NamedTuple):
    """What `replay_blocks` finds: see there."""

    mates: Ints
    shown: Ints
    gaps: list[Ints]


def sewn(t: Topology, faces: FaceList) -> bool:
    """Add these faces, with the result of adding them one by one; or say that this is not the way, and change nothing.

    It is not where one of them can't be added, passes a vertex twice, or has a corner where an edge is a loop or
    parallel to another. No transaction is kept account of.

    Notes
    -----
    O(corners + vertices + degrees of their vertices) time.
    """
    counts = t.__arrays__().counts
    if max(2 * counts[EDGE_SLOTS], counts[FACE_SLOTS]) + 2 * faces.n_corners > LIMIT:
        return False
    corner_faces = faces.corner_faces()
    seams = _replayed(t, faces, corner_faces)
    if seams is None:
        return False
    halfedges, corners, n_edges = number_edges(faces, seams.mates, int(counts[EDGE_SLOTS]))
    t.make_room(n_edges, faces.n_faces)
    _write(t, faces, corner_faces, halfedges, corners, seams)
    counts[EDGE_SLOTS] += n_edges
    counts[FACE_SLOTS] += faces.n_faces
    counts[N_EXTERIOR] += 2 * n_edges - faces.n_corners
    counts[REVISION] += faces.n_faces
    return True


def _replayed(t: Topology, faces: FaceList, corner_faces: Ints) -> _Seams | None:
    try:
        blocks = in_blocks(faces)
    except Defective:
        return None
    n, n_vertices = faces.n_corners, faces.n_vertices
    counts = t.__arrays__().counts
    columns = [getattr(t.__arrays__(), name) for name in ("vertex_halfedge", "prev", "origin", "face")]
    most = int(min(counts[EDGE_SLOTS], n_vertices))  # edges at a vertex, if none are parallel
    mates = np.empty(n, dtype=np.int32)
    shown = np.full(n_vertices, NONE, dtype=np.int32)
    jobs: list[tuple[Any, ...]] = []
    for low, high, largest in runs(blocks, n):
        n_corners = int(blocks.starts[high] - blocks.starts[low])
        first = np.empty((1 << blocks.shift) + 2, dtype=np.int32)
        table = np.zeros(n_vertices, dtype=np.int32)
        # room for the worst: only what is used of it costs anything
        around = np.empty(3 * (largest + 2 * int(counts[EDGE_SLOTS])), dtype=np.int32)
        spokes = np.empty(SPOKE * (most + 2 * largest), dtype=np.int32)
        gaps = np.empty(2 * (int(counts[N_EXTERIOR]) + n_corners), dtype=np.int32)
        shape = (n_vertices, faces.degree, corner_faces)
        jobs.append((*columns, *blocks, *shape, first, around, table, spokes, mates, shown, gaps, low, high))
    found = parallel(replay_blocks.at(_STEPS * n), jobs)
    if REFUSED in found:
        return None
    return _Seams(mates, shown, [job[-3][: 2 * n_gaps] for job, n_gaps in zip(jobs, found, strict=True)])


_STEPS = 4  # of a loop: what a corner costs when it is replayed


def _write(t: Topology, faces: FaceList, corner_faces: Ints, halfedges: Ints, corners: Ints, seams: _Seams) -> None:
    arrays = t.__arrays__()
    base, first_face = 2 * int(arrays.counts[EDGE_SLOTS]), int(arrays.counts[FACE_SLOTS])
    n, shape = faces.n_corners, (faces.degree, faces.offsets)
    columns = (arrays.next, arrays.prev, arrays.origin, arrays.face)
    new = [column[base : base + len(corners)] for column in columns]
    sources = (*shape, corner_faces, halfedges, faces.corners, corners)
    old = (*shape, halfedges, arrays.next, arrays.prev, arrays.face, arrays.face_halfedge, base, first_face)
    jobs: list[tuple[Any, ...]] = [
        (write_halfedges.at(n), *sources, *new, first_face, *piece) for piece in parts(len(corners) // 2, n)
    ]
    jobs += [(_fill.at(n), *old, *piece) for piece in parts(faces.n_faces, n)]
    parallel(_do, jobs)
    names = (*shape, corner_faces, halfedges)
    jobs = [(_show.at(n), *names, seams.shown, arrays.vertex_halfedge, *piece) for piece in parts(len(seams.shown), n)]
    jobs += [(_link_gaps.at(n), *names, gaps, arrays.next, arrays.prev) for gaps in seams.gaps if len(gaps)]
    parallel(_do, jobs)


def _do(function: Callable[..., Any], *arguments: Any) -> Any:
    return function(*arguments)


@kernel
def _fill(
    degree: int,
    offsets: Any,
    halfedges: Any,
    next: Any,
    prev: Any,
    face: Any,
    face_halfedge: Any,
    base: int,
    first_face: int,
    low: int,
    high: int,
) -> None:
    """Give the faces low..high of the list the halfedges below `base`, which were there, and each face its first."""
    for f in range(low, high):
        begin, end = corner_range(degree, offsets, f)
        face_halfedge[first_face + f] = halfedges[begin]
        for c in range(begin, end):
            h = halfedges[c]
            if h < base:
                next[h] = halfedges[after(c, begin, end)]
                prev[h] = halfedges[before(c, begin, end)]
                face[h] = first_face + f


@kernel
def _show(
    degree: int, offsets: Any, corner_faces: Any, halfedges: Any, shown: Any, vertex_halfedge: Any, low: int, high: int
) -> None:
    """Write the halfedges of the vertices low..high that were touched."""
    for v in range(low, high):
        if shown[v] != NONE:
            vertex_halfedge[v] = halfedge_of(degree, offsets, corner_faces, halfedges, shown[v])


@kernel
def _link_gaps(degree: int, offsets: Any, corner_faces: Any, halfedges: Any, gaps: Any, next: Any, prev: Any) -> None:
    """Link what arrives before each gap with what leaves behind it."""
    for i in range(0, len(gaps), 2):
        arriving = halfedge_of(degree, offsets, corner_faces, halfedges, gaps[i]) ^ 1
        leaving = halfedge_of(degree, offsets, corner_faces, halfedges, gaps[i + 1])
        next[arriving] = leaving
        prev[leaving] = arriving
