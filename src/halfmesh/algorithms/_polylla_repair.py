r"""Repair: regions that pass a vertex twice are cut into simple polygons.

Between two visits of a vertex `w` the region goes around something: the tip of a barrier edge, an island that hangs on
one, or a part of the surface that it touches again. The triangles that join the two visits are a path in the region's
tree, and cutting any internal edge of it parts them. The middle one is taken::

        o-------o-------o            the walk comes w, tip, w: a way of length 2; around the tip
        | \    /|\    / |            the path is all the triangles, crossing k internal edges,
        |  \ 2/ | \3 /  |            of which the middle one becomes frontier
        |  1\/  |  \/4  |
        |---tip=====w---|
        |  ...          |

In each round the shortest ways, counted in sides of the walk, are all cut at once; so tips go first. The parts are
walked again until all are simple: at the latest, when they are single triangles.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import CUT, PENDING, Bytes, Ints, is_internal
from halfmesh.algorithms._polylla_travel import Walks
from halfmesh.core.matching import parts
from halfmesh.core.navigation import face_of, next_of, origin_of, target_of, twin_of
from halfmesh.errors import PreconditionError
from halfmesh.geometry._passes import ranges

__all__ = ["repair"]


def repair(t: Any, marks: Bytes, seeds: Ints, walks: Walks, n_vertices: int) -> Walks:
    """Cut the bad regions into simple polygons: each stays with the part that has its seed, the others come behind all.

    Marks the edges that are cut, and writes the new corners where there is room.
    """
    bad = walks.bad
    if len(bad) == 0:
        return walks
    sides = walks.degrees[bad].astype(np.int64)
    most = int(sides.max())
    jobs, made = [], []
    place = walks.stretches[-1][1]
    for low, high in parts(len(bad), int(sides.sum())):
        room = int(3 * (sides[low:high] - 2).sum())  # when nothing but triangles is left
        added = [np.empty(room // 3, dtype=np.int32) for _ in range(3)]
        scratch = [np.empty(n, dtype=np.int32) for n in (most, 2 * most, 2 * most, most)]
        visits = np.full(max(n_vertices, 1), -1, dtype=np.int32)
        target = (walks.corners, walks.vertices, walks.begins, walks.degrees, walks.places)
        jobs.append((t, marks, seeds, bad, *target, *added, visits, *scratch, place, low, high))
        made.append((place, added))
        place += room
    if place > len(walks.corners):
        raise PreconditionError(f"a repair of {len(bad)} regions may need more corners than int32 can number")
    found = parallel(_repair.at(10 * int(sides.sum())), jobs)
    behind = [[rows[k][:n] for (_, rows), (n, _) in zip(made, found, strict=True)] for k in range(3)]
    starts, begins, degrees = (np.concatenate(rows) for rows in behind)
    first = (t, marks, starts, walks.of_triangle, len(seeds))
    parallel(_note_triangles.at(10 * int(sides.sum())), [(*first, *piece) for piece in ranges(len(starts))])
    return walks._replace(
        begins=np.concatenate([walks.begins, begins]),
        degrees=np.concatenate([walks.degrees, degrees]),
        stretches=walks.stretches + [(begin, end) for (begin, _), (_, end) in zip(made, found, strict=True)],
    )


@kernel
def _repair(
    t: Any, marks: Any, seeds: Any, bad: Any,
    corners: Any, vertices: Any, begins: Any, degrees: Any, places: Any,
    new_starts: Any, new_begins: Any, new_degrees: Any,
    visits: Any, loop: Any, path: Any, stack: Any, cuts: Any, place: int, low: int, high: int,
) -> tuple[int, int]:  # fmt: skip
    """Returns how many polygons were added, and where their corners end, that begin at `place`."""
    n_added, c = 0, place
    for i in range(low, high):
        p = bad[i]
        begin, n = begins[p], degrees[p]
        old_end = begin + n
        for k in range(n):
            loop[k] = corners[begin + k]
        way = _shortest_way(t, loop, n, visits)
        top = _cut(t, marks, loop, n, way, visits, path, cuts, stack, 0)
        while top > 0:
            top -= 1
            start = stack[top]
            if (marks[start] & PENDING) == 0:
                continue
            n, has_seed = _walk(t, marks, start, seeds[p], loop)
            way = _shortest_way(t, loop, n, visits)
            if way < n:
                top = _cut(t, marks, loop, n, way, visits, path, cuts, stack, top)
            elif has_seed:
                degrees[p] = n
                _put(t, loop, n, begin, corners, vertices, places)
                for k in range(begin + n, old_end):
                    corners[k] = -1
            else:
                new_starts[n_added], new_begins[n_added], new_degrees[n_added] = start, c, n
                n_added += 1
                _put(t, loop, n, c, corners, vertices, places)
                c += n
    return n_added, c


@kernel
def _cut(
    t: Any, marks: Any, loop: Any, n: int, way: int, visits: Any, path: Any, cuts: Any, stack: Any, top: int
) -> int:
    """Cut all ways of that length in the middle; both sides of each cut go on the stack, to be walked from."""
    n_cuts = _middles(t, marks, loop, n, way, visits, path, cuts)
    for k in range(n_cuts):
        h = cuts[k]
        g = twin_of(t, h)
        if is_internal(marks, h, g):  # two ways may have the same middle
            marks[h] |= CUT | PENDING
            marks[g] |= CUT | PENDING
            stack[top], stack[top + 1] = h, g
            top += 2
    return top


@kernel
def _put(t: Any, loop: Any, n: int, place: int, corners: Any, vertices: Any, places: Any) -> None:
    """Write a polygon down, from `place` on."""
    for i in range(n):
        h = loop[i]
        corners[place + i] = h
        vertices[place + i] = origin_of(t, h)
        places[h] = place + i


@kernel
def _note_triangles(t: Any, marks: Any, starts: Any, of_triangle: Any, first: int, low: int, high: int) -> None:
    """Note the polygon of each triangle of those that were added, which are numbered from `first` on."""
    for i in range(low, high):
        h = starts[i]
        while True:
            of_triangle[face_of(t, h)] = first + i
            h = next_of(t, h)
            g = twin_of(t, h)
            while is_internal(marks, h, g):
                of_triangle[face_of(t, h)] = first + i
                h = next_of(t, g)
                g = twin_of(t, h)
            if h == starts[i]:
                break


@kernel
def _walk(t: Any, marks: Any, start: int, seed: int, loop: Any) -> tuple[int, bool]:
    """Write down the frontier from `start`, which is no longer pending: its length, and whether the seed is inside."""
    h, n, has_seed = start, 0, False
    while True:
        loop[n] = h
        n += 1
        marks[h] &= ~PENDING
        has_seed |= h == seed
        h = next_of(t, h)
        g = twin_of(t, h)
        while is_internal(marks, h, g):
            has_seed |= h == seed
            h = next_of(t, g)
            g = twin_of(t, h)
        if h == start:
            return n, has_seed


@kernel
def _shortest_way(t: Any, loop: Any, n: int, visits: Any) -> int:
    """The least number of sides from a vertex to the same vertex; `n`, once around, if none is passed twice."""
    shortest = n
    for i in range(2 * n):
        if i == n and shortest == n:
            break  # no vertex twice, so none again around the corner
        v = origin_of(t, loop[i if i < n else i - n])
        if visits[v] >= 0:
            shortest = min(shortest, i - visits[v])
        visits[v] = i
    _forget(t, loop, n, visits)
    return shortest


@kernel
def _forget(t: Any, loop: Any, n: int, visits: Any) -> None:
    for i in range(n):
        visits[origin_of(t, loop[i])] = -1


@kernel
def _middles(t: Any, marks: Any, loop: Any, n: int, way: int, visits: Any, path: Any, cuts: Any) -> int:
    """The middle edge of every way of that length, into `cuts`: how many."""
    n_cuts = 0
    for i in range(n + way):
        v = origin_of(t, loop[i if i < n else i - n])
        if visits[v] >= 0 and i - visits[v] == way:
            cuts[n_cuts] = _middle(t, marks, loop[visits[v]], v, way, path)
            n_cuts += 1
        visits[v] = i
    _forget(t, loop, n, visits)
    return n_cuts


@kernel
def _middle(t: Any, marks: Any, h: int, w: int, way: int, path: Any) -> int:
    """The middle one of the internal edges that are crossed on the shortest path of triangles along a way.

    `h` leaves the vertex `w`, and `way` sides later the walk is there again. Steps that are taken back don't count, nor
    do the edges at `w`, between triangles that meet there anyway. Of two in the middle it is the first.
    """
    n = 0
    for _ in range(way - 1):
        h = next_of(t, h)
        g = twin_of(t, h)
        while is_internal(marks, h, g):
            if n > 0 and path[n - 1] == g:
                n -= 1
            else:
                path[n] = h
                n += 1
            h = next_of(t, g)
            g = twin_of(t, h)
    first, last = 0, n - 1
    while first < last and _touches(t, path[first], w):
        first += 1
    while last > first and _touches(t, path[last], w):
        last -= 1
    return path[(first + last) >> 1]  # type: ignore[no-any-return]


@kernel
def _touches(t: Any, h: int, v: int) -> bool:
    return origin_of(t, h) == v or target_of(t, h) == v  # type: ignore[no-any-return]
