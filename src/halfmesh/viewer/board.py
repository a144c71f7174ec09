"""Finding free spots for labels among lines and other labels.

Spots are tried in a fixed order and costs are compared exactly, so the same mesh always gives the same picture.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from halfmesh.viewer.plane import Box, inside, left

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import numpy as np
    from numpy.typing import NDArray

    from halfmesh.viewer.arrows import Arrow
    from halfmesh.viewer.style import Measures

__all__ = ["Board", "Label", "text_width"]


@dataclass(frozen=True)
class Label:
    """One text in its box. ``kind`` is vertex, halfedge, face or word; ``role`` is a colour name or empty."""

    kind: str
    index: int
    text: str
    role: str
    box: Box
    size: float
    free: bool = True  # whether nothing is in its way


def text_width(text: str, size: float, em: float = 0.58) -> float:
    """A little more than the width of ``text`` in the usual sans-serif fonts."""
    return em * size * len(text)


class Board:
    """The labels so far, and the lines that they keep away from.

    Labels are put down one after the other and stay where they are: the least movable should come first.
    """

    def __init__(self, lines: NDArray[np.float64], size: Measures, width: float) -> None:
        self.width = width
        self.lines = lines
        self.size = size
        self.labels: list[Label] = []

    def fix(self, center: complex, text: str, v: int) -> None:
        """The disc of a vertex: it has one place."""
        r = self.size.radius
        self.labels.append(Label("vertex", v, text, "", Box(center, r, r), self.size.disc))

    def beside(self, arrow: Arrow, text: str, role: str, *, short: str) -> None:
        """A halfedge's label on its own side, near the middle; ``short`` where there is no room for the whole."""
        half_width, half_height = self._half_sizes(text, self.size.small, pill=bool(role))
        normal = left(arrow.direction) if arrow.direction else -1j
        away = Box(0j, half_width, half_height).reach(normal) + self.size.gap
        spots = (
            arrow.at(t) + (away + extra * self.size.gap) * normal
            for extra in (0.0, 1.5, 3.0)
            for t in (0.5, 0.44, 0.56, 0.38, 0.62, 0.3, 0.7, 0.22, 0.78)
        )
        boxes = [Box(spot, half_width, half_height) for spot in spots]
        if short != text and all(map(self._cost, boxes)):
            return self.beside(arrow, short, role, short=short)
        self._put(boxes, "halfedge", arrow.index, text, role)

    def near(self, center: complex, outward: complex, text: str, v: int) -> None:
        """A word close to a vertex, best straight beyond the end of the highlighted halfedge; left out without room."""
        half_width, half_height = self._half_sizes(text, self.size.small)
        box = Box(0j, half_width, half_height)
        spots = []
        for ring in range(6):
            for step in range(24):
                degrees = 15 * ((step + 1) // 2) * (-1) ** step
                direction = (outward or 1) * cmath.rect(1.0, math.radians(degrees))
                far = self.size.offset + (1.5 + 1.5 * ring) * self.size.gap + box.reach(direction)
                spots.append((ring + abs(degrees) / 20, center + far * direction))
        spots.sort(key=lambda spot: spot[0])
        boxes = [Box(c, half_width, half_height) for _, c in spots]
        free = next((box for box in boxes if self._cost(box) == 0), None)
        self._put([free] if free else [], "word", v, text, "h")

    def within(self, polygon: list[complex], f: int, text: str, role: str, *, short: str) -> None:
        """A face's label inside it, near the centroid; ``short`` where there is no room for the whole."""
        half_width, half_height = self._half_sizes(text, self.size.large, pill=bool(role))
        center = sum(polygon) / len(polygon)
        spots = [center, *sorted(_grid(polygon, 14), key=lambda z: (round(abs(z - center), 6), z.real, z.imag))]
        spots = [z for z in spots if inside(z, polygon)] or [center]
        boxes = [Box(z, half_width, half_height) for z in spots]
        roomy = next((box for box in boxes if self._cost(box, 3.0 * self.size.gap) == 0), None)
        if short != text and all(map(self._cost, boxes)):
            return self.within(polygon, f, short, role, short=short)
        self._put([roomy] if roomy else boxes, "face", f, text, role)

    def along(self, outer: list[Arrow], kind: str, index: int, text: str, role: str) -> bool:
        """A label next to one of the arrows of a loop, a long and level one if possible; False if there is no room."""
        half_width, half_height = self._half_sizes(text, self._font(kind), pill=bool(role) and kind != "word")
        box = Box(0j, half_width, half_height)
        level = sorted(outer, key=lambda a: (-round(abs((a.tip - a.tail).real), 6), a.index))
        for arrow in level:
            normal = left(arrow.direction)
            away = (box.reach(normal) + 1.2 * self.size.gap) * normal
            for t in (0.75, 0.25, 0.65, 0.35, 0.5):
                spot = Box(arrow.at(t) + away, half_width, half_height)
                if arrow.direction and self._cost(spot) == 0:
                    self.labels.append(Label(kind, index, text, role, spot, self._font(kind)))
                    return True
        return False

    def _font(self, kind: str) -> float:
        return self.size.large if kind == "face" else self.size.small

    def _half_sizes(self, text: str, font: float, *, pill: bool = False) -> tuple[float, float]:
        pad = 0.55 * font if pill else 0.0
        return text_width(text, font) / 2 + pad, (0.78 if pill else 0.56) * font

    def _put(self, boxes: Iterable[Box], kind: str, index: int, text: str, role: str) -> None:
        best: tuple[int, Box] | None = None
        for box in boxes:
            cost = self._cost(box)
            if best is None or cost < best[0]:
                best = cost, box
            if cost == 0:
                break
        if best is not None:
            self.labels.append(Label(kind, index, text, role, best[1], self._font(kind), free=best[0] == 0))

    def _cost(self, box: Box, gap: float | None = None) -> int:
        gap = 0.6 * self.size.gap if gap is None else gap
        covered = sum(box.overlaps(label.box, gap) for label in self.labels)
        outside = not box.half_width + 12 <= box.center.real <= self.width - 12 - box.half_width
        return 10 * covered + 10 * outside + box.hits(self.lines, gap)


def _grid(points: list[complex], n: int) -> Iterator[complex]:
    """An n by n grid over the bounding box of ``points``."""
    x0, x1 = min(z.real for z in points), max(z.real for z in points)
    y0, y1 = min(z.imag for z in points), max(z.imag for z in points)
    for i in range(n):
        for j in range(n):
            yield complex(x0 + (x1 - x0) * (i + 0.5) / n, y0 + (y1 - y0) * (j + 0.5) / n)
