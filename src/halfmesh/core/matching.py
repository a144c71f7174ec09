"""Which corners belong together: the partner of each corner across its edge.

All corners that meet at a vertex are brought together, and there everything is local: a corner ``(p, v, n)`` says
that the face comes from `p` and goes on to `n`, so its neighbor around `v` is the corner that goes on to `p`::

               p                 corner i = (p, v, n) and corner j = (q, v, p)
               |                 share the edge v-p, and j is ccw of i
          j    |    i
               |                 the twin of the halfedge p -> v (before corner i)
        q -----v----- n          is the halfedge v -> p (of corner j)

The same links say whether the corners at `v` form a closed fan, open fans, or something that can't be held. A table
indexed by vertex finds the partner in O(1), so there is no bad case: a fan of a million triangles costs what a grid
does.

Corners first go to *blocks* of neighboring vertices, in a few hundred sequential streams; a block is then small enough
to be sorted by vertex and matched inside the second-level cache. Against one counting sort over all vertices that took
a fifth off the whole construction in coherent order; in shuffled order it made no difference.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel, n_threads, parallel
from halfmesh.core.facelist import FaceList

__all__ = [
    "NONE",
    "Blocks",
    "Defective",
    "Matches",
    "after",
    "before",
    "corner_range",
    "face_of_corner",
    "in_blocks",
    "is_scattered",
    "kept",
    "mates_by_vertex",
    "mates_from_twins",
    "parts",
    "runs",
    "sort_block",
]

Ints = NDArray[np.int32]

NONE = -1
_PART = 20_000  # corners; below that a second thread costs more than it saves
_MOST_PARTS = 8  # each holds a table of one int per vertex
_MOST_BITS = 14  # 16384 vertices: about 100,000 corners, 1.2 MB. Twice as many streams in shuffled order: 15 -> 40 ms
_BITS_IN_ORDER = 12  # in coherent order few streams are written at a time, however many there are: sorting decides
_SAMPLE = 1000
_FEW_EXTERIOR = 8  # the columns fit into the streams if at most one edge in 32 corners is at a boundary
_MOST_BLOCKS = 512  # streams that are written at the same time


class Defective(Exception):  # noqa: N818 - never leaves the package: the mesh room finds out what is wrong and says so
    """The faces are not a mesh that can be held."""


def parts(n: int, work: int) -> list[tuple[int, int]]:
    """The range 0..n in equal parts, one a thread, for so much work."""
    count = max(1, min(n_threads(), _MOST_PARTS, work // _PART))
    bounds = [n * i // count for i in range(count + 1)]
    return list(pairwise(bounds))


class Blocks(NamedTuple):
    """The corners as (vertex, vertex before, vertex after, corner), those of block `b` in starts[b]..starts[b + 1]."""

    streams: Ints
    starts: Ints
    shift: int


class Matches(NamedTuple):
    """What is known of the corners once they are matched.

    Attributes
    ----------
    mates : ndarray of shape (n_corners,)
        For each corner, the corner whose halfedge is the twin of the halfedge *before* it; -1 at a boundary.
    first_corners : ndarray of shape (n_vertices,)
        The first corner of each vertex; -1 if it is isolated.
    room : ndarray
        Memory that was used and is free again, about what the columns of halfedges take: pages that the system gives
        anew cost as much as what is written to them.
    """

    mates: Ints
    first_corners: Ints
    room: Ints


def mates_by_vertex(faces: FaceList) -> Matches:
    """Match the corners by the vertices before and after them.

    Raises
    ------
    Defective
        An index is out of range or repeated in succession, a halfedge is there twice, or a vertex can't be held.
    """
    n, n_vertices = faces.n_corners, faces.n_vertices
    blocks = in_blocks(faces)
    found = Matches(np.empty(n, dtype=np.int32), np.empty(n_vertices, dtype=np.int32), blocks.streams)
    jobs: list[tuple[Any, ...]] = []
    for low, high, largest in runs(blocks, n):
        first = np.empty((1 << blocks.shift) + 2, dtype=np.int32)
        around = np.empty(max(3 * largest, 1), dtype=np.int32)
        table = np.full(n_vertices, NONE, dtype=np.int32)
        jobs.append((*blocks, n_vertices, first, around, table, found.mates, found.first_corners, low, high))
    if sum(parallel(_match_blocks.at(n), jobs)):
        raise Defective
    return found


def in_blocks(faces: FaceList) -> Blocks:
    """The corners of all faces, distributed to blocks of neighboring vertices.

    Raises
    ------
    Defective
        An index is out of range or repeated in succession, or a face has fewer than three corners.
    """
    n, n_vertices = faces.n_corners, faces.n_vertices
    pieces = parts(faces.n_faces, n)
    shift = _block_bits(n_vertices, len(pieces), _MOST_BITS if is_scattered(faces) else _BITS_IN_ORDER)
    n_blocks = (n_vertices >> shift) + 1
    cursors = np.zeros((len(pieces), n_blocks), dtype=np.int32)
    source = (faces.corners, faces.degree, faces.offsets)
    jobs = [(*source, n_vertices, shift, row, *piece) for row, piece in zip(cursors, pieces, strict=True)]
    if sum(parallel(_count.at(n), jobs)):
        raise Defective
    starts = _first_places(cursors)
    streams = np.empty(4 * n + n // _FEW_EXTERIOR, dtype=np.int32)
    pours = [(*source, shift, row, streams, *piece) for row, piece in zip(cursors, pieces, strict=True)]
    parallel(_distribute.at(n), pours)
    return Blocks(streams, starts, shift)


def is_scattered(faces: FaceList) -> bool:
    """Whether faces in succession are far apart, by a sample. It decides about time only, not about results."""
    corners, step = faces.corners, min(faces.degree or 4, 4)
    sample = np.arange(step, len(corners), len(corners) // _SAMPLE + 1)
    far = np.abs(corners[sample].astype(np.int64) - corners[sample - step]) >> _BITS_IN_ORDER > 0
    return bool(2 * np.count_nonzero(far) > len(sample))


def _block_bits(n_vertices: int, n_parts: int, most: int) -> int:
    """Blocks of 2^bits vertices: small enough for the cache, not too many, and several for each thread."""
    several = (n_vertices // (8 * n_parts)).bit_length()
    few = ((n_vertices - 1) // _MOST_BLOCKS).bit_length()
    return max(few, min(several, most))


def _first_places(cursors: Ints) -> Ints:
    """Counts become places, block after block and in each part after part; returns where the blocks begin."""
    by_block = np.ascontiguousarray(cursors.T)
    ends = np.cumsum(by_block.reshape(-1), dtype=np.int64).reshape(by_block.shape)
    cursors[:] = (ends - by_block).T
    starts: Ints = np.r_[0, ends[:, -1]].astype(np.int32)
    return starts


def runs(blocks: Blocks, n: int) -> list[tuple[int, int, int]]:
    """Runs of blocks with about as many of the `n` corners for each thread, and the corners of the largest block."""
    starts = blocks.starts
    n_parts = len(parts(len(starts), n))
    cuts = np.searchsorted(starts[1:-1], [n * i // n_parts for i in range(1, n_parts)])
    bounds = np.unique(np.r_[0, cuts, len(starts) - 1]).tolist()
    return [(low, high, int(np.diff(starts[low : high + 1]).max())) for low, high in pairwise(bounds)]


@kernel
def _count(
    corners: Any, degree: int, offsets: Any, n_vertices: int, shift: int, cursor: Any, low: int, high: int
) -> int:
    """How many corners of the faces low..high each block has; returns how many corners are wrong."""
    wrong = 0
    for f in range(low, high):
        begin, end = corner_range(degree, offsets, f)
        last = corners[end - 1] if end > begin else 0
        wrong += end < begin + 3
        for c in range(begin, end):
            v = corners[c]
            if v < 0 or v >= n_vertices or v == last:
                wrong += 1
            else:
                cursor[v >> shift] += 1
            last = v
    return wrong


@kernel
def corner_range(degree: int, offsets: Any, f: int) -> tuple[int, int]:
    """The first corner of face `f`, and the first that is not its own."""
    if degree > 0:
        return degree * f, degree * f + degree
    return offsets[f], offsets[f + 1]


@kernel
def face_of_corner(degree: int, corner_faces: Any, c: int) -> int:
    """The face of the corner, see `FaceList.corner_faces`."""
    if degree == 3:
        return c // 3  # by a constant: a multiplication
    if degree > 0:
        return c // degree
    return corner_faces[c]  # type: ignore[no-any-return]


@kernel
def kept(h: int) -> int:
    """A halfedge in the place of a mate, which is below -1: of a corner that has it already; and back."""
    return -2 - h


@kernel
def after(c: int, begin: int, end: int) -> int:
    """The corner after `c`, around its face; without a branch that a processor could only guess."""
    return c + 1 - (end - begin) * (c + 1 == end)


@kernel
def before(c: int, begin: int, end: int) -> int:
    """The corner before `c`, around its face."""
    return c - 1 + (end - begin) * (c == begin)


@kernel
def _distribute(
    corners: Any, degree: int, offsets: Any, shift: int, cursor: Any, streams: Any, low: int, high: int
) -> None:
    """Each corner goes, as (vertex, vertex before, vertex after, corner), to the stream of its block, in order."""
    for f in range(low, high):
        begin, end = corner_range(degree, offsets, f)
        last = corners[end - 1]
        v = corners[begin]
        for c in range(begin, end):
            following = corners[after(c, begin, end)]
            place = cursor[v >> shift]
            cursor[v >> shift] = place + 1
            streams[4 * place] = v
            streams[4 * place + 1] = last
            streams[4 * place + 2] = following
            streams[4 * place + 3] = c
            last = v
            v = following


@kernel
def _match_blocks(
    streams: Any,
    starts: Any,
    shift: int,
    n_vertices: int,
    first: Any,
    around: Any,
    table: Any,
    mates: Any,
    first_corners: Any,
    low: int,
    high: int,
) -> int:
    """Sort the corners of each of the blocks low..high by vertex, and match them; returns 1 at the first defect."""
    for block in range(low, high):
        base = block << shift
        n = min(n_vertices - base, 1 << shift)
        sort_block(streams, starts[block], starts[block + 1], base, n, first, around)
        for v in range(n):
            first_corners[base + v] = around[3 * first[v] + 2] if first[v] < first[v + 1] else NONE
        if not _match(first, around, table, mates, n):
            return 1
    return 0


@kernel
def sort_block(streams: Any, low: int, high: int, base: int, n: int, first: Any, around: Any) -> None:
    """Counting sort into ``around``: (vertex before, vertex after, corner); vertex `v` has first[v]..first[v + 1]."""
    for v in range(n + 2):
        first[v] = 0
    for i in range(low, high):
        first[streams[4 * i] - base + 2] += 1
    for v in range(2, n + 2):
        first[v] += first[v - 1]
    for i in range(low, high):
        v = streams[4 * i] - base + 1
        place = first[v]
        first[v] = place + 1
        around[3 * place] = streams[4 * i + 1]
        around[3 * place + 1] = streams[4 * i + 2]
        around[3 * place + 2] = streams[4 * i + 3]


@kernel
def _match(first: Any, around: Any, table: Any, mates: Any, n: int) -> bool:
    """Link the corners around each vertex of a block; False as soon as one can't be held.

    ``table[u]`` is the corner that goes on to `u`. It is never cleared: an entry counts only if it points among the
    corners of this vertex and agrees. A closed fan is matched while it is walked, which is all that most vertices need.
    """
    for v in range(n):
        begin, end = first[v], first[v + 1]
        for i in range(begin, end):
            u = around[3 * i + 1]
            j = table[u]
            if begin <= j < i and around[3 * j + 1] == u:
                return False  # a halfedge twice: the walks below rely on each being there once
            table[u] = i
        i, size = begin, 0
        for _ in range(begin, end):
            u = around[3 * i]
            j = table[u]
            if not (begin <= j < end and around[3 * j + 1] == u):
                size = _match_open_fans(around, table, mates, begin, end)
                break
            mates[around[3 * i + 2]] = around[3 * j + 2]
            size += 1
            i = j
            if i == begin:
                break
        if size != end - begin:
            return False
    return True


@kernel
def _match_open_fans(around: Any, table: Any, mates: Any, begin: int, end: int) -> int:
    """Match the corners of a vertex that touches a gap; returns how many of them are in open fans."""
    for i in range(begin, end):
        u = around[3 * i]
        j = table[u]
        found = begin <= j < end and around[3 * j + 1] == u
        mates[around[3 * i + 2]] = around[3 * j + 2] if found else NONE
    for i in range(begin, end):
        table[around[3 * i]] = i  # from now on: the corner that comes from u, to walk clockwise
    size = 0
    for i in range(begin, end):
        j = i
        found = mates[around[3 * i + 2]] < 0
        while found:  # from the last corner of a fan to its first
            size += 1
            u = around[3 * j + 1]
            j = table[u]
            found = begin <= j < end and around[3 * j] == u
    return size


def mates_from_twins(faces: FaceList, twins: Ints) -> Matches:
    """The same from explicit twins, which are checked: each other's twin, between the same vertices."""
    mates = np.empty(faces.n_corners, dtype=np.int32)
    first_corners = np.full(faces.n_vertices, NONE, dtype=np.int32)
    wrong = _adopt_twins.at(faces.n_corners)(
        faces.corners, faces.degree, faces.offsets, twins, mates, first_corners, faces.n_faces
    )
    if wrong:
        raise Defective
    return Matches(mates, first_corners, first_corners[:0])


@kernel
def _adopt_twins(
    corners: Any, degree: int, offsets: Any, twins: Any, mates: Any, first_corners: Any, n_faces: int
) -> int:
    wrong = 0
    for f in range(n_faces):
        begin, end = corner_range(degree, offsets, f)
        wrong += end < begin + 3
        for c in range(begin, end):
            twin = twins[c]
            mates[after(c, begin, end)] = twin
            wrong += corners[c] < 0 or corners[c] >= len(first_corners)
            if twin < NONE or twin >= len(twins) or twin == c or (twin >= 0 and twins[twin] != c):
                wrong += 1
    for f in range(n_faces):  # twins run between the same vertices, the other way
        begin, end = corner_range(degree, offsets, f)
        for c in range(begin, end):
            twin = twins[c]
            if wrong == 0 and twin >= 0:
                wrong += corners[twin] != corners[after(c, begin, end)]
    if wrong == 0:
        for c in range(len(corners) - 1, -1, -1):  # backwards, so that the first has the last word
            first_corners[corners[c]] = c
    return wrong
