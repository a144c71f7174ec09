"""Building by hand, on rings: what is hung into gaps, what is moved between gaps, and what is taken away.

Clockwise around a vertex the darts stand in *fans*: runs that begin with an exterior dart. Between two fans is a gap.
Nothing that is built takes a fan apart; fans are put into another order, like beads on a string.
"""

from __future__ import annotations

from itertools import pairwise

from .rings import OUTSIDE, true


def fans(m, v):
    """The fans of a vertex, clockwise; each begins with its only exterior dart. None if faces close all around."""
    clockwise = m.ring[v][::-1]
    starts = [k for k, h in enumerate(clockwise) if m.is_outside(h)]
    if not starts:
        return []
    turned = clockwise[starts[0] :] + clockwise[: starts[0]]
    cuts = [k - starts[0] for k in starts] + [len(turned)]
    return [turned[i:j] for i, j in pairwise(cuts)]


def fan_of(m, h):
    """The place among the fans of the origin of the fan that has `h`."""
    return next(k for k, fan in enumerate(fans(m, m.origin[h])) if h in fan)


# -- vertices and edges ----------------------------------------------------------------------------------------------


def add_vertex(m):
    return m.new_vertex()


def add_vertices(m, n):
    first = m.slots[0]
    for _ in range(n):
        m.new_vertex()
    return first


def why_not_add_edge(m, u, v):
    return true(closed_vertex=m.is_closed(u) or m.is_closed(v))


def add_edge(m, u, v):
    return add_edge_in(m, u, -1, v, -1)


def why_not_add_edge_in(m, u, gap_u, v, gap_v):
    reasons = set()
    for end, gap in ((u, gap_u), (v, gap_v)):
        if end not in m.ring or (gap >= 0 and gap not in m.origin):
            continue  # which is a reason by itself
        if gap < 0:
            reasons |= true(closed_vertex=m.is_closed(end))
        else:
            reasons |= true(not_exterior=not m.is_outside(gap), different_vertices=m.origin[gap] != end)
    return reasons


def add_edge_in(m, u, gap_u, v, gap_v):
    """Each end goes into the corner of its gap, of the one that is shown where none is said."""
    h = m.new_edge(u, v)
    for end, gap, x in ((u, gap_u, h), (v, gap_v, h + 1)):
        if gap >= 0 or m.shown_at[end] >= 0:
            m.put_after(gap if gap >= 0 else m.shown_at[end], x)
        else:
            m.ring[end].append(x)
    return h


# -- make adjacent ---------------------------------------------------------------------------------------------------


def first_gap_between(m, h_in, h_out):
    """Clockwise from `h_out` to short of the twin of `h_in`: up to the first dart that a gap follows, or None."""
    clockwise = m.ring_after(h_out)[::-1]  # `h_out` comes first
    before = clockwise[: clockwise.index(h_in ^ 1)]
    ends = [k for k, x in enumerate(before) if m.is_outside(x ^ 1)]
    return before[: ends[0] + 1] if ends else None


def why_not_make_adjacent(m, h_in, h_out):
    if m.target(h_in) != m.origin[h_out]:
        return {"not_a_chain"} | true(taken_halfedge=not (m.is_outside(h_in) and m.is_outside(h_out)))
    if not (m.is_outside(h_in) and m.is_outside(h_out)):
        return {"taken_halfedge"}
    return true(no_gap=m.next(h_in) != h_out and first_gap_between(m, h_in, h_out) is None)


def make_adjacent(m, h_in, h_out):
    if m.next(h_in) != h_out:
        for x in first_gap_between(m, h_in, h_out):
            m.take_out(x)
            m.put_before(h_in ^ 1, x)  # which is clockwise after it
            h_in = x ^ 1
    return 0


# -- faces -----------------------------------------------------------------------------------------------------------


def cyclic_pairs(items):
    return list(zip(items, [*items[1:], *items[:1]], strict=True))


def can_follow(m, sides):
    """Whether the fans of every vertex can be strung up so that each side is followed by the next.

    Each pair ties the fan that a side arrives by to the fan that the next one leaves by. A string of tied fans that
    closes must hold all fans of its vertex.
    """
    for v in {m.origin[h] for h in sides}:
        tied = {fan_of(m, a ^ 1): fan_of(m, b) for a, b in cyclic_pairs(sides) if m.origin[b] == v}
        for first, second in tied.items():
            string, k = [first], second
            while k not in string and k in tied:
                string.append(k)
                k = tied[k]
            if k == first and len(string) < len(fans(m, v)):
                return False
    return True


