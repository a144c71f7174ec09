"""Polygons that are hard to cut into triangles, counter-clockwise, as lists of points; and slow obvious answers."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction

import numpy as np

import halfmesh as hm

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
ARROW = [(0, 0), (2, 1), (0, 2), (1, 1)]
LETTER_L = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]
SQUARE_WITH_MIDPOINTS = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
TRIANGLE_WITH_A_LONG_SIDE = [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (0, 3)]
CROSS = [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)]
SLIT = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 2), (2, 2), (0, 2)]
KEYHOLE = [(0, 0), (6, 0), (6, 6), (0, 6), (0, 0), (2, 2), (2, 4), (4, 4), (4, 2), (2, 2)]
TWO_HOLES = [*KEYHOLE[:2], (5, 1), (5, 1.5), (5.5, 1), (5, 1), (6, 0), *KEYHOLE[2:]]
PINCHED = [(0, 0), (2, 0), (1, 1), (2, 2), (0, 2), (1, 1)]
TOUCHING_A_SIDE = [(0, 0), (4, 0), (4, 3), (3, 3), (2, 0), (1, 3), (0, 3)]
DOUBLED_CORNER = [(0, 0), (2, 0), (2, 0), (2, 2), (0, 2)]
SPIKE = [(0, 0), (2, 0), (5, 0), (2, 0), (2, 2), (0, 2)]


def comb(teeth):
    """Teeth of different lengths on one long straight side that has a corner below each."""
    x = np.arange(2 * teeth + 1)
    tips = np.where(x % 2, 5 + (x * 7919) % 100, 1)
    return np.concatenate([np.c_[x, 0 * x], np.c_[x, tips][::-1]]).astype(float)


def spiral(turns):
    """A corridor of width 1 around the origin, with right angles."""
    steps = ((1, 0), (0, 1), (-1, 0), (0, -1))
    outer, x, y = [], 0, 0
    for i in range(4 * turns):
        outer.append((x, y))
        x, y = x + 2 * (i // 2 + 2) * steps[i % 4][0], y + 2 * (i // 2 + 2) * steps[i % 4][1]
    turn = [(outer[i], steps[(i - 1) % 4], steps[i % 4]) for i in range(1, 4 * turns)]
    inner = [(p[0] - a[1] - b[1], p[1] + a[0] + b[0]) for p, a, b in turn]
    return np.array(outer + inner[::-1], float)


def star(n, seed=0):
    """Four corners or more at random distances from the origin, which sees all of them."""
    rng = np.random.default_rng(seed)
    angles, radii = 2 * np.pi * (np.arange(n) + rng.uniform(0, 0.9, n)) / n, rng.uniform(0.1, 1, n)
    return np.c_[radii * np.cos(angles), radii * np.sin(angles)]


def tree_of_triangles(n, seed, size):
    """The rim of `n` triangles of a lattice, each glued to one before: it may touch itself in corners and in sides.

    There are n + 2 corners, many in the same places; the area is n / 2. Where size is small it is all slits.
    """
    rng = np.random.default_rng(seed)

    def corners(x, y, upper):
        return ((x, y), (x + 1, y + 1), (x, y + 1)) if upper else ((x, y), (x + 1, y), (x + 1, y + 1))

    def across(x, y, upper, side):
        below, above = ((x, y - 1, 1), (x + 1, y, 1), (x, y, 1)), ((x, y, 0), (x, y + 1, 0), (x - 1, y, 0))
        return (above if upper else below)[side]

    used, rim = {(0, 0, 0)}, [(p, (0, 0, 0), side) for side, p in enumerate(corners(0, 0, 0))]
    for _ in range(30 * n):
        i = rng.integers(len(rim))
        p, cell, side = rim[i]
        other = across(*cell, side)
        if len(used) < n and other not in used and max(abs(other[0]), abs(other[1])) <= size:
            used.add(other)
            three = corners(*other)
            j = (three.index(p) + 1) % 3
            rim[i : i + 1] = [(p, other, three.index(p)), (three[j], other, j)]
    return np.array([p for p, _, _ in rim], float)


# ------------------------------------------------------------------------------------- polygons as meshes, and answers


def as_mesh(polygon):
    """One face, each corner a vertex of its own."""
    return hm.Mesh([range(len(polygon))], np.array(polygon, float))


def as_mesh_with_shared_vertices(polygon):
    """One face; corners at the same place are one vertex."""
    places, corners = np.unique(np.array(polygon, float), axis=0, return_inverse=True)
    return hm.Mesh([corners.ravel().tolist()], places)


def joined_twice(mesh):
    """Pairs of vertices that more than one edge joins, and loops."""
    pairs = Counter(tuple(sorted(pair)) for pair in mesh.edge_vertices()[mesh.edges.indices].tolist())
    return {pair for pair, n in pairs.items() if n > 1 or pair[0] == pair[1]}


def state(mesh):
    """Everything that a refused operation must leave as it was."""
    columns = ("next", "prev", "origin", "face", "vertex_halfedge", "face_halfedge")
    tables = (mesh.vertex_data, mesh.halfedge_data, mesh.edge_data, mesh.face_data)
    values = [{name: column.tolist() for name, column in table.items()} for table in tables]
    return [getattr(mesh.topology, c).tolist() for c in columns], values, mesh.revision, mesh.n_exterior_halfedges


def doubled_areas(mesh, polygon=None):
    """Twice the signed area of each triangle of a mesh, exactly; or as if its corners were at other places."""
    points = mesh.points if polygon is None else np.asarray(polygon, float)
    return [doubled_area(*points[triangle]) for triangle in mesh.triangles()]


def doubled_area(a, b, c):
    """Exact, for any floats."""
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(float(x)), Fraction(float(y))) for x, y in (a[:2], b[:2], c[:2]))
    return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)


def signed_area(polygon):
    x, y = np.asarray(polygon, float).T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum()) / 2


def is_inside(polygon, i, k):
    """Whether the diagonal of corners i and k crosses no side and is inside in its middle, if no three are in line."""
    n = len(polygon)
    a, b = polygon[i], polygon[k]
    for j in range(n):
        p, q = polygon[j], polygon[(j + 1) % n]
        if {j, (j + 1) % n} & {i, k}:
            continue
        if doubled_area(a, b, p) * doubled_area(a, b, q) < 0 and doubled_area(p, q, a) * doubled_area(p, q, b) < 0:
            return False
    x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
    inside = False
    for (px, py), (qx, qy) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        if (py > y) != (qy > y) and x < (qx - px) * (y - py) / (qy - py) + px:
            inside = not inside
    return inside
