"""A surface split along a loop of edges, and two faces glued: on rings."""

from __future__ import annotations

from .holes import fill_hole
from .rings import true
from .seams import cut, is_boundary, stitch, why_not_stitch


def why_not_split_loop(m, path):
    ends = [m.origin[h] for h in path]
    chain = all(m.target(h) == v for h, v in zip(path, ends[1:] + ends[:1], strict=True))
    return true(
        small_face=len(path) < 3,
        not_a_chain=not chain,
        boundary_edge=any(is_boundary(m, h) for h in path),
        not_a_cycle=len(set(ends)) < len(ends) or not all(m.is_closed(v) for v in ends),
    )


def split_loop(m, path):
    y = 2 * cut(m, path)
    f = fill_hole(m, path[0] ^ 1)
    fill_hole(m, y ^ 1)
    return f


def why_not_join_loop(m, h, g, allow_parallel):
    if m.is_outside(h) or m.is_outside(g):
        return {"no_face"} | true(same_face=m.face[h] == m.face[g])
    if m.face[h] == m.face[g]:
        return {"same_face"}
    one, other = ([m.origin[x] for x in m.loop(y)] for y in (h, g))
    reasons = true(
        different_degrees=len(one) != len(other),
        shared_vertex=len(set(one + other)) < len(one + other),
    )
    return reasons or glue(m.copy(), h, g, allow_parallel)


def glue(m, h, g, allow_parallel):
    """Take both faces out and stitch their sides in turn; the first refusal."""
    pairs = list(zip(m.loop(h), [g, *m.loop(g)[:0:-1]], strict=True))
    m.lift(m.face[h])
    m.lift(m.face[g])
    for a, b in pairs:
        if b not in m.face:  # the face ran along both sides of one edge, which is gone
            return {"same_edge"}
        reasons = why_not_stitch(m, a, b, allow_parallel)
        if reasons:
            return reasons
        stitch(m, a, b, allow_parallel)
    return set()


def join_loop(m, h, g, allow_parallel):
    glue(m, h, g, allow_parallel)
    return h
