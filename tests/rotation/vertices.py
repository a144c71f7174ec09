"""Splitting and joining vertices, welding them at gaps, and dissolving, on rings."""

from __future__ import annotations

from .edges import are_beside, contract, join_faces, why_not_join_faces
from .rings import true

# -- split and join --------------------------------------------------------------------------------------------------


def why_not_split_vertex(m, h, g):
    return true(different_vertices=m.origin[h] != m.origin[g])


def split_vertex(m, h, g):
    """What stands after `h` up to `g` goes to the new vertex, and the new edge takes its place."""
    v, w = m.origin[h], m.new_vertex()
    after = m.ring_after(h)
    moved = [] if h == g else after[: after.index(g) + 1]
    rest = after if h == g else after[after.index(g) + 1 :]
    x = m.new_edge(v, w)
    m.face[x], m.face[x ^ 1] = m.face[g], m.face[h]
    m.ring[v], m.ring[w] = [x, *rest], [x ^ 1, *moved]
    m.move(moved, w)
    return x


def why_not_join_vertices(m, h, weight, allow_parallel):
    a, b = m.origin[h], m.target(h)
    if a == b:
        return {"loop_edge"}
    alone = set(m.loop(h)) == {h, h ^ 1} and not m.is_outside(h)
    return true(small_face=alone) | (set() if allow_parallel else union(m, a, b, {h >> 1}))


def union(m, a, b, without=frozenset()):
    """What speaks against making one vertex of two, some edges left out."""
    common = (m.neighbors(a) & m.neighbors(b)) - {a, b}
    return true(would_be_loop=bool(m.edges_between(a, b) - without), would_be_parallel=bool(common))


def join_vertices(m, h, weight, allow_parallel):
    f, g = are_beside(m, h)
    b = contract(m, h)
    m.show_again(f, g)
    return b


# -- weld ------------------------------------------------------------------------------------------------------------


def why_not_weld(m, a, b, allow_parallel):
    u, v = m.origin[a], m.origin[b]
    reasons = true(not_exterior=not (m.is_outside(a) and m.is_outside(b)), same_vertex=u == v)
    return reasons or (set() if allow_parallel else union(m, u, v))


def weld(m, a, b, allow_parallel):
    """Each ring is opened in front of its gap, and the two are tied to one."""
    u, v = m.origin[a], m.origin[b]
    moved = m.ring_after(b)
    m.ring[u] = moved + m.ring_after(a)
    m.move(moved, u)
    del m.ring[v]
    return u


def why_not_weld_vertices(m, u, v, allow_parallel):
    if u == v or not m.ring[u] or not m.ring[v]:
        return true(same_vertex=u == v)
    reasons = true(closed_vertex=m.is_closed(u) or m.is_closed(v))
    return reasons or (set() if allow_parallel else union(m, u, v))


def weld_vertices(m, u, v, allow_parallel):
    if m.ring[u] and m.ring[v]:
        return weld(m, m.shown_at[u], m.shown_at[v], allow_parallel)
    m.move(m.ring[v], u)
    m.ring[u] += m.ring.pop(v)
    return u


def why_not_unweld(m, a, b):
    return true(
        not_exterior=not (m.is_outside(a) and m.is_outside(b)),
        different_vertices=m.origin[a] != m.origin[b],
        same_corner=a == b,
    )


def unweld(m, a, b):
    v, w = m.origin[a], m.new_vertex()
    after = m.ring_after(a)
    k = after.index(b) + 1
    m.ring[w], m.ring[v] = after[:k], after[k:]
    m.move(m.ring[w], w)
    return w


# -- dissolve --------------------------------------------------------------------------------------------------------


def shown(m, v):
    """The dart that the library shows for a vertex, or another where the twin has moved on meanwhile."""
    allowed = m.gaps(v) or m.ring[v]
    return m.shown_at[v] if m.shown_at[v] in allowed else allowed[0]


def faces_around(m, v):
    return [m.face[h] for h in m.ring[v] if not m.is_outside(h)]


def sides_left(m, v):
    """How many sides the face has that takes the place of all around `v`, its spokes not counted."""
    sides = [h for h in m.face if m.face[h] in faces_around(m, v)]
    return sum(m.origin[h] != v and m.target(h) != v for h in sides)


def why_not_dissolve_vertex(m, v):
    ring = m.ring[v]
    if not ring:
        return {"isolated_vertex"}
    if any(m.target(h) == v for h in ring):
        return {"loop_edge"} | true(several_gaps=len(m.gaps(v)) > 1)
    if len(ring) == 1:
        return why_not_join_vertices(m, ring[0], 1.0, False)
    if len(ring) == 2:
        return why_not_join_vertices(m, m.ccw(shown(m, v)), 1.0, False)
    reasons = true(several_gaps=len(m.gaps(v)) > 1, same_face=repeated(faces_around(m, v)))
    if m.is_closed(v):
        return reasons | true(small_face=sides_left(m, v) < 3)
    s = shown(m, v)
    u, w = m.target(s), m.target(m.ccw(s))
    joined = true(would_be_loop=u == w, would_be_parallel=u != w and bool(m.edges_between(u, w)))
    return reasons | joined | true(small_face=sides_left(m, v) + 1 < 3)


def repeated(items):
    return len(set(items)) < len(items)


def dissolve_vertex(m, v):
    s = shown(m, v)
    if len(m.ring[v]) == 1:
        join_vertices(m, s, 1.0, False)
    elif len(m.ring[v]) == 2:
        join_vertices(m, m.ccw(s), 1.0, False)
    elif m.is_closed(v):
        unite_around(m, v, m.face[s], keep=())
        del m.ring[v]
    else:
        first = m.ccw(s)
        unite_around(m, v, m.face[first], keep=(s, first))
        join_vertices(m, first, 1.0, False)
    return 0


def unite_around(m, v, f, keep):
    """All faces around the vertex become `f`; its edges go but those to keep."""
    around = set(faces_around(m, v))
    for h in m.face:
        if m.face[h] in around:
            m.face[h] = f
    for h in list(m.ring[v]):
        if h not in keep:
            m.forget_edge(h)
    m.show_again(f)


def why_not_dissolve_edge(m, h):
    return why_not_join_faces(m, h)


def dissolve_edge(m, h):
    """Which of the two edges of an end remains is the library's choice."""
    ends = (m.origin[h], m.target(h))
    f = join_faces(m, h)
    for v in ends:
        if v in m.ring and len(m.ring[v]) == 2:
            alive = m.told.topology.next
            remaining = [x for x in m.ring[v] if alive[x] >= 0]
            m.shown_at[v] = remaining[0] if remaining else m.ring[v][0]
            if m.gaps(v) and m.shown_at[v] not in m.gaps(v):
                m.shown_at[v] = m.gaps(v)[0]
            if not why_not_dissolve_vertex(m, v):
                dissolve_vertex(m, v)
    return f
