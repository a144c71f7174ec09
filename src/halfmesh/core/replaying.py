r"""Adding faces vertex by vertex instead of face by face, without writing anything.

What adding a face does to the ring of a vertex depends on that ring alone and on the faces that were added there
before. So the steps of `operators.faces` can be taken for one vertex after the other, in the order of the faces at
each, and what comes out is the same, the order of several fans included. But all that belongs to a vertex lies in the
cache then, and vertices have nothing to do with each other: threads share them out. Where all faces close around the
vertex there is but one way, and nothing is replayed.

The ring of the vertex at hand is a list of *spokes*, one for each edge, and a spoke stands for the vertex at its other
end. A spoke is *free to leave* if its outgoing halfedge is exterior and *free to arrive* if the incoming one is. From
a spoke that is free to leave clockwise to the next that is free to arrive runs a *fan* (wire is a fan of one spoke),
and then comes a gap::

    clockwise around v:   ... | a x x b | c | d x e | ...        a, c, d: free to leave; b, c, e: free to arrive

                          AFTER[b] = c, BEFORE[c] = b            across the gap: next and prev of the exterior
                          LAST[a] = b, FIRST[b] = a              the ends of a fan, NONE if a (b) is not free any more

A face that comes along `p` and leaves along `n` brings the fan that begins at `n` behind the one that ends at `p`, and
makes them one. So every step is O(1), however many faces there are around the vertex.
"""

from __future__ import annotations

from typing import Any

from halfmesh._jit import inline_kernel, kernel
from halfmesh.core.matching import NONE, before, corner_range, face_of_corner, kept, sort_block

__all__ = ["REFUSED", "SPOKE", "halfedge_of", "replay_blocks"]

REFUSED = -1

# a spoke: the vertex at its other end, the halfedge that leaves along it, the new corner from which one does, and the
# links of the picture
SPOKE = 8
_VERTEX, _HALFEDGE, _CORNER, _AFTER, _BEFORE, _LAST, _FIRST = range(7)


@kernel
def replay_blocks(
    vertex_halfedge: Any,
    prev: Any,
    origin: Any,
    face: Any,
    streams: Any,
    starts: Any,
    shift: int,
    n_vertices: int,
    degree: int,
    corner_faces: Any,
    first: Any,
    around: Any,
    table: Any,
    spokes: Any,
    mates: Any,
    shown: Any,
    gaps: Any,
    low: int,
    high: int,
) -> int:
    """Add the faces at the vertices of the blocks low..high; returns how many gaps there are then, or REFUSED.

    ``mates`` gets what `number_edges` takes; ``shown`` the halfedge of each vertex, and ``gaps`` the halfedges that
    leave along the spokes before and after each gap, all as `halfedge_of` takes them.
    """
    n = 0
    for block in range(low, high):
        if starts[block] == starts[block + 1]:
            continue
        base = block << shift
        n_here = min(n_vertices - base, 1 << shift)
        sort_block(streams, starts[block], starts[block + 1], base, n_here, first, around)
        _close_vertices(
            vertex_halfedge, prev, origin, face, degree, corner_faces, first, around, table, mates, shown, base, n_here
        )
        for v in range(n_here):
            begin, end = first[v], first[v + 1]
            if begin == end or shown[base + v] != NONE:
                continue
            size = _open_ring(vertex_halfedge, prev, origin, face, base + v, table, spokes)
            if size == REFUSED:
                return REFUSED
            size, top = _replay(degree, corner_faces, around, table, spokes, begin, end, size)
            if size == REFUSED:
                return REFUSED
            shown[base + v] = spokes[SPOKE * top + _HALFEDGE]
            n = _report(around, spokes, mates, gaps, begin, end, size, n)
    return n


