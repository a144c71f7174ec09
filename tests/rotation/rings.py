"""A mesh that changes, as plain lists: for every living vertex the darts that leave it, counter-clockwise.

Everything else follows: what comes after a dart around its face is what stands before its twin in the twin's ring.
Beside the rings there is a label on every dart, its face, and the numbers of slots, so that new elements are numbered
as the library numbers them. Which dart stands for a vertex or a face is the library's choice: that is read, after
the laws are checked, and is all that is read.
"""

from __future__ import annotations

import numpy as np

from halfmesh.core.topology import DELETED

OUTSIDE = -1
VERTICES, EDGES, FACES = range(3)


class Rotation:
    """``ring[v]`` is a cyclic list of darts; ``origin`` and ``face`` are of darts; all of the living only."""

    def __init__(self, mesh):
        t = mesh.topology
        self.slots = [len(t.vertex_halfedge), len(t.next) // 2, len(t.face_halfedge)]
        living = [h for h, after in enumerate(t.next.tolist()) if after != DELETED]
        self.origin = {h: int(t.origin[h]) for h in living}
        self.face = {h: int(t.face[h]) for h in living}
        self.ring = {v: ring_from(h, t.prev) for v, h in enumerate(t.vertex_halfedge.tolist()) if h != DELETED}
        self.read_choices(mesh)

    def copy(self):
        other = object.__new__(Rotation)
        other.slots, other.ring = list(self.slots), {v: list(ring) for v, ring in self.ring.items()}
        other.origin, other.face = dict(self.origin), dict(self.face)
        other.shown_at, other.shown_in, other.told = dict(self.shown_at), dict(self.shown_in), self.told
        return other

    def read_choices(self, mesh):
        """Which dart the library shows for a vertex and for a face."""
        self.shown_at = dict(enumerate(mesh.topology.vertex_halfedge.tolist()))
        self.shown_in = dict(enumerate(mesh.topology.face_halfedge.tolist()))
        self.told = None  # the library's mesh after an operator, while the twin does the same

    # -- the words -----------------------------------------------------------------------------------------------

    def ccw(self, h):
        ring = self.ring[self.origin[h]]
        return ring[(ring.index(h) + 1) % len(ring)]

    def cw(self, h):
        ring = self.ring[self.origin[h]]
        return ring[ring.index(h) - 1]

    def next(self, h):
        return self.cw(h ^ 1)

    def prev(self, h):
        return self.ccw(h) ^ 1

    def target(self, h):
        return self.origin[h ^ 1]

    def loop(self, h):
        """The darts around the face or hole of `h`, from `h` on."""
        found = [h]
        while self.next(found[-1]) != h:
            found.append(self.next(found[-1]))
        return found

    def ring_after(self, h):
        """The darts that leave the origin of `h`, from the one after it on, all around; `h` is the last."""
        ring = self.ring[self.origin[h]]
        k = ring.index(h) + 1
        return ring[k:] + ring[:k]

    def faces(self):
        return set(self.face.values()) - {OUTSIDE}

    def side(self, f):
        """The dart that the library shows for a face."""
        return self.shown_in[f]

    def is_outside(self, h):
        return self.face[h] == OUTSIDE

    def gaps(self, v):
        """The exterior darts that leave a vertex."""
        return [h for h in self.ring[v] if self.is_outside(h)]

    def is_closed(self, v):
        return bool(self.ring[v]) and not self.gaps(v)

    def neighbors(self, v):
        return {self.target(h) for h in self.ring[v]}

    def edges_between(self, u, v):
        """The edges that join two vertices, a loop edge once."""
        return {h >> 1 for h in self.ring[u] if self.target(h) == v}

    def corners(self, f):
        """The vertices of a face, as often as it passes them."""
        return [self.origin[h] for h in self.loop(self.side(f))]

    # -- figures -------------------------------------------------------------------------------------------------

    def counts(self):
        return len(self.ring), len(self.origin) // 2, len(self.faces())

    def boundary_loops(self):
        left, n = {h for h in self.face if self.is_outside(h)}, 0
        while left:
            left.difference_update(self.loop(min(left)))
            n += 1
        return n

    def component(self, v):
        todo, part = [v], {v}
        while todo:
            new = self.neighbors(todo.pop()) - part
            part |= new
            todo += new
        return part

    def n_components(self):
        left, n = set(self.ring), 0
        while left:
            left -= self.component(min(left))
            n += 1
        return n

    # -- what operators are made of ------------------------------------------------------------------------------

    def new_vertex(self):
        v = self.slots[VERTICES]
        self.slots[VERTICES] += 1
        self.ring[v] = []
        return v

    def new_edge(self, u, v):
        """The even dart from `u` to `v`, which still hangs nowhere."""
        h = 2 * self.slots[EDGES]
        self.slots[EDGES] += 1
        self.origin[h], self.origin[h + 1] = u, v
        self.face[h] = self.face[h + 1] = OUTSIDE
        return h

    def new_face(self, h):
        """The next face, laid along the whole loop of `h`."""
        f = self.slots[FACES]
        self.slots[FACES] += 1
        self.shown_in[f] = h
        self.lay(f, h)
        return f

    def lay(self, f, h):
        for x in self.loop(h):
            self.face[x] = f

    def lift(self, f):
        """Take a face away: outside is where it was."""
        for h in [h for h, label in self.face.items() if label == f]:
            self.face[h] = OUTSIDE

    def show_again(self, *faces):
        """Show another dart for a face that has lost the one it was shown by."""
        for f in faces:
            if f != OUTSIDE and self.face.get(self.shown_in[f]) != f:
                self.shown_in[f] = next(h for h, label in self.face.items() if label == f)

    def put_after(self, h, x):
        """Put the dart `x` into the corner of `h`, which lies between it and the next counter-clockwise."""
        ring = self.ring[self.origin[h]]
        ring.insert(ring.index(h) + 1, x)

    def put_before(self, h, x):
        ring = self.ring[self.origin[h]]
        ring.insert(ring.index(h), x)

    def put_in_place_of(self, h, darts):
        ring = self.ring[self.origin[h]]
        k = ring.index(h)
        ring[k : k + 1] = darts

    def take_out(self, h):
        self.ring[self.origin[h]].remove(h)

    def forget_edge(self, h):
        """Take both darts out of their rings and forget them."""
        for x in (h, h ^ 1):
            self.take_out(x)
        for x in (h, h ^ 1):
            del self.origin[x], self.face[x]

    def move(self, darts, v):
        """Give darts another origin; the rings are the caller's."""
        for x in darts:
            self.origin[x] = v

    # -- the comparison ------------------------------------------------------------------------------------------

    def columns(self):
        """The four columns of halfedges, as lists."""
        made = {}
        of = {"next": self.next, "prev": self.prev, "origin": self.origin.get, "face": self.face.get}
        for name, value in of.items():
            made[name] = [value(h) if h in self.origin else DELETED for h in range(2 * self.slots[EDGES])]
        return made

    def assert_same(self, mesh):
        """The mesh is what the rings say, element by element."""
        t = mesh.topology
        for name, mine in self.columns().items():
            theirs = getattr(t, name).tolist()
            assert len(mine) == len(theirs), f"{len(theirs)} halfedges, expected {len(mine)}"
            wrong = [(h, a, b) for h, (a, b) in enumerate(zip(theirs, mine, strict=True)) if a != b]
            assert not wrong, f"{name} is wrong (halfedge, found, expected): {wrong[:8]}"
        for what, slots, column, living, allowed in (
            ("vertex_halfedge", self.slots[VERTICES], t.vertex_halfedge, self.ring, self._may_show_vertex),
            ("face_halfedge", self.slots[FACES], t.face_halfedge, self.faces(), self._may_show_face),
        ):
            assert len(column) == slots, f"{what} has {len(column)} rows, expected {slots}"
            for x, h in enumerate(column.tolist()):
                assert (h != DELETED) == (x in living), f"{what}[{x}] is {h}, alive: {x in living}"
                assert h == DELETED or allowed(x, h), f"{what}[{x}] is {h}, which does not stand for it"
        assert (mesh.n_vertices, mesh.n_edges, mesh.n_faces) == self.counts()

    def _may_show_vertex(self, v, h):
        return h in (self.gaps(v) or self.ring[v] or [-1])

    def _may_show_face(self, f, h):
        return self.face.get(h) == f


def ring_from(h, prev):
    """Turn counter-clockwise from `h`, as the columns say."""
    ring = [] if h < 0 else [h]
    while ring and int(prev[ring[-1]]) ^ 1 != h:
        ring.append(int(prev[ring[-1]]) ^ 1)
        assert len(ring) <= len(prev), "a ring that does not close"
    return ring


def true(**conditions):
    """The names of what holds: reasons not to do it."""
    return {name for name, holds in conditions.items() if holds}


def as_ints(path):
    return [int(h) for h in np.asarray(path).tolist()]
