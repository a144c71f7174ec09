"""Points spread over a domain, no two closer than a distance that varies from place to place (Poisson disks).

R. L. Cook, "Stochastic sampling in computer graphics", ACM Transactions on Graphics 5, 1986.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import kernel

__all__ = ["DistanceGrid", "scattered", "spacing"]

Floats = NDArray[np.float64]
_TRIES = 14  # for each point that there may be
_NODES = 160  # of the grid, along its longer side
_ROOM_AT_RIM = 0.72  # of the distance between points
_COARSEST = 4.0  # times the distance between points at the rim


@dataclass
class DistanceGrid:
    """Signed distances to closed curves, positive inside, at the nodes of a grid and between them.

    Attributes
    ----------
    low : ndarray of float64, shape (2,)
    cell : float
    values : ndarray of float64, shape (columns, rows)
    """

    low: Floats
    cell: float
    values: Floats

    @classmethod
    def of(cls, curves: list[Floats]) -> DistanceGrid:
        """O(nodes x corners)."""
        rim = np.concatenate(curves)
        low, high = rim.min(axis=0), rim.max(axis=0)
        cell = float((high - low).max()) / _NODES
        counts = np.ceil((high - low) / cell).astype(int) + 1
        x, y = (low[i] + cell * np.arange(counts[i]) for i in (0, 1))
        nearest, inside = np.full(tuple(counts), np.inf), np.zeros(tuple(counts), dtype=bool)
        for curve in curves:
            for a, b in zip(curve, np.roll(curve, -1, axis=0), strict=True):
                _approach(nearest, x[:, None] - a[0], y - a[1], b - a)
                if a[1] != b[1]:
                    crossing = a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])
                    inside ^= ((a[1] <= y) != (b[1] <= y)) & (x[:, None] < crossing)
        distances = np.sqrt(nearest)
        return cls(low, cell, np.where(inside, distances, -distances))

    def at(self, places: Floats) -> Floats:
        """Bilinear between the nodes."""
        place = (places - self.low) / self.cell
        i, j = (np.clip(place[:, k].astype(int), 0, self.values.shape[k] - 2) for k in (0, 1))
        s, t = place[:, 0] - i, place[:, 1] - j
        v = self.values
        below = (1 - s) * v[i, j] + s * v[i + 1, j]
        above = (1 - s) * v[i, j + 1] + s * v[i + 1, j + 1]
        made: Floats = (1 - t) * below + t * above
        return made

    def drawn(self, n: int, density: Floats, random: np.random.Generator) -> Floats:
        """Random places, as dense as the grid of numbers says."""
        weights = np.cumsum(density.reshape(-1))
        cells = np.searchsorted(weights, random.random(n) * weights[-1], side="right")
        corners = np.column_stack(np.unravel_index(np.minimum(cells, density.size - 1), density.shape))
        made: Floats = self.low + self.cell * (corners - 0.5 + random.random((n, 2)))
        return made


def _approach(nearest: Floats, x: Floats, y: Floats, side: Floats) -> None:
    """Lower the squared distances to those from a side that begins at the origin."""
    size = float(side @ side)
    along = np.clip((x * side[0] + y * side[1]) / (size or 1.0), 0.0, 1.0)
    np.minimum(nearest, (x - along * side[0]) ** 2 + (y - along * side[1]) ** 2, out=nearest)


def spacing(distance: Floats, step: float, growth: float) -> Floats:
    """How far points shall be apart at places of this distance from the rim."""
    made: Floats = np.minimum(step + growth * np.maximum(distance, 0.0), _COARSEST * step)
    return made


def scattered(grid: DistanceGrid, rim: Floats, step: float, growth: float, random: np.random.Generator) -> Floats:
    """Points inside: `step` apart at the rim, and further apart by `growth` times the distance from it."""
    density = np.where(grid.values > -grid.cell, 1.0 / spacing(grid.values, step, growth) ** 2, 0.0)
    tried = grid.drawn(int(_TRIES * density.sum() * grid.cell**2), density, random)
    distance = grid.at(tried)
    kept = distance > _ROOM_AT_RIM * step
    places = np.concatenate([rim, tried[kept]])
    radii = np.concatenate([np.full(len(rim), step), spacing(distance[kept], step, growth)])
    cell = step / math.sqrt(2.0)
    places = np.ascontiguousarray(places - (grid.low - grid.cell))
    columns, rows = (int(x) for x in np.ceil(places.max(axis=0) / cell) + 1)
    slots = np.full(columns * rows, -1, dtype=np.int32)
    chosen = np.zeros(len(places), dtype=np.uint8)
    run: Any = throw_darts.at(60 * len(places))
    run(places, radii, len(rim), cell, rows, slots, np.full(len(places), -1, dtype=np.int32), chosen)
    made: Floats = tried[kept][chosen[len(rim) :] == 1]
    return made


@kernel
def throw_darts(
    places: Any, radii: Any, n_rim: int, cell: float, rows: int, slots: Any, after: Any, chosen: Any
) -> None:
    """Choose the first `n_rim` places, and of the others, one after the other, those that have room around them.

    The chosen places of a cell hang together by `after`, from ``slots[column * rows + row]`` on.
    """
    columns = len(slots) // rows
    for i in range(len(places)):
        x, y = places[i, 0], places[i, 1]
        column, row = int(x / cell), int(y / cell)
        has_room = True
        if i >= n_rim:
            reach = math.ceil(radii[i] / cell)
            for c in range(max(0, column - reach), min(columns, column + reach + 1)):
                if not has_room:
                    break
                for r in range(max(0, row - reach), min(rows, row + reach + 1)):
                    j = slots[c * rows + r]
                    while j >= 0 and has_room:
                        dx, dy = places[j, 0] - x, places[j, 1] - y
                        least = _ROOM_AT_RIM * radii[i] if j < n_rim else radii[i]
                        has_room = dx * dx + dy * dy >= least * least
                        j = after[j]
        if has_room:
            chosen[i] = 1
            after[i] = slots[column * rows + row]
            slots[column * rows + row] = i