@kernel
def _close_vertices(
    vertex_halfedge: Any,
    prev: Any,
    origin: Any,
    face: Any,
    degree: int,
    corner_faces: Any,
    first: Any,
    around: Any,
    table: Any,
    mates: Any,
    shown: Any,
    base: int,
    size: int,
) -> None:
    """Match the corners of those vertices of a block around which all faces, old and new ones, close.

    That can be only in one way, whatever comes first: there is nothing to replay. The corners of old faces are put
    behind those of the block, with their halfedge, `kept`, for the corner; matched are all of them as in `matching`.
    One loop, since a call for each vertex counts references to all these arrays.
    """
    far = first[size]
    for v in range(size):
        begin, end = first[v], first[v + 1]
        start = vertex_halfedge[base + v]
        if begin == end or start < -1:
            continue
        fits = True
        n, h = far, start
        u = origin[h ^ 1] if h >= 0 else NONE
        while h >= 0:
            x = prev[h]
            w = origin[x]
            if face[h] >= 0:
                around[3 * n] = w
                around[3 * n + 1] = u
                around[3 * n + 2] = kept(h)
                table[u] = n
                n += 1
            elif face[h ^ 1] < 0:
                fits = False  # wire
                break
            h, u = x ^ 1, w
            if h == start:
                break
        last_face = NONE
        for i in range(begin, end):
            u = around[3 * i + 1]
            j = table[u]
            if (begin <= j < i or far <= j < n) and around[3 * j + 1] == u:
                fits = False
            table[u] = i
            if degree != 3:
                f = face_of_corner(degree, corner_faces, around[3 * i + 2])
                fits = fits and f != last_face
                last_face = f
        if not fits:
            continue
        total = end - begin + n - far
        i, walked = begin, 0
        for _ in range(total):
            u = around[3 * i]
            j = table[u]
            if not ((begin <= j < end or far <= j < n) and around[3 * j + 1] == u):
                break
            if i < end:
                c = around[3 * j + 2]
                mates[around[3 * i + 2]] = c if c >= 0 else kept(kept(c) ^ 1)
            walked += 1
            i = j
            if i == begin:
                break
        if i == begin and walked == total:
            shown[base + v] = kept(2 * around[3 * end - 1])


@inline_kernel
def _open_ring(vertex_halfedge: Any, prev: Any, origin: Any, face: Any, v: int, table: Any, spokes: Any) -> int:
    """The spokes of the vertex as it is; how many, of which the last is that of its halfedge, or REFUSED.

    Refused are vertices that are deleted or closed, at which nothing can be added, and those at which an edge is a
    loop or parallel to another: a spoke would not be told by its other end.
    """
    start = vertex_halfedge[v]
    if start < 0:
        return 0 if start == -1 else REFUSED
    n = low = 0
    h = start
    while True:
        h = prev[h] ^ 1
        u = origin[h ^ 1]
        if u == v or _find(table, spokes, n, u) >= 0:
            return REFUSED
        table[u] = n
        s = SPOKE * n
        spokes[s + _VERTEX] = u
        spokes[s + _HALFEDGE] = h
        spokes[s + _CORNER] = NONE
        spokes[s + _LAST] = NONE
        spokes[s + _FIRST] = NONE
        n += 1
        if face[h] < 0:  # counter-clockwise that is the end of a fan, which has begun at `low`
            spokes[s + _LAST] = low
            spokes[s + _BEFORE] = n
            spokes[SPOKE * low + _FIRST] = n - 1
            spokes[SPOKE * low + _AFTER] = low - 1
            low = n
        if h == start:
            break
    if low < n:
        return REFUSED
    spokes[_AFTER] = n - 1
    spokes[SPOKE * (n - 1) + _BEFORE] = 0
    return n


@inline_kernel
def _find(table: Any, spokes: Any, n: int, u: int) -> int:
    """The spoke to `u`, or -1. The table is never cleared: an entry counts only if the spoke agrees."""
    s = table[u]
    return s if s < n and spokes[SPOKE * s + _VERTEX] == u else NONE


