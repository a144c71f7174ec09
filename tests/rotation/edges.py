"""Flip, split, connect, join and collapse, on rings. ``why_not_x`` gives every reason that is true, ``x`` acts."""

from __future__ import annotations

from itertools import combinations, product

from .rings import OUTSIDE, true


def are_beside(m, h):
    """The faces on both sides of an edge."""
    return m.face[h], m.face[h ^ 1]


def would_be_joined_twice(m, u, v, allow_parallel):
    """What speaks against one more edge between two vertices."""
    joined = not allow_parallel and bool(m.edges_between(u, v))
    return true(would_be_loop=not allow_parallel and u == v, would_be_parallel=joined)


# -- flip ------------------------------------------------------------------------------------------------------------


def why_not_flip(m, e, allow_parallel):
    h, o = 2 * e, 2 * e + 1
    if OUTSIDE in are_beside(m, h):
        return {"boundary_edge"}
    small = min(len(m.loop(h)), len(m.loop(o))) < 3
    c, d = m.target(m.next(h)), m.target(m.next(o))
    others = m.edges_between(c, d) - {e}
    return true(
        same_face=m.face[h] == m.face[o],
        small_face=small,
        would_be_loop=c == d and not allow_parallel,
        would_be_parallel=bool(others) and not allow_parallel,
    )


def flip(m, e, allow_parallel):
    """Each end moves on along its face, into the corner in front of the dart that it came by."""
    h, o = 2 * e, 2 * e + 1
    n, on = m.next(h), m.next(o)
    f, g = m.face[h], m.face[o]
    for x, past in ((h, on), (o, n)):
        m.take_out(x)
        m.origin[x] = m.target(past)
    m.put_before(on ^ 1, h)
    m.put_before(n ^ 1, o)
    m.face[on], m.face[n] = f, g
    m.show_again(f, g)
    return 0


# -- splits ----------------------------------------------------------------------------------------------------------


def split_edge(m, h, weight):
    v = m.new_vertex()
    o, b = h ^ 1, m.target(h)
    h2 = m.new_edge(v, b)
    m.put_in_place_of(o, [h2 ^ 1])
    m.origin[o] = v
    m.ring[v] = [h2, o]
    m.face[h2], m.face[h2 ^ 1] = m.face[h], m.face[o]
    return v


def split_face(m, f):
    v = m.new_vertex()
    sides = m.loop(m.side(f))
    for h in sides:
        spoke = m.new_edge(m.origin[h], v)
        m.put_after(h, spoke)
        m.ring[v].append(spoke ^ 1)
    m.lay(f, sides[0])
    for h in sides[1:]:
        m.new_face(h)
    return v


def is_plain_triangle(m, h):
    """A face of three sides, of which `h` is one and its twin none."""
    return not m.is_outside(h) and len(m.loop(h)) == 3 and h ^ 1 not in m.loop(h)


def why_not_split_edge_triangular(m, h, weight, allow_parallel):
    beside = [x for x in (h, h ^ 1) if not m.is_outside(x)]
    triangles = [x for x in beside if is_plain_triangle(m, x)]
    apexes = [m.target(m.next(x)) for x in triangles]
    double = len(set(apexes)) < len(apexes) or {m.origin[h], m.target(h)} & set(apexes)
    return true(not_triangle=triangles != beside, would_be_parallel=bool(double) and not allow_parallel)


def split_edge_triangular(m, h, weight, allow_parallel):
    opposite = {x: m.prev(x) for x in (h, h ^ 1)}  # these leave the third corners
    v = split_edge(m, h, weight)
    if not m.is_outside(h):
        connect(m, m.next(h), opposite[h], True)
    if not m.is_outside(h ^ 1):
        connect(m, h ^ 1, opposite[h ^ 1], True)
    return v


# -- connect and join ------------------------------------------------------------------------------------------------


def insert_edge(m, h, g):
    """A new edge between the corners of two darts of one loop; its even dart leaves that of `h`."""
    x = m.new_edge(m.origin[h], m.origin[g])
    m.put_after(h, x)
    m.put_after(g, x ^ 1)
    m.face[x] = m.face[x ^ 1] = m.face[h]
    return x


def why_not_connect(m, h, g, allow_parallel):
    if m.is_outside(h) or m.is_outside(g):
        return {"no_face"} | true(different_faces=m.face[h] != m.face[g], same_corner=h == g)
    faces = true(different_faces=m.face[h] != m.face[g], same_corner=h == g)
    return faces or would_be_joined_twice(m, m.origin[h], m.origin[g], allow_parallel)


def connect(m, h, g, allow_parallel):
    x = insert_edge(m, h, g)
    m.new_face(x)
    return x


def why_not_join_faces(m, h):
    f, g = are_beside(m, h)
    if OUTSIDE in (f, g):
        return {"boundary_edge"}
    return true(same_face=f == g, small_face=1 in (len(m.loop(h)), len(m.loop(h ^ 1))))


