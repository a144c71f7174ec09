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

from typing import Any, NamedTuple

import numpy as np

from halfmesh._jit import kernel, parallel
from halfmesh.algorithms._polylla_marks import CUT, PENDING, Bytes, Ints, is_internal
from halfmesh.algorithms._polylla_travel import Travel, first_frontier
from halfmesh.core.matching import parts
from halfmesh.core.navigation import next_of, origin_of, target_of, twin_of

__all__ = ["Repair", "repair"]


class Repair(NamedTuple):
    """All polygons after the repair: those of the seeds first, what was cut off from them behind."""

    seeds: Ints
    degrees: Ints


def repair(t: Any, marks: Bytes, seeds: Ints, found: Travel, n_vertices: int) -> Repair:
    """Cut the bad regions into simple polygons; marks the edges and corrects the degrees in place."""
    bad, degrees = found.bad, found.degrees
    if len(bad) == 0:
        return Repair(seeds, degrees)
    n_sides = int(degrees[bad].sum())
    most = int(degrees[bad].max())
    jobs, made = [], []
    for low, high in parts(len(bad), n_sides):
        room = int(degrees[bad[low:high]].sum())
        added, sizes = np.empty(room, dtype=np.int32), np.empty(room, dtype=np.int32)
        scratch = [np.empty(n, dtype=np.int32) for n in (most, 2 * most, 2 * most, most)]
        visits = np.full(max(n_vertices, 1), -1, dtype=np.int32)
        jobs.append((t, marks, seeds, bad, degrees, added, sizes, visits, *scratch, low, high))
        made.append((added, sizes))
    counts = parallel(_repair.at(10 * n_sides), jobs)
    behind = [[rows[k][:n] for rows, n in zip(made, counts, strict=True)] for k in range(2)]
    return Repair(np.concatenate([seeds, *behind[0]]), np.concatenate([degrees, *behind[1]]))


@kernel
def _repair(
    t: Any, marks: Any, seeds: Any, bad: Any, degrees: Any, added: Any, sizes: Any, visits: Any,
    loop: Any, path: Any, stack: Any, cuts: Any, low: int, high: int,
) -> int:  # fmt: skip
    """Returns how many polygons were added: a halfedge of each in `added`, its degree in `sizes`."""
    n_added = 0
    for i in range(low, high):
        p = bad[i]
        stack[0] = first_frontier(t, marks, seeds[p])
        marks[stack[0]] |= PENDING
        top = 1
        while top > 0:
            top -= 1
            start = stack[top]
            if (marks[start] & PENDING) == 0:
                continue
            n, has_seed = _walk(t, marks, start, seeds[p], loop)
            way = _shortest_way(t, loop, n, visits)
            if way == n:  # simple
                if has_seed:
                    degrees[p] = n
                else:
                    added[n_added], sizes[n_added] = start, n
                    n_added += 1
                continue
            n_cuts = _middles(t, marks, loop, n, way, visits, path, cuts)
            for k in range(n_cuts):
                h = cuts[k]
                if is_internal(t, marks, h):  # two ways may have the same middle
                    g = twin_of(t, h)
                    marks[h] |= CUT | PENDING
                    marks[g] |= CUT | PENDING
                    stack[top], stack[top + 1] = h, g
                    top += 2
    return n_added


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
        while is_internal(t, marks, h):
            has_seed |= h == seed
            h = next_of(t, twin_of(t, h))
        if h == start:
            return n, has_seed


@kernel
def _shortest_way(t: Any, loop: Any, n: int, visits: Any) -> int:
    """The least number of sides from a vertex to the same vertex; `n`, once around, if none is passed twice."""
    shortest = n
    for i in range(2 * n):
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
        while is_internal(t, marks, h):
            g = twin_of(t, h)
            if n > 0 and path[n - 1] == g:
                n -= 1
            else:
                path[n] = h
                n += 1
            h = next_of(t, g)
    first, last = 0, n - 1
    while first < last and _touches(t, path[first], w):
        first += 1
    while last > first and _touches(t, path[last], w):
        last -= 1
    return path[(first + last) >> 1]  # type: ignore[no-any-return]


@kernel
def _touches(t: Any, h: int, v: int) -> bool:
    return origin_of(t, h) == v or target_of(t, h) == v  # type: ignore[no-any-return]
