"""Holes made and filled, and faces grown along them: on rings."""

from __future__ import annotations

from .edges import insert_edge, would_be_joined_twice
from .rings import true


def make_hole(m, f):
    h = m.side(f)
    m.lift(f)
    return h


def why_not_fill_hole(m, h):
    return true(not_exterior=not m.is_outside(h))


def fill_hole(m, h):
    return m.new_face(h)


def why_not_grow(m, h, g):
    if not (m.is_outside(h) and m.is_outside(g)):
        return {"not_exterior"} | true(same_corner=h == g)
    return true(same_corner=h == g, different_loops=g not in m.loop(h))


def why_not_add_face_to_boundary(m, h, g, allow_parallel):
    return why_not_grow(m, h, g) or would_be_joined_twice(m, m.origin[g], m.origin[h], allow_parallel)


def add_face_to_boundary(m, h, g, allow_parallel):
    return m.new_face(insert_edge(m, g, h))


def why_not_add_vertex_and_face_to_boundary(m, h, g):
    return why_not_grow(m, h, g)


def add_vertex_and_face_to_boundary(m, h, g):
    w = m.new_vertex()
    x = m.new_edge(m.origin[g], w)
    y = m.new_edge(w, m.origin[h])
    m.put_after(g, x)
    m.put_after(h, y ^ 1)
    m.ring[w] = [x ^ 1, y]
    m.new_face(h)
    return w
