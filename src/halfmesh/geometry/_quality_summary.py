"""The shapes of all polygons in a few lines."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["QualitySummary", "Spread", "summarized"]


@dataclass(frozen=True)
class Spread:
    """The least, the mean and the greatest of a measure; 0 where there are no polygons."""

    least: float
    mean: float
    greatest: float


@dataclass(frozen=True)
class QualitySummary:
    """The quality of the polygons of a mesh at a glance; ``print`` it for a table.

    Attributes
    ----------
    n_polygons, n_convex, n_star_shaped : int
        All polygons, those that are convex, and those whose kernel has an area.
    measures : dict of str to Spread
        The least, mean and greatest of ``n_sides``, ``min_angle``, ``max_angle`` (in radians), ``edge_ratio``,
        ``area_perimeter_ratio`` and ``kernel_ratio``.
    """

    n_polygons: int
    n_convex: int
    n_star_shaped: int
    measures: dict[str, Spread]

    @property
    def convex_share(self) -> float:
        """The part of the polygons that are convex, 0 to 1."""
        return self.n_convex / max(self.n_polygons, 1)

    @property
    def star_shaped_share(self) -> float:
        """The part of the polygons whose kernel has an area, 0 to 1."""
        return self.n_star_shaped / max(self.n_polygons, 1)

    def as_dict(self) -> dict[str, Any]:
        """The same as a dictionary of plain numbers, for JSON."""
        counts = {"n_polygons": self.n_polygons, "n_convex": self.n_convex, "n_star_shaped": self.n_star_shaped}
        return counts | {name: asdict(spread) for name, spread in self.measures.items()}

    def counts(self) -> list[tuple[str, str]]:
        """Label and number of the counts."""
        return [
            ("polygons", f"{self.n_polygons:,}"),
            ("  convex", f"{self.n_convex:,} ({self.convex_share:.1%})"),
            ("  star-shaped", f"{self.n_star_shaped:,} ({self.star_shaped_share:.1%})"),
        ]

    def rows(self) -> list[tuple[str, str, str, str]]:
        """Label, least, mean and greatest of each measure."""
        made = []
        for name, label, factor, digits in _ROWS:
            s = self.measures[name]
            least, mean, greatest = (factor * value for value in (s.least, s.mean, s.greatest))
            ends = 0 if name == "n_sides" else digits
            made.append((label, f"{least:,.{ends}f}", f"{mean:,.{digits}f}", f"{greatest:,.{ends}f}"))
        return made

    def __str__(self) -> str:
        rows = [_HEADER, *self.rows()]
        widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
        lines = [f"{label:<{widths[0]}}  {value}" for label, value in self.counts()]
        for label, *cells in rows:
            figures = (f"{cell:>{width}}" for cell, width in zip(cells, widths[1:], strict=True))
            lines.append("  ".join([f"{label:<{widths[0]}}", *figures]))
        return "\n".join(lines)


_HEADER = ("", "least", "mean", "greatest")
_ROWS = (
    ("n_sides", "sides", 1.0, 2),
    ("min_angle", "smallest angle, degrees", 180.0 / math.pi, 1),
    ("max_angle", "largest angle, degrees", 180.0 / math.pi, 1),
    ("edge_ratio", "edge ratio", 1.0, 3),
    ("area_perimeter_ratio", "area-perimeter ratio", 1.0, 3),
    ("kernel_ratio", "kernel ratio", 1.0, 3),
)


def summarized(columns: dict[str, NDArray[Any]]) -> QualitySummary:
    """Summarize the columns of a `PolygonQuality`."""
    alive = columns["n_sides"] > 0
    return QualitySummary(
        n_polygons=int(np.count_nonzero(alive)),
        n_convex=int(np.count_nonzero(columns["convex"])),
        n_star_shaped=int(np.count_nonzero(columns["kernel_ratio"])),
        measures={name: _spread(columns[name][alive]) for name, *_ in _ROWS},
    )


def _spread(values: NDArray[Any]) -> Spread:
    if not len(values):
        return Spread(0.0, 0.0, 0.0)
    return Spread(float(values.min()), float(values.mean()), float(values.max()))
