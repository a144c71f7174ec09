"""Seams: edges opened and closed, and with that the surface cut along a path, stitched, and zipped up."""

from __future__ import annotations

from typing import Any

from halfmesh._jit import kernel, operation
from halfmesh.core.attempts import begin_attempt, end_attempt
from halfmesh.core.navigation import (
    ccw_of,
    face_of,
    halfedge_of_face,
    halfedge_of_vertex,
    is_exterior,
    next_of,
    origin_of,
    prev_of,
    target_of,
)
from halfmesh.core.notes import CORNERS, EDGES, note_copy, note_part
from halfmesh.core.operators.asking import both_status, halfedge_status, is_joined
from halfmesh.core.operators.building import make_adjacent, make_adjacent_status
from halfmesh.core.operators.gaps import close_between, next_gap, show_gap
from halfmesh.core.operators.welds import unweld, weld
from halfmesh.core.pens import changed, link, set_face, set_halfedge_of_face, set_halfedge_of_vertex
from halfmesh.core.slots import is_full, new_edge
from halfmesh.core.statuses import (
    BOUNDARY_EDGE,
    LOOP_EDGE,
    NOT_EXTERIOR,
    NOT_TWO_SIDED,
    OK,
    REPEATED_HALFEDGE,
    SAME_EDGE,
    TOO_LARGE,
    WOULD_BE_LOOP,
    WOULD_BE_PARALLEL,
)
from halfmesh.core.topology import EDGE_SLOTS

__all__ = [
    "close_edge",
    "close_edge_status",
    "cut",
    "cut_status",
    "open_edge",
    "open_edge_status",
    "stitch",
    "stitch_status",
    "try_close_edge",
    "try_cut",
    "try_open_edge",
    "try_stitch",
    "try_zip_hole",
    "zip_hole",
]


# -- one edge or two -----------------------------------------------------------------------------------------------


@operation
def open_edge_status(t: Any, h: int) -> int:
    """Whether the edge of `h` may be opened: ``OK`` or a code. Cost: O(1)."""
    if is_exterior(t, h) or is_exterior(t, h ^ 1):
        return BOUNDARY_EDGE
    return TOO_LARGE if is_full(t, 0, 1, 0) else OK


@kernel
def open_edge(t: Any, h: int) -> int:
    r"""Make two edges of the one of `h`, with a hole of two sides between; returns the first halfedge of the new one.

    `h` keeps its edge and its face, the new halfedge takes the place of its twin. The ends stay. Cost: O(1).

    ::

        a ------> b             a ----h----> b
          <------       -->       <----o---          o and y ^ 1 run around the hole
             o                    --------->
                                  <----y----
    """
    o = h ^ 1
    a, b, g, before, after = origin_of(t, h), origin_of(t, o), face_of(t, o), prev_of(t, o), next_of(t, o)
    y = new_edge(t, b, a)
    set_face(t, y, g)
    set_face(t, o, -1)
    if after == o:
        link(t, y, y)
    else:
        link(t, before, y)
        link(t, y, after)
    link(t, o, y ^ 1)
    link(t, y ^ 1, o)
    if halfedge_of_face(t, g) == o:
        set_halfedge_of_face(t, g, y)
    if not is_exterior(t, halfedge_of_vertex(t, a)):
        set_halfedge_of_vertex(t, a, y ^ 1)
    if not is_exterior(t, halfedge_of_vertex(t, b)):
        set_halfedge_of_vertex(t, b, o)
    note_part(t, EDGES, y >> 1, h >> 1, 0.5)
    note_part(t, EDGES, h >> 1, h >> 1, 0.5)
    note_copy(t, CORNERS, y, o)
    changed(t)
    return y


