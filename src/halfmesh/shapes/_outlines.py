"""Closed curves in the plane, and the domains that they bound."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Domain", "circle_curve", "gear_curve", "lake_domain", "resampled", "wheel_domain"]

Floats = NDArray[np.float64]
_DENSE = 2048  # points of a curve before it is cut into equal steps


class Domain(NamedTuple):
    """What an outer curve encloses and the inner ones don't.

    Attributes
    ----------
    curves : list of list of ndarray, shape (k, 2)
        Each curve in smooth pieces, end to end; the outer one first. Where pieces meet is a corner that is kept.
    holes : ndarray of float64, shape (n_curves - 1, 2)
        A place inside each inner curve.
    """

    curves: list[list[Floats]]
    holes: Floats


def resampled(pieces: list[Floats], step: float) -> Floats:
    """A closed curve as points about `step` apart, without the first again at the end."""
    made = []
    for piece in pieces:
        along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(piece, axis=0).T))])
        count = max(1, round(along[-1] / step))
        at = np.linspace(0.0, along[-1], count + 1)[:-1]
        made.append(np.column_stack([np.interp(at, along, piece[:, i]) for i in (0, 1)]))
    return np.concatenate(made)


def circle_curve(x: float, y: float, radius: float) -> list[Floats]:
    """One smooth piece."""
    angle = np.linspace(0.0, 2.0 * math.pi, _DENSE + 1)
    return [np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])]


def lake_domain(islands: int, random: np.random.Generator) -> Domain:
    """A shore with bays, about 3.4 long, and islands that keep away from it and from each other."""
    shore = _blob(random, 0.0, 0.0, 1.0, waves=8, rough=0.5) * [1.55, 1.0]
    shore[:, 1] += 0.16 * np.sin(1.9 * shore[:, 0] + random.uniform(0.0, 2.0 * math.pi))
    shore[:, 0] += 0.12 * np.sin(2.6 * shore[:, 1] + random.uniform(0.0, 2.0 * math.pi))
    curves, places = [[shore]], np.empty((0, 3))
    tries = 0
    while len(curves) <= islands and tries < 4000:
        radius = random.uniform(0.07, 0.21) * 0.999**tries
        x, y = random.uniform(shore.min(axis=0), shore.max(axis=0))
        tries += 1
        room = np.hypot(*(shore - [x, y]).T).min() - 1.9 * radius
        apart = np.hypot(*(places[:, :2] - [x, y]).T) - 1.9 * (places[:, 2] + radius)
        if room > 0.0 and (apart > 0.0).all() and _surrounds(shore, x, y):
            places = np.vstack([places, [x, y, radius]])
            coast = _turned(_blob(random, 0.0, 0.0, radius, waves=4, rough=0.3), random)
            curves.append([coast + np.array([x, y])])
    return Domain(curves, places[:, :2])


def _blob(random: np.random.Generator, x: float, y: float, radius: float, waves: int, rough: float) -> Floats:
    """A closed curve around (x, y) whose distance varies by waves, the shorter the flatter; never by more than half."""
    angle = np.linspace(0.0, 2.0 * math.pi, _DENSE + 1)
    k = np.arange(2, waves + 1)[:, None]
    heights = rough * random.normal(size=k.shape) / k**1.1
    swing = (heights * np.cos(k * angle + random.uniform(0.0, 2.0 * math.pi, size=k.shape))).sum(axis=0)
    distance = radius * (1.0 + 0.5 * np.tanh(2.0 * swing))
    distance[-1] = distance[0]
    return np.column_stack([x + distance * np.cos(angle), y + distance * np.sin(angle)])


def _turned(curve: Floats, random: np.random.Generator) -> Floats:
    """Stretched, and turned anyhow."""
    angle = random.uniform(0.0, math.pi)
    c, s = math.cos(angle), math.sin(angle)
    made: Floats = curve * [1.25, 0.8] @ np.array([[c, s], [-s, c]])
    return made


def _surrounds(curve: Floats, x: float, y: float) -> bool:
    """Whether a closed curve winds around a place."""
    turned = np.unwrap(np.arctan2(curve[:, 1] - y, curve[:, 0] - x))
    return bool(abs(turned[-1] - turned[0]) > math.pi)


def wheel_domain(teeth: int, spokes: int) -> Domain:
    """A gear of outer radius 1: teeth, a bore with a keyway, and round holes between the spokes."""
    curves = [gear_curve(teeth), _bore(0.2, 0.055, 0.06)]
    places = [(0.0, 0.0)]
    for i in range(spokes):
        angle = 2.0 * math.pi * (i + 0.5) / spokes + 0.5 * math.pi
        x, y = 0.5 * math.cos(angle), 0.5 * math.sin(angle)
        curves.append(circle_curve(x, y, min(0.15, 0.36 * math.sin(math.pi / spokes))))
        places.append((x, y))
    return Domain(curves, np.array(places))


def gear_curve(teeth: int) -> list[Floats]:
    """Teeth with straight flanks that lean inward, between a root and a tip circle."""
    root, tip, pitch = 1.0 - min(0.22, 3.2 / teeth), 1.0, 2.0 * math.pi / teeth
    pieces = []
    for i in range(teeth):
        a = pitch * i
        corners = [a - 0.5 * pitch, a - 0.27 * pitch, a - 0.13 * pitch, a + 0.13 * pitch, a + 0.27 * pitch]
        low, up, top, down, end = (*zip(corners, (root, root, tip, tip, root), strict=True),)
        pieces += [_arc(low, up), _arc(up, top), _arc(top, down), _arc(down, end), _arc(end, (a + 0.5 * pitch, root))]
    return pieces


def _bore(radius: float, half_width: float, depth: float) -> list[Floats]:
    """A circle with a rectangular slot at the top."""
    half = math.asin(half_width / radius)
    around = _arc((0.5 * math.pi + half, radius), (2.5 * math.pi - half, radius))
    top = radius + depth
    slot = np.array([around[-1], [half_width, top], [-half_width, top], around[0]])
    return [around, *(slot[i : i + 2] for i in range(3))]


def _arc(begin: tuple[float, float], end: tuple[float, float]) -> Floats:
    """From one angle and radius to another, evenly in both."""
    angle, radius = (np.linspace(a, b, 256) for a, b in zip(begin, end, strict=True))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])
