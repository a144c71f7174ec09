"""Where the arrows of a structure diagram run: halfedges beside their edges, bends that link them at the corners."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from halfmesh.viewer.plane import Cubic, arc, left, sampled, turn, unit
from halfmesh.viewer.style import Measures
from halfmesh.viewer.wiring import Wiring

__all__ = ["Arrow", "Arrows", "Bend", "draw_arrows", "full_head", "half_head", "segments_of"]


@dataclass(frozen=True)
class Arrow:
    """The half-arrow of one halfedge: straight from tail to tip, left of its edge."""

    index: int
    tail: complex
    tip: complex
    direction: complex

    def at(self, t: float) -> complex:
        """The point at the fraction ``t`` of the way."""
        return self.tail + t * (self.tip - self.tail)


@dataclass(frozen=True)
class Bend:
    """The curved arrow from the tip of halfedge ``index`` to the tail of the next one."""

    index: int
    start: complex
    pieces: list[Cubic]
    direction: complex  # in which it arrives


@dataclass(frozen=True)
class Arrows:
    """Everything that is drawn as a line: half-arrows and bends by halfedge, twin marks by edge."""

    halfedges: dict[int, Arrow]
    bends: dict[int, Bend]
    twins: dict[int, tuple[complex, complex]]
    edges: dict[int, tuple[complex, complex]]


def draw_arrows(wiring: Wiring, place: list[complex], size: Measures) -> Arrows:
    """Lay out all arrows for vertices at ``place`` (screen coordinates); O(halfedges)."""
    way = {h: unit(place[wiring.target(h)] - place[wiring.origin[h]]) for h in wiring.halfedges}
    halfedges = {h: _arrow(wiring, place, size, way, h) for h in wiring.halfedges}
    bends = {h: _bend(halfedges[h], halfedges[wiring.next[h]], place[wiring.target(h)], size) for h in wiring.halfedges}
    edges = {h >> 1: (place[wiring.origin[h]], place[wiring.target(h)]) for h in wiring.halfedges if h % 2 == 0}
    twins = {e: _twin_mark(halfedges[2 * e], halfedges[2 * e + 1], size) for e in edges}
    return Arrows(halfedges, bends, twins, edges)


def segments_of(arrows: Arrows) -> NDArray[np.float64]:
    """All lines as straight segments, rows x0 y0 x1 y1, shape (n, 4): what labels must keep away from."""
    rows: list[tuple[complex, complex]] = list(arrows.edges.values())
    rows += arrows.twins.values()
    rows += ((a.tail, a.tip) for a in arrows.halfedges.values())
    for bend in arrows.bends.values():
        points = sampled(bend.start, bend.pieces)
        rows += pairwise(points)
    return np.array([(p.real, p.imag, q.real, q.imag) for p, q in rows], dtype=np.float64).reshape(-1, 4)


def _arrow(wiring: Wiring, place: list[complex], size: Measures, way: dict[int, complex], h: int) -> Arrow:
    a, b = place[wiring.origin[h]], place[wiring.target(h)]
    along = way[h]
    room = 0.36 * abs(b - a)
    side = size.offset * left(along)
    start = min(_setback(way[wiring.prev[h]], along, size), room)
    end = min(_setback(along, way[wiring.next[h]], size), room)
    return Arrow(h, a + start * along + side, b - end * along + side, along)


def _setback(coming: complex, going: complex, size: Measures) -> float:
    """How far from the vertex halfedges end at this corner: further in a sharp one, where their lines cross."""
    angle = turn(going, -coming)
    crossing = size.offset / math.tan(angle / 2) if angle < math.pi else 0.0
    return max(size.stub, crossing + size.bend)


def _bend(arrow: Arrow, following: Arrow, vertex: complex, size: Measures) -> Bend:
    coming, going = arrow.direction, following.direction
    start = arrow.tip + size.gap * coming
    end = following.tail - 0.7 * size.gap * going
    angle = turn(going, -coming)
    if angle > math.pi:  # around the vertex, keeping the distance
        around = vertex + size.offset * left(coming)
        turned = arc(vertex, around, angle - math.pi)
        pieces = [_straight(start, around), *turned, _straight(turned[-1][2], end)]
        return Bend(arrow.index, start, pieces, going)
    # where the two lines meet: the curve leaves along the one and arrives along the other
    corner = vertex + size.offset * (left(coming) + left(going)) / (1 + (coming * going.conjugate()).real + 1e-9)
    ahead = ((corner - start) * coming.conjugate()).real
    behind = ((end - corner) * going.conjugate()).real
    if min(ahead, behind) <= 0:  # a very short edge: the lines have met already
        corner = (start + end) / 2
    return Bend(arrow.index, start, [(start + 0.72 * (corner - start), end + 0.72 * (corner - end), end)], going)


def _straight(start: complex, end: complex) -> Cubic:
    return start + (end - start) / 3, end + (start - end) / 3, end


def _twin_mark(arrow: Arrow, twin: Arrow, size: Measures) -> tuple[complex, complex]:
    """From the one half-arrow to the other, across the middle of the edge."""
    middle = (arrow.tail + arrow.tip + twin.tail + twin.tip) / 4
    side = (size.offset - 1.1 * size.gap) * left(arrow.direction)
    return middle + side, middle - side


def half_head(arrow: Arrow, length: float, width: float) -> list[complex]:
    """The triangle of a half-arrow's head: one barb, on the side of the face."""
    along = arrow.direction
    tip = arrow.tip - 0.1 * width * left(along)
    return [tip, arrow.tip - length * along + 0.62 * length * left(along), tip - 0.74 * length * along]


def full_head(tip: complex, direction: complex, length: float) -> list[complex]:
    """The triangle of an ordinary arrow head."""
    back = tip - length * direction
    return [tip, back + 0.46 * length * left(direction), back - 0.46 * length * left(direction)]