def join_faces(m, h):
    f = m.face[h]
    for x in m.loop(h ^ 1):
        m.face[x] = f
    m.forget_edge(h)
    m.show_again(f)
    return f


# -- collapse --------------------------------------------------------------------------------------------------------


def is_triangle(m, h):
    """A face of three sides along three edges."""
    return not m.is_outside(h) and len({x >> 1 for x in m.loop(h)}) == len(m.loop(h)) == 3


def triangles_beside(m, h):
    return [x for x in (h, h ^ 1) if is_triangle(m, x)]


def why_not_collapse(m, h, weight):
    """What the ends have in common must be what the edge has: the triangles beside it, and nothing else."""
    a, b = m.origin[h], m.target(h)
    if a == b:
        return {"loop_edge"}
    triangles = triangles_beside(m, h)
    apexes = [m.target(m.next(x)) for x in triangles]
    shared = len(apexes) == 2 and apexes[0] == apexes[1]
    holes = [m.loop(x) for x in (h, h ^ 1) if m.is_outside(x)]
    small = [x for x in (h, h ^ 1) if len(m.loop(x)) == 2 and not (m.is_outside(x) and m.next(x) == x ^ 1)]
    wire = any(m.is_outside(m.next(x) ^ 1) and m.is_outside(m.prev(x) ^ 1) for x in triangles)
    return what_edges_would_become(m, h) | true(
        small_face=bool(small),
        shared_apex=shared,
        would_leave_wire=wire,
        would_close_hole=any(len(hole) == 3 and len({x >> 1 for x in hole}) == 3 for hole in holes),
        would_pinch=bool(m.gaps(a)) and bool(m.gaps(b)) and OUTSIDE not in are_beside(m, h),
        would_pinch_face=would_pinch_a_face(m, h),
        would_fold=shared or would_fold(m, h),  # the triangles beside the edge, or two behind one of them
    )


def closing_beside(m, h):
    """For each triangle beside the edge, the side that stays, and that at the origin, which goes."""
    return [(m.next(x), m.prev(x)) if x == h else (m.prev(x), m.next(x)) for x in triangles_beside(m, h)]


def what_edges_would_become(m, h):
    """Whether edges that stay become loops, or parallel though they were not; loops are not parallel to loops."""
    a, b = m.origin[h], m.target(h)
    gone = {h >> 1} | {goes >> 1 for _, goes in closing_beside(m, h)}
    moved = [x for x in m.ring[a] if x >> 1 not in gone and m.target(x) != a]
    others = [(x, y) for x, y in product(moved, m.ring[b]) if y >> 1 not in gone and m.target(y) not in (a, b)]
    loops = any(m.target(x) == b for x in moved)
    parallel = loops or any(m.target(x) == m.target(y) for x, y in others)
    return true(would_be_loop=loops, would_be_parallel=parallel)


def repeats(corners):
    return len(corners) - len(set(corners))


def united(m, h):
    """The corners of each face before, and after the origin of `h` has become its target, without its sides."""
    a, b = m.origin[h], m.target(h)
    before = {f: m.corners(f) for f in m.faces()}
    after = {}
    for f in before:
        kept = [x for x in m.loop(m.side(f)) if x >> 1 != h >> 1]
        after[f] = [b if m.origin[x] == a else m.origin[x] for x in kept]
    return before, after


def would_pinch_a_face(m, h):
    """Whether a face that stays comes to pass a vertex more often."""
    before, after = united(m, h)
    gone = {m.face[x] for x in triangles_beside(m, h)}
    return any(repeats(after[f]) > repeats(before[f]) for f in before if f not in gone)


def would_fold(m, h):
    """Whether two triangles that share an edge come to share another: they lie back to back on the same vertices."""
    stays = {goes >> 1: side >> 1 for side, goes in closing_beside(m, h)}
    gone = {m.face[x] for x in triangles_beside(m, h)}
    before = {f: {x >> 1 for x in m.loop(m.side(f))} for f in m.faces() - gone if is_triangle(m, m.side(f))}
    after = {f: {stays.get(e, e) for e in sides} for f, sides in before.items()}
    return any(len(after[f] & after[g]) > len(before[f] & before[g]) > 0 for f, g in combinations(before, 2))


def collapse(m, h, weight):
    """The ends become one vertex, and each triangle, left with two sides, one edge."""
    closing = closing_beside(m, h)
    b = contract(m, h)
    instead = {}  # two triangles may have one edge for their third, when their apexes are the ends of the edge
    for stays, goes in closing:
        stays = instead.get(stays, stays)  # noqa: PLW2901
        instead[goes ^ 1] = stays
        m.face[stays] = m.face[goes ^ 1]
        m.forget_edge(goes)
    return b


def contract(m, h):
    """What left the origin, counter-clockwise after `h`, takes the place of the twin in the ring of the target."""
    a, b = m.origin[h], m.target(h)
    moved = m.ring_after(h)[:-1]
    m.put_in_place_of(h ^ 1, moved)
    m.move(moved, b)
    for x in (h, h ^ 1):
        del m.origin[x], m.face[x]
    del m.ring[a]
    return b
