"""The slow obvious twin: a mesh as a rotation system, in plain Python dictionaries and lists.

A *dart* is a directed side of an edge. The twin keeps, for every vertex, the cyclic list of the darts that leave it
and, for every face, the cyclic list of its darts. It is made from the face list alone, shares no code with the
library, and decides by itself what can be held: the oracle of the tests.
"""

from __future__ import annotations

from collections import Counter, defaultdict

OUTSIDE = -1


class Refused(Exception):  # noqa: N818 - an answer, not a failure
    """The faces are not a mesh: the first kind of defect, and everything that has it."""

    def __init__(self, reason: str, **elements: object) -> None:
        super().__init__(reason)
        self.reason = reason
        self.elements = elements


class Reference:
    """``ring[v]`` and ``loop[f]`` are cyclic lists of darts; darts are numbered as the library numbers halfedges."""

    def __init__(self, faces, n_vertices, twins=None, edges=()):
        self.faces = [list(face) for face in faces]
        self.n_vertices = n_vertices
        self.corners = [(f, k) for f, face in enumerate(self.faces) for k in range(len(face))]
        refuse_bad_faces(self.faces, n_vertices)
        if twins is None:
            refuse_bad_edges(self.faces)
            twins = matched(self.faces)
        others = [None if t == OUTSIDE else self.corners[t] for t in twins]
        self.twin_corner = dict(zip(self.corners, others, strict=True))
        self._number_darts()
        self._turn_around_vertices()
        for u, v in edges:
            self._add_wire(u, v)

    # -- darts ---------------------------------------------------------------------------------------------------

    def _number_darts(self):
        """An edge is numbered when its first corner turns up, and dart 2e runs that way."""
        self.dart, self.origin, self.face_of = {}, [], []
        for corner in self.corners:
            if corner in self.dart:
                continue
            other = self.twin_corner[corner]
            self.dart[corner] = len(self.origin)
            self.origin += [self.vertex(corner), self.vertex(self.after(corner))]
            self.face_of += [corner[0], OUTSIDE if other is None else other[0]]
            if other is not None:
                self.dart[other] = self.dart[corner] + 1
        self.loop = [[self.dart[f, k] for k in range(len(face))] for f, face in enumerate(self.faces)]

    def vertex(self, corner):
        return self.faces[corner[0]][corner[1]]

    def after(self, corner):
        return corner[0], (corner[1] + 1) % len(self.faces[corner[0]])

    def before(self, corner):
        return corner[0], (corner[1] - 1) % len(self.faces[corner[0]])

    # -- rings ---------------------------------------------------------------------------------------------------

    def _turn_around_vertices(self):
        """Link corners into fans: the corner ccw of a corner starts with the twin of the dart before it."""
        ccw = {c: self.twin_corner[self.before(c)] for c in self.corners}
        cw = {b: a for a, b in ccw.items() if b is not None}
        at = defaultdict(list)
        for corner in self.corners:
            at[self.vertex(corner)].append(corner)
        self.ring = [[] for _ in range(self.n_vertices)]
        bad = []
        for v, corners in at.items():
            starts = [c for c in corners if c not in cw]
            fans = [fan_from(c, ccw) for c in starts]
            left = set(corners).difference(*fans)
            if left and (fans or len(fan_from(next(iter(left)), ccw)) < len(left)):
                bad.append(v)
            elif left:  # closed: the halfedge of the vertex is that of its first corner, and the ring ends there
                fan = fan_from(corners[0], ccw)
                self.ring[v] = [self.dart[c] for c in [*fan[1:], fan[0]]]
            else:
                self.ring[v] = [d for fan in sorted(fans, key=self._rank) for d in self._wedge(fan)]
        if bad:
            faces = {f for f, face in enumerate(self.faces) if set(face) & set(bad)}
            raise Refused("nonmanifold_vertex", vertices=set(bad), faces=faces)

    def _wedge(self, fan):
        """The darts of an open fan, the exterior one last."""
        return [self.dart[c] for c in fan] + [self.dart[self.before(fan[-1])] ^ 1]

    def _rank(self, fan):
        """Fans stand in the order of their lowest faces; of one face's two fans, of their exterior darts."""
        return min(f for f, _ in fan), self._wedge(fan)[-1]

    def _add_wire(self, u, v):
        """The new edge goes into the gap after the last dart of each ring, which stays the last."""
        h = len(self.origin)
        self.origin += [u, v]
        self.face_of += [OUTSIDE, OUTSIDE]
        for end, dart in ((u, h), (v, h + 1)):
            if self.ring[end] and self.face_of[self.ring[end][-1]] != OUTSIDE:
                raise Refused("closed_vertex")
            self.ring[end].insert(0, dart)

    # -- the words -----------------------------------------------------------------------------------------------

    @property
    def n_darts(self):
        return len(self.origin)

    def ccw(self, h):
        ring = self.ring[self.origin[h]]
        return ring[(ring.index(h) + 1) % len(ring)]

    def cw(self, h):
        ring = self.ring[self.origin[h]]
        return ring[ring.index(h) - 1]

    def next(self, h):
        """By the rotation alone: around a vertex, what comes before the twin."""
        return self.cw(h ^ 1)

    def prev(self, h):
        return self.ccw(h) ^ 1

    def target(self, h):
        return self.origin[h ^ 1]

    def vertex_halfedge(self, v):
        return self.ring[v][-1] if self.ring[v] else -1

    def columns(self):
        """The six columns as lists, by name."""
        darts = range(self.n_darts)
        return {
            "next": [self.next(h) for h in darts],
            "prev": [self.prev(h) for h in darts],
            "origin": list(self.origin),
            "face": list(self.face_of),
            "vertex_halfedge": [self.vertex_halfedge(v) for v in range(self.n_vertices)],
            "face_halfedge": [loop[0] for loop in self.loop],
        }

    def neighbors(self, v):
        return [self.target(h) for h in self.ring[v]]

    def faces_around(self, v):
        return [self.face_of[h] for h in self.ring[v] if self.face_of[h] != OUTSIDE]

    def face_neighbors(self, f):
        return [self.face_of[h ^ 1] for h in self.loop[f] if self.face_of[h ^ 1] != OUTSIDE]

    def touches_gap(self, v):
        return any(self.face_of[h] == OUTSIDE for h in self.ring[v])

    def boundary_loops(self):
        """Each from its lowest dart, in the order of these."""
        loops, seen = [], set()
        for h in range(self.n_darts):
            if self.face_of[h] == OUTSIDE and h not in seen:
                loop = [h]
                while self.next(loop[-1]) != h:
                    loop.append(self.next(loop[-1]))
                seen.update(loop)
                loops.append(loop)
        return loops

    def components(self):
        """Sets of vertices, by lowest vertex."""
        found, seen = [], set()
        for v in range(self.n_vertices):
            if v not in seen:
                todo, part = [v], {v}
                while todo:
                    new = set(self.neighbors(todo.pop())) - part
                    part |= new
                    todo += new
                seen |= part
                found.append(part)
        return found

    def genus(self, part):
        """Handles of one component with its holes capped."""
        if not any(self.ring[v] for v in part):
            return 0
        darts = sum(u in part for u in self.origin)
        faces = sum(face[0] in part for face in self.faces)
        loops = sum(self.origin[loop[0]] in part for loop in self.boundary_loops())
        return (2 - (len(part) - darts // 2 + faces + loops)) // 2


def fan_from(corner, ccw):
    """The corners met when turning counter-clockwise, until there is none or the first comes again."""
    fan = [corner]
    while ccw[fan[-1]] is not None and ccw[fan[-1]] != corner:
        fan.append(ccw[fan[-1]])
    return fan


def sides(faces):
    """(origin, target, face) of every corner, in order."""
    return [(face[k], face[(k + 1) % len(face)], f) for f, face in enumerate(faces) for k in range(len(face))]


def matched(faces):
    """For each corner, the corner that runs the other way, or OUTSIDE."""
    runs = {(u, v): c for c, (u, v, _) in enumerate(sides(faces))}
    return [runs.get((v, u), OUTSIDE) for u, v, _ in sides(faces)]


# ------------------------------------------------------------------------------------------------------------ refusals


def refuse_bad_faces(faces, n_vertices):
    corner, wild, wild_faces = 0, set(), set()
    for f, face in enumerate(faces):
        for v in face:
            if not 0 <= v < n_vertices:
                wild.add(corner)
                wild_faces.add(f)
            corner += 1
    if wild:
        raise Refused("index_out_of_range", corners=wild, faces=wild_faces)
    small = {f for f, face in enumerate(faces) if len(face) < 3}
    if small:
        raise Refused("small_face", faces=small)


def refuse_bad_edges(faces):
    repeated = [(c, u, f) for c, (u, v, f) in enumerate(sides(faces)) if u == v]
    if repeated:
        corners, vertices, of = (set(column) for column in zip(*repeated, strict=True))
        raise Refused("repeated_vertex", corners=corners, vertices=vertices, faces=of)
    uses = Counter(frozenset((u, v)) for u, v, _ in sides(faces))
    crowded = {edge for edge, n in uses.items() if n > 2}
    if crowded:
        of = {f for u, v, f in sides(faces) if frozenset((u, v)) in crowded}
        raise Refused("nonmanifold_edge", edges={tuple(sorted(edge)) for edge in crowded}, faces=of)
    directed = Counter((u, v) for u, v, _ in sides(faces))
    double = {run for run, n in directed.items() if n > 1}
    if double:
        of = {f for u, v, f in sides(faces) if (u, v) in double}
        raise Refused("inconsistent_orientation" if orientable(faces) else "nonorientable", edges=double, faces=of)


def orientable(faces):
    """Try both orientations of each component: a two-colouring of the faces."""
    by_edge = defaultdict(list)
    for u, v, f in sides(faces):
        by_edge[frozenset((u, v))].append((f, u))
    turned = {}
    for first in range(len(faces)):
        todo = [] if first in turned else [first]
        turned.setdefault(first, False)
        while todo:
            f = todo.pop()
            for uses in by_edge.values():
                if len(uses) == 2 and f in (uses[0][0], uses[1][0]):
                    (a, u), (b, v) = uses
                    g = b if a == f else a
                    wanted = turned[f] != (u == v)
                    if g not in turned:
                        turned[g] = wanted
                        todo.append(g)
                    elif turned[g] != wanted:
                        return False
    return True
