"""The little plane geometry that the pictures need.

Points and directions are complex numbers in *screen* coordinates: x to the right, y **down**. What is left of a
direction on the screen is therefore ``-1j`` times it.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Box", "Cubic", "arc", "inside", "left", "sampled", "turn", "unit"]

Cubic = tuple[complex, complex, complex]
"""One Bezier piece: two control points and the end; it starts where the piece before it ends."""


@dataclass(frozen=True)
class Box:
    """An upright rectangle given by its centre and its half sizes."""

    center: complex
    half_width: float
    half_height: float

    def overlaps(self, other: Box, gap: float = 0.0) -> bool:
        """Whether the two rectangles come nearer than ``gap`` in both directions."""
        d = self.center - other.center
        return (
            abs(d.real) < self.half_width + other.half_width + gap
            and abs(d.imag) < self.half_height + other.half_height + gap
        )

    def reach(self, direction: complex) -> float:
        """How far the rectangle extends from its centre along a unit ``direction``."""
        return self.half_width * abs(direction.real) + self.half_height * abs(direction.imag)

    def hits(self, segments: NDArray[np.float64], gap: float = 0.0) -> int:
        """How many of the ``segments``, rows x0 y0 x1 y1, enter the rectangle widened by ``gap``."""
        enter = np.zeros(len(segments))
        leave = np.ones(len(segments))
        sides = ((0, self.center.real, self.half_width), (1, self.center.imag, self.half_height))
        for axis, middle, half in sides:
            start = segments[:, axis] - middle
            step = segments[:, axis + 2] - segments[:, axis]
            step = np.where(np.abs(step) < 1e-12, 1e-12, step)  # parallel: the slab is met at once or never
            one, two = (-half - gap - start) / step, (half + gap - start) / step
            enter = np.maximum(enter, np.minimum(one, two))
            leave = np.minimum(leave, np.maximum(one, two))
        return int(np.count_nonzero(enter < leave))


def unit(z: complex) -> complex:
    """``z`` scaled to length one; zero stays zero."""
    size = abs(z)
    return z / size if size > 0.0 else 0j


def left(direction: complex) -> complex:
    """The direction a quarter turn to the left, as seen on the screen."""
    return -1j * direction


def turn(start: complex, end: complex) -> float:
    """The counter-clockwise angle from ``start`` to ``end`` in (0, 2 pi], as seen on the screen."""
    if start == 0 or end == 0:
        return math.tau
    angle = cmath.phase(start / end) % math.tau
    return angle if angle > 1e-9 else math.tau


def arc(center: complex, start: complex, angle: float) -> list[Cubic]:
    """Bezier pieces that go clockwise about ``center`` by ``angle``, beginning at ``start``."""
    n = max(1, math.ceil(angle / (math.pi / 2) - 1e-9))
    step = angle / n
    reach = 4.0 / 3.0 * math.tan(step / 4.0)
    pieces: list[Cubic] = []
    arm = start - center
    for _ in range(n):
        following = arm * cmath.exp(1j * step)
        pieces.append((center + arm * (1 + 1j * reach), center + following * (1 - 1j * reach), center + following))
        arm = following
    return pieces


def sampled(start: complex, pieces: list[Cubic], per_piece: int = 8) -> list[complex]:
    """Points along a chain of Bezier pieces, both ends included."""
    points = [start]
    for c1, c2, end in pieces:
        origin = points[-1]
        for i in range(1, per_piece + 1):
            t = i / per_piece
            s = 1.0 - t
            points.append(s**3 * origin + 3 * s * s * t * c1 + 3 * s * t * t * c2 + t**3 * end)
    return points


def inside(point: complex, polygon: list[complex]) -> bool:
    """Whether ``point`` lies in ``polygon`` (even-odd rule)."""
    odd = False
    for p, q in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if (p.imag > point.imag) != (q.imag > point.imag):
            crossing = p.real + (point.imag - p.imag) / (q.imag - p.imag) * (q.real - p.real)
            odd ^= crossing > point.real
    return odd
