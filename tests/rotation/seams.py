"""Edges opened and closed, cuts and stitches: on rings."""

from __future__ import annotations

from itertools import combinations

from .building import make_adjacent, why_not_make_adjacent
from .rings import OUTSIDE, true
from .vertices import unweld, weld

# -- edges opened and closed -----------------------------------------------------------------------------------------


def is_boundary(m, h):
    return m.is_outside(h) or m.is_outside(h ^ 1)


def why_not_open_edge(m, h):
    return true(boundary_edge=is_boundary(m, h))


def open_edge(m, h):
    o = h ^ 1
    y = m.new_edge(m.origin[o], m.origin[h])
    m.put_after(o, y)
    m.put_before(h, y ^ 1)
    m.face[y], m.face[o] = m.face[o], OUTSIDE
    return y


def why_not_close_edge(m, h):
    two_sided = len(m.loop(h)) == 2 and m.next(h) != h ^ 1
    return true(not_exterior=not m.is_outside(h), not_two_sided=not two_sided)


def close_edge(m, h):
    n = m.next(h)
    m.face[h] = m.face[n ^ 1]
    m.forget_edge(n)
    return 0


# -- cut -------------------------------------------------------------------------------------------------------------


def why_not_cut(m, path):
    edges = [h >> 1 for h in path]
    return true(
        repeated_halfedge=len(set(edges)) < len(edges),
        boundary_edge=any(is_boundary(m, h) for h in path),
    )


def cut(m, path):
    """Every end of an edge that is cut comes apart into as many vertices as it touches gaps."""
    first = m.slots[1]
    opened = [open_edge(m, h) for h in path]
    for h, y in zip(path, opened, strict=True):
        for x in (y ^ 1, h ^ 1):
            for _ in m.gaps(m.origin[x])[1:]:
                unweld(m, x, next(z for z in m.ring_after(x) if m.is_outside(z)))
    return first


# -- stitch ----------------------------------------------------------------------------------------------------------


def why_not_stitch(m, a, b, allow_parallel):
    reasons = true(
        not_exterior=not (m.is_outside(a) and m.is_outside(b)),
        same_edge=a >> 1 == b >> 1,
        loop_edge=m.origin[a] == m.target(a) or m.origin[b] == m.target(b),
        would_be_loop=m.origin[a] == m.origin[b] or m.target(a) == m.target(b),
    )
    if reasons:
        return reasons
    apart = true(no_gap=not bring_together(m.copy(), a, b))
    return apart | (set() if allow_parallel else what_edges_would_become(m, a, b))


def what_edges_would_become(m, a, b):
    """Loops, or parallel though they were not. The stitched edge was both, and what closes next is excused."""
    united = {m.target(b): m.origin[a], m.origin[b]: m.target(a)}
    sides = ((m.next(b), m.prev(a)), (m.next(a), m.prev(b)))
    closing = [{x >> 1, y >> 1} for y, x in sides if m.next(y) == x and not {x >> 1, y >> 1} & {a >> 1, b >> 1}]
    before, after = {}, {}
    for h in (h for h in m.origin if h % 2 == 0 and h >> 1 != b >> 1):
        before[h >> 1] = [{m.origin[h], m.target(h)}]
        after[h >> 1] = {united.get(v, v) for v in (m.origin[h], m.target(h))}
    before[a >> 1].append({m.origin[b], m.target(b)})
    return true(
        would_be_loop=any(len(after[e]) == 1 for e in before if len(before[e][0]) == 2),
        would_be_parallel=any(
            len(after[x]) == 2
            and after[x] == after[y]
            and not any(ends in before[y] for ends in before[x])
            and {x, y} not in closing
            for x, y in combinations(before, 2)
        ),
    )


def bring_together(m, a, b):
    """Weld or reorder the ends of `a` and `b`, until they run around a hole of two sides; whether that is possible."""
    if m.origin[a] != m.target(b):
        weld(m, a, m.next(b), True)
    elif why_not_make_adjacent(m, b, a):
        return False
    else:
        make_adjacent(m, b, a)
    if m.target(a) != m.origin[b]:
        weld(m, m.next(a), b, True)
    elif why_not_make_adjacent(m, a, b):
        return False
    else:
        make_adjacent(m, a, b)
    return True


def stitch(m, a, b, allow_parallel):
    bring_together(m, a, b)
    close_edge(m, a)
    return a


def why_not_zip_hole(m, h, n):
    return why_not_stitch(m, h, m.next(h), False)


def zip_hole(m, h, n):
    """One pair after the other, until one may not be stitched or a side of it is gone."""
    done, a, b = 0, h, m.next(h)
    while done != n and a in m.face and b in m.face and not why_not_stitch(m, a, b, False):
        following = m.prev(a), m.next(b)
        stitch(m, a, b, False)
        done += 1
        a, b = following
    return done