@inline_kernel
def _replay(
    degree: int, corner_faces: Any, around: Any, table: Any, spokes: Any, begin: int, end: int, n: int
) -> tuple[int, int]:
    """Add the faces of the corners begin..end, one after the other; the number of spokes, and that which is shown.

    What `operators.faces` says no to is refused, and a face that passes the vertex twice. The spokes to which the
    faces come are left in the place of the vertices before the corners.
    """
    top, last_face = n - 1, NONE
    for i in range(begin, end):
        p, q, c = around[3 * i], around[3 * i + 1], around[3 * i + 2]
        f = face_of_corner(degree, corner_faces, c)
        came, left = _find(table, spokes, n, p), _find(table, spokes, n, q)
        if f == last_face or (came >= 0 and spokes[SPOKE * came + _FIRST] < 0):
            return REFUSED, NONE
        if left >= 0 and spokes[SPOKE * left + _LAST] < 0:
            return REFUSED, NONE
        last_face = f
        if came < 0 or left < 0:
            if n > 0 and spokes[SPOKE * top + _LAST] < 0:
                return REFUSED, NONE  # closed
            # the order in which the two are hung is lost when they are joined
            if came < 0:
                came = _hang(table, spokes, n, top, p, kept(2 * c + 1))
                top = came if n == 0 else top
                n += 1
            if left < 0:
                left = _hang(table, spokes, n, top, q, kept(2 * c))
                n += 1
        joined = _join(spokes, came, left)
        if joined == REFUSED:
            return REFUSED, NONE
        top = joined if top == left else top
        spokes[SPOKE * left + _CORNER] = c
        around[3 * i] = came
    return n, top


@inline_kernel
def _hang(table: Any, spokes: Any, n: int, top: int, u: int, h: int) -> int:
    """A new spoke to `u`, in the gap before `top`; `n` is its number."""
    table[u] = n
    s, after, previous = SPOKE * n, n, n
    if n > 0:
        after, previous = top, spokes[SPOKE * top + _BEFORE]
    spokes[s + _VERTEX] = u
    spokes[s + _HALFEDGE] = h
    spokes[s + _CORNER] = NONE
    spokes[s + _LAST] = n
    spokes[s + _FIRST] = n
    _link(spokes, n, after)
    _link(spokes, previous, n)
    return n


@inline_kernel
def _link(spokes: Any, before: int, after: int) -> None:
    spokes[SPOKE * before + _AFTER] = after
    spokes[SPOKE * after + _BEFORE] = before


@inline_kernel
def _join(spokes: Any, came: int, left: int) -> int:
    """Lay a face from `came` to `left`, which are free: the spoke at which its fan begins, `left` if it has closed.

    Refused is to close one of several fans.
    """
    begins, ends, following = spokes[SPOKE * came + _FIRST], spokes[SPOKE * left + _LAST], spokes[SPOKE * came + _AFTER]
    if following != left:
        if ends == came:
            return REFUSED
        previous, behind = spokes[SPOKE * left + _BEFORE], spokes[SPOKE * ends + _AFTER]
        _link(spokes, ends, following)
        _link(spokes, previous, behind)
    spokes[SPOKE * begins + _LAST] = ends
    spokes[SPOKE * ends + _FIRST] = begins
    spokes[SPOKE * came + _FIRST] = NONE
    spokes[SPOKE * left + _LAST] = NONE
    return begins  # type: ignore[no-any-return]


@inline_kernel
def _report(around: Any, spokes: Any, mates: Any, gaps: Any, begin: int, end: int, size: int, n: int) -> int:
    """Tell the mates of the corners begin..end, and the gaps, of which there were `n` before; how many there are."""
    for i in range(begin, end):
        s = SPOKE * around[3 * i]
        h = spokes[s + _HALFEDGE]
        mates[around[3 * i + 2]] = kept(h ^ 1) if h >= 0 else spokes[s + _CORNER]
    for i in range(size):
        s = SPOKE * i
        if spokes[s + _FIRST] >= 0:
            gaps[2 * n] = spokes[s + _HALFEDGE]
            gaps[2 * n + 1] = spokes[SPOKE * spokes[s + _AFTER] + _HALFEDGE]
            n += 1
    return n


@inline_kernel
def halfedge_of(degree: int, offsets: Any, corner_faces: Any, halfedges: Any, h: int) -> int:
    """The halfedge that leaves along a spoke: it, or once new ones are numbered the one that the spoke was made for."""
    if h >= 0:
        return h
    c = kept(h) >> 1
    if kept(h) & 1 == 0:
        return halfedges[c]  # type: ignore[no-any-return]
    begin, end = corner_range(degree, offsets, face_of_corner(degree, corner_faces, c))
    return halfedges[before(c, begin, end)] ^ 1  # type: ignore[no-any-return]