@operation
def try_open_edge(t: Any, h: int) -> int:
    """Open the edge of `h`: the first halfedge of the new one, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = open_edge_status(t, h)
    return -status if status != OK else open_edge(t, h)


@operation
def close_edge_status(t: Any, h: int) -> int:
    """Whether the hole of `h` lies between two edges: ``OK`` or a code. Cost: O(1)."""
    if not is_exterior(t, h):
        return NOT_EXTERIOR
    n = next_of(t, h)
    return OK if n not in (h, h ^ 1) and next_of(t, n) == h else NOT_TWO_SIDED


@kernel
def close_edge(t: Any, h: int) -> None:
    """Close the hole of two sides on the left of `h`: the edge of `h` stays, that of its next goes.

    Undoes :func:`open_edge`. Cost: the degrees of the ends.
    """
    close_between(t, h, next_of(t, h))
    show_gap(t, origin_of(t, h))
    show_gap(t, target_of(t, h))
    changed(t)


@operation
def try_close_edge(t: Any, h: int) -> int:
    """Close the hole of two sides on the left of `h`: 0, or the negative code."""
    status = halfedge_status(t, h)
    if status == OK:
        status = close_edge_status(t, h)
    if status == OK:
        close_edge(t, h)
    return -status


# -- cut -----------------------------------------------------------------------------------------------------------


@kernel
def try_cut(t: Any, path: Any) -> int:
    """Cut the surface along these halfedges: the first new edge, or the negative code, and nothing changed.

    Each edge is opened, in this order: the new edge of ``path[i]`` is the first plus `i`, and lies on the right. Then
    the ends come apart into as many vertices as they touch gaps. So an end inside of the surface stays whole, and a cut
    that starts at the boundary opens it. Cost: the degrees of the vertices.
    """
    status = cut_status(t, path)
    return -status if status != OK else cut(t, path)


@kernel
def cut_status(t: Any, path: Any) -> int:
    """Whether the surface may be cut along these halfedges: ``OK`` or a code. Cost: their number."""
    n = len(path)
    for i in range(n):
        status = halfedge_status(t, int(path[i]))
        if status == OK:
            status = open_edge_status(t, int(path[i]))
        if status != OK:
            return status
    if is_full(t, 2 * n, n, 0):
        return TOO_LARGE
    return REPEATED_HALFEDGE if _repeats_an_edge(t, path) else OK


@kernel
def _repeats_an_edge(t: Any, path: Any) -> bool:
    """Whether an edge is listed twice: faces are taken from it as a mark, and given back."""
    before = begin_attempt(t)
    found = False
    for i in range(len(path)):
        h = int(path[i])
        if is_exterior(t, h):
            found = True
            break
        set_face(t, h, -1)
        set_face(t, h ^ 1, -1)
    end_attempt(t, before, False)
    return found


@kernel
def cut(t: Any, path: Any) -> int:
    """Cut the surface along these halfedges; returns the first new edge. See :func:`try_cut`."""
    first = t.counts[EDGE_SLOTS]
    for i in range(len(path)):
        open_edge(t, int(path[i]))
    for i in range(len(path)):
        _part(t, 2 * (first + i) + 1)
        _part(t, int(path[i]) ^ 1)
    return first


@kernel
def _part(t: Any, x: int) -> None:
    """Give each fan at the origin of the exterior `x` a vertex of its own; that which ends at `x` keeps it."""
    y = next_gap(t, x)
    while y != x:
        unweld(t, x, y)
        y = next_gap(t, x)


# -- stitch --------------------------------------------------------------------------------------------------------


@operation
def stitch_status(t: Any, a: int, b: int, allow_parallel: bool = False) -> int:
    """Whether `a` and `b` may become the two sides of one edge: ``OK`` or a code.

    Cost: the degree of an end times that of the other that it is united with at worst.
    """
    if not is_exterior(t, a) or not is_exterior(t, b):
        return NOT_EXTERIOR
    if a >> 1 == b >> 1:
        return SAME_EDGE
    if origin_of(t, a) == target_of(t, a) or origin_of(t, b) == target_of(t, b):
        return LOOP_EDGE
    if origin_of(t, a) == origin_of(t, b) or target_of(t, a) == target_of(t, b):
        return WOULD_BE_LOOP
    status = _end_status(t, a, b, allow_parallel)
    if status == OK:
        status = _end_status(t, b, a, allow_parallel)
    if status == OK and not allow_parallel and _doubles(t, a, b):
        status = WOULD_BE_PARALLEL
    return status


@kernel
def _end_status(t: Any, a: int, b: int, allow_parallel: bool) -> int:
    """What the origin of `a` and the target of `b`, to be united, have against it."""
    u, w, g = origin_of(t, a), target_of(t, b), next_of(t, b)
    if u == w:
        return OK if g == a else make_adjacent_status(t, b, a)
    if allow_parallel:
        return OK
    if is_joined(t, a, w):
        return WOULD_BE_LOOP
    q, r = target_of(t, a), origin_of(t, b)  # will be one as well, joined to u by the edges of a and b
    if q != r and (_joins(t, g, q, b >> 1) or _joins(t, a, r, a >> 1)):
        return WOULD_BE_PARALLEL
    p = prev_of(t, a)
    closing = next_of(t, g) == p  # the edges of g and p will bound a hole of two sides, to be closed next
    x = g
    while True:
        y = target_of(t, x)
        if y not in (q, r, w) and _joins(t, a, y, p >> 1 if closing and x == g else -1):
            return WOULD_BE_PARALLEL
        x = ccw_of(t, x)
        if x == g:
            return OK


@kernel
def _doubles(t: Any, a: int, b: int) -> bool:
    """Whether an edge parallel to `a` and one parallel to `b` become parallel, those apart that will be closed next."""
    u, q, w, r = origin_of(t, a), target_of(t, a), target_of(t, b), origin_of(t, b)
    if u == w and q == r:  # they are so already
        return False
    n_pairs = _n_joining(t, a, q, a >> 1) * _n_joining(t, b ^ 1, r, b >> 1)
    if n_pairs == 0:
        return False
    p, g = prev_of(t, a), next_of(t, b)
    x, y = next_of(t, a), prev_of(t, b)
    first = next_of(t, g) == p and origin_of(t, p) == q and target_of(t, g) == r
    first = first and p >> 1 != a >> 1 and g >> 1 != b >> 1
    second = next_of(t, x) == y and target_of(t, x) == u and origin_of(t, y) == w
    second = second and x >> 1 != a >> 1 and y >> 1 != b >> 1 and not (first and p >> 1 == x >> 1 and g >> 1 == y >> 1)
    return n_pairs > int(first) + int(second)


@kernel
def _n_joining(t: Any, h: int, v: int, without: int) -> int:
    """How many edges but this one join the origin of `h` to `v`."""
    n, x = 0, h
    while True:
        n += int(target_of(t, x) == v and x >> 1 != without)
        x = ccw_of(t, x)
        if x == h:
            return n


@kernel
def _joins(t: Any, h: int, v: int, without: int) -> bool:
    """Whether an edge other than this one (-1: any) joins the origin of `h` to `v`."""
    x = h
    while True:
        if target_of(t, x) == v and x >> 1 != without:
            return True
        x = ccw_of(t, x)
        if x == h:
            return False


@kernel
def stitch(t: Any, a: int, b: int) -> int:
    r"""Make `a` and `b`, exterior, the two sides of one edge, that of `a`; returns `a`. The ends of `a` stay.

    Where they do not share an end already, the ends are welded. Cost: the degrees of the ends.

    ::

        p ----a----> q                   p ----a----> q
                              -->          <---------
        s <---b----- r                      with the face behind b
    """
    if origin_of(t, a) != target_of(t, b):
        weld(t, a, next_of(t, b))
    else:
        make_adjacent(t, b, a)
    if target_of(t, a) != origin_of(t, b):
        weld(t, next_of(t, a), b)
    else:
        make_adjacent(t, a, b)
    close_edge(t, a)
    return a


@operation
def try_stitch(t: Any, a: int, b: int, allow_parallel: bool) -> int:
    """Make `a` and `b` the two sides of one edge if that may be: `a`, or the negative code."""
    status = both_status(t, a, b)
    if status == OK:
        status = stitch_status(t, a, b, allow_parallel)
    return -status if status != OK else stitch(t, a, b)


@kernel
def zip_hole(t: Any, h: int, n: int) -> int:
    r"""Stitch `h` to its next, the halfedges before and after these, and so on; returns how many pairs.

    Zips a hole up from the target of `h`, at most `n` pairs, as far as it goes if `n` is negative. Cost: the degrees.

    ::

          ___ a ___ v
         /          h\              /  zips from right to left
        .             . v    -->   . =====
         \__________ /              \
              b     next(h)
    """
    done, a = 0, h
    b = next_of(t, a)
    while done != n and stitch_status(t, a, b) == OK:
        before, after = prev_of(t, a), next_of(t, b)
        gone = b >> 1
        stitch(t, a, b)
        done += 1
        a, b = before, after
        if gone in (a >> 1, b >> 1):  # the hole is closed, or the edge was wire in it
            break
    return done


@kernel
def try_zip_hole(t: Any, h: int, n: int) -> int:
    """Zip the hole on the left of `h`: how many pairs were stitched, or the negative code if none was."""
    status = halfedge_status(t, h)
    if status == OK:
        status = stitch_status(t, h, next_of(t, h))
    return -status if status != OK else zip_hole(t, h, n)
