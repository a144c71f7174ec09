"""Polylla by the book, over dicts and sets: the slow twin of `hm.polylla`, and the certificate of its results.

Written from the description of the algorithm, for triangles without parallel edges: longest edges, regions by
union-find over the edges that are the longest of one of their triangles, a walk around each region, cuts where it
passes a vertex twice. Paths between triangles are searched for; the library never looks for one.
"""

from __future__ import annotations

import numpy as np

import halfmesh as hm

# ------------------------------------------------------------------------------------------------------------- the twin


class Twin:
    """The polygons of triangles, given as a list of three vertices each and points as tuples of three floats.

    Attributes: `polygons` as lists of vertices; `regions`, a set of triangles for each; `n_tips`, `n_repaired`,
    `n_added`; and `defects`, the vertices that each region passed twice before the repair.
    """

    def __init__(self, triangles, points):
        self.triangles = [tuple(map(int, t)) for t in triangles]
        self.points = [tuple(map(float, p)) for p in points]
        self.left = {side: f for f, t in enumerate(self.triangles) for side in sides_of(t)}
        longest = [min(map(frozenset, sides_of(t)), key=self.rank) for t in self.triangles]
        self.internal = {e for e in longest if self.is_inner(e)}
        self.polygons, self.regions, self.defects = [], [], []
        self.n_tips = self.n_repaired = self.n_added = 0
        for region in self.parts(set(range(len(self.triangles)))):
            self.finish(region)

    def rank(self, edge):
        """Longer edges come first, then those with lower ends."""
        ends = sorted(edge, key=lambda v: (self.points[v], v))
        (a, b), (u, v) = [self.points[v] for v in ends], ends
        x, y, z = (p - q for p, q in zip(a, b, strict=True))
        return -(x * x + y * y + z * z), a, b, u, v

    def is_inner(self, edge):
        u, v = edge
        return (u, v) in self.left and (v, u) in self.left

    def parts(self, triangles):
        """Sets of triangles that internal edges join, by union-find."""
        parent = {f: f for f in triangles}

        def root(f):
            return f if parent[f] == f else root(parent[f])

        for u, v in self.internal:
            f, g = self.left[u, v], self.left[v, u]
            if f in triangles and g in triangles:
                parent[root(f)] = root(g)
        return [{f for f in triangles if root(f) == r} for r in triangles if root(r) == r]

    def walk(self, region):
        """The directed sides around a region, in their order."""
        start = next(
            s for f in sorted(region) for s in sides_of(self.triangles[f]) if frozenset(s) not in self.internal
        )
        loop = [start]
        while (side := self.following(loop[-1])) != start:
            loop.append(side)
        return loop

    def following(self, side):
        while True:
            triangle = self.triangles[self.left[side]]
            v = side[1]
            side = v, triangle[(triangle.index(v) + 1) % 3]
            if frozenset(side) not in self.internal:
                return side
            side = side[::-1]

    def finish(self, region):
        loop = self.walk(region)
        before = len(self.polygons)
        passed = [u for u, _ in loop]
        twice = sorted({u for u in passed if passed.count(u) > 1})
        self.n_tips += sum(a == b[::-1] for a, b in zip(loop, loop[1:] + loop[:1], strict=True))
        self.n_repaired += bool(twice)
        self.defects += [twice] if twice else []
        self.cut(region, loop)
        self.n_added += len(self.polygons) - before - 1

    def cut(self, region, loop):
        """Cut the shortest ways from a vertex to itself, until there are none."""
        n = len(loop)
        ways = [(self.length(loop, i), i) for i in range(n)]
        shortest = min(length for length, _ in ways)
        if shortest == n:
            self.polygons.append([u for u, _ in loop])
            self.regions.append(region)
            return
        middles = {self.middle(loop[i], loop[(i + shortest - 1) % n]) for length, i in ways if length == shortest}
        self.internal -= middles
        for part in self.parts(region):
            self.cut(part, self.walk(part))

    def length(self, loop, i):
        """Sides from corner i to the next corner at the same vertex."""
        return next(k for k in range(1, len(loop) + 1) if loop[(i + k) % len(loop)][0] == loop[i][0])

    def middle(self, leaving, arriving):
        """The edge in the middle between the triangles of two sides, of those that aren't at the vertex of both."""
        w = leaving[0]
        assert w == arriving[1]
        path = self.path(self.left[leaving], self.left[arriving])
        while w in path[0]:
            path.pop(0)
        while w in path[-1]:
            path.pop()
        return path[(len(path) - 1) // 2]

    def path(self, f, goal, seen=frozenset()):
        """The internal edges between two triangles of a region."""
        if f == goal:
            return []
        for side in sides_of(self.triangles[f]):
            g = self.left.get(side[::-1])
            if frozenset(side) in self.internal and g not in seen:
                rest = self.path(g, goal, seen | {f})
                if rest is not None:
                    return [frozenset(side), *rest]
        return None


# ------------------------------------------------------------------------------------------------------ the certificate


def certify(mesh, polygons, report):
    """Assert all that is promised of the polygons of a triangle mesh, without the library's own walks."""
    hm.testing.assert_valid(polygons)
    faces = polygons_of(polygons)
    assert all(len(set(face)) == len(face) >= 3 for face in faces), "a polygon is not simple"
    left, right = polygons.edge_faces().T
    assert not ((left == right) & (left >= 0)).any(), "an edge has the same polygon on both sides"
    assert polygons.euler_characteristic == mesh.euler_characteristic
    assert polygons.n_boundary_loops == mesh.n_boundary_loops
    assert polygons.n_connected_components == mesh.n_connected_components
    assert np.allclose(summed_areas(mesh, report), hm.geometry.face_vectors(polygons))
    of_triangle = report.triangle_polygon[mesh.faces.indices].tolist()
    sides = [[] for _ in faces]
    for triangle, p in zip(mesh.triangles().tolist(), of_triangle, strict=True):
        sides[p] += sides_of(triangle)
    for face, own in zip(faces, sides, strict=True):
        assert sorted(side for side in own if side[::-1] not in own) == sorted(sides_of(face)), "not its triangles"
    assert (report.n_triangles, report.n_polygons) == (mesh.n_faces, len(faces))
    assert report.n_frontier_edges == int(((left >= 0) | (right >= 0)).sum())
    assert 2 * report.n_frontier_edges == mesh.n_faces + 2 * len(faces) + int(((left < 0) != (right < 0)).sum())


def summed_areas(mesh, report):
    """The area vectors of the triangles, summed by polygon."""
    made = np.zeros((report.n_polygons, 3))
    np.add.at(made, report.triangle_polygon[mesh.faces.indices], hm.geometry.face_vectors(mesh)[mesh.faces.indices])
    return made


def polygons_of(mesh):
    """The vertices of every face, as lists."""
    indices, offsets = mesh.face_vertices()
    return [row.tolist() for row in np.split(indices, offsets[1:-1])] if len(offsets) > 1 else []


def cycles(polygons):
    """Polygons as a sorted list of cyclic lists, each from its least corner."""
    rows = [list(p) for p in polygons]
    return sorted(p[p.index(min(p)) :] + p[: p.index(min(p))] for p in rows)


def sides_of(face):
    return list(zip(face, [*face[1:], face[0]], strict=True))


# ------------------------------------------------------------------------------------------------------- triangulations


def delaunay(points):
    """The Delaunay triangles of points in the plane, by Bowyer and Watson; what hangs on the hull may be missing."""
    n = len(points)
    p = np.vstack([points, [[-1e3, -1e3], [1e3, -1e3], [0, 1e3]]])
    triangles = np.array([[n, n + 1, n + 2]])
    for i in range(n):
        a, b, c = (p[triangles[:, k]] - p[i] for k in range(3))
        m = np.stack([np.c_[x, (x**2).sum(axis=1)] for x in (a, b, c)], axis=1)
        bad = np.linalg.det(m) > 0
        sides = {(u, v) for t in triangles[bad].tolist() for u, v in sides_of(t)}
        new = [(u, v, i) for u, v in sides if (v, u) not in sides]
        triangles = np.vstack([triangles[~bad], new])
    return triangles[(triangles < n).all(axis=1)]


def random_delaunay(n, seed):
    points = np.random.default_rng(seed).random((n, 2))
    return delaunay(points), np.c_[points, np.zeros(n)]


def lattice(columns, rows, seed, jitter=0.3, around=(False, False)):
    """A grid of cells, each cut along one of its diagonals by chance, the grid's vertices moved a little."""
    rng = np.random.default_rng(seed)
    m, n = columns + (not around[0]), rows + (not around[1])
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    a, b, c, d = (((i + x) % m * n + (j + y) % n).ravel() for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    rising = rng.random(len(a))[:, None] < 0.5
    halves = np.where(rising, np.c_[a, b, c, a, c, d], np.c_[a, b, d, b, c, d]).reshape(-1, 3)
    x, y = np.divmod(np.arange(m * n), n)
    return halves, np.c_[x, y, np.zeros(m * n)] + jitter * np.c_[rng.random((m * n, 2)) - 0.5, np.zeros(m * n)]


def shuffled(triangles, points, seed):
    """The same triangles with vertices and faces in random order and corners rotated; and the new vertex of each."""
    rng = np.random.default_rng(seed)
    new = rng.permutation(len(points))
    moved = np.empty_like(points)
    moved[new] = points
    rows = new[np.asarray(triangles)][rng.permutation(len(triangles))]
    turns = rng.integers(0, 3, len(rows))
    return np.take_along_axis(rows, (np.arange(3) + turns[:, None]) % 3, axis=1), moved, new