def why_not_add_face(m, sides):
    if not sides:
        return {"empty_face"}
    reasons = true(
        not_a_chain=any(m.target(a) != m.origin[b] for a, b in cyclic_pairs(sides)),
        taken_halfedge=not all(m.is_outside(h) for h in sides),
    )
    repeated = true(repeated_halfedge=len(set(sides)) < len(sides))
    return reasons | repeated | (set() if reasons else true(no_gap=not can_follow(m, sides)))


def add_face(m, sides):
    """In which order the other fans come to stand is the library's choice, but fans they stay."""
    for v in {m.origin[h] for h in sides}:
        old = fans(m, v)
        m.ring[v] = ring_in(m.told, v)
        assert sorted(fans(m, v)) == sorted(old), f"the fans around vertex {v} were taken apart"
    assert m.loop(sides[0]) == list(sides), "the sides do not follow each other"
    return m.new_face(sides[0])


def ring_in(mesh, v):
    """The ring as the library has it now."""
    prev, h = mesh.topology.prev, int(mesh.topology.vertex_halfedge[v])
    ring = [h]
    while int(prev[ring[-1]]) ^ 1 != h:
        ring.append(int(prev[ring[-1]]) ^ 1)
    return ring


def ways_to_lay(m, corners):
    """Every mesh with the missing edges made, and the sides, for each choice among parallel edges; None: no way."""
    ways = [(m.copy(), [])]
    for u, v in cyclic_pairs(corners):
        more = []
        for mesh, sides in ways:
            free = [h for h in mesh.ring[u] if mesh.target(h) == v and mesh.is_outside(h) and h not in sides]
            if free:
                more += [(mesh, [*sides, h]) for h in free]
            elif not mesh.edges_between(u, v) and not (m.is_closed(u) or m.is_closed(v)):
                wider = mesh.copy()
                more.append((wider, [*sides, hang_edge(wider, u, v)]))
        ways = more
    return ways


def hang_edge(m, u, v):
    """An edge in some gap of each end."""
    h = m.new_edge(u, v)
    for end, x in ((u, h), (v, h + 1)):
        others = m.gaps(end)
        if others:
            m.put_after(others[0], x)
        else:
            m.ring[end].append(x)
    return h


def why_not_add_face_of_vertices(m, corners):
    """With parallel edges to choose from, the first that is found may be the wrong one: then either answer is right."""
    if not corners:
        return {"empty_face"}
    if len(corners) < 3:
        return {"few_vertices"} | true(repeated_vertex=any(u == v for u, v in cyclic_pairs(corners)))
    if any(u == v for u, v in cyclic_pairs(corners)):
        return {"repeated_vertex"}
    ways = ways_to_lay(m, corners)
    possible = [can_follow(mesh, sides) for mesh, sides in ways]
    if ways and all(possible):
        return set() if len(ways) == 1 else {"either"}
    taken = true(closed_vertex=any(m.is_closed(v) for v in corners)) | {"taken_halfedge", "repeated_halfedge"}
    if ways:
        return {"no_gap"} | ({"either"} | taken if len(ways) > 1 else set())
    return taken


def add_face_of_vertices(m, corners):
    last = m.told.n_faces and len(m.told.topology.face_halfedge) - 1
    first = int(m.told.topology.face_halfedge[last])
    found = [first]
    while int(m.told.topology.next[found[-1]]) != first:
        found.append(int(m.told.topology.next[found[-1]]))
    chosen = [(mesh, sides) for mesh, sides in ways_to_lay(m, corners) if sides == found and can_follow(mesh, sides)]
    assert chosen, f"the sides of the new face are {found}"
    mesh, sides = chosen[0]
    m.slots, m.ring, m.origin, m.face = mesh.slots, mesh.ring, mesh.origin, mesh.face
    return add_face(m, sides)


def why_not_add_polygon(m, *corners):
    return why_not_add_face_of_vertices(m, corners)


def add_polygon(m, *corners):
    return add_face_of_vertices(m, corners)


# -- taking away -----------------------------------------------------------------------------------------------------


def remove_face(m, f):
    m.lift(f)
    return 0


def remove_edge(m, e):
    for h in (2 * e, 2 * e + 1):
        if m.face[h] != OUTSIDE:
            m.lift(m.face[h])
    m.forget_edge(2 * e)
    return 0


def remove_vertex(m, v):
    while m.ring[v]:
        remove_edge(m, m.ring[v][0] >> 1)
    del m.ring[v]
    return 0


def faces_at(m, *darts):
    return {m.face[h] for h in darts} - {OUTSIDE}
