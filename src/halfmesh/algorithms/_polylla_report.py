"""What Polylla tells about a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PHASES", "PolyllaReport"]

PHASES = ("label", "seeds", "travel", "repair", "write", "attributes")


@dataclass(frozen=True, eq=False)
class PolyllaReport:
    """What :func:`halfmesh.polylla` did: counts, times, and where every triangle went.

    Attributes
    ----------
    n_triangles : int
        Faces of the triangulation.
    n_polygons : int
        Faces of the result: one for each terminal edge, and `n_added`.
    n_frontier_edges : int
        Edges of the result that bound a polygon, each counted once, after the repair; wire is not among them.
    n_tips : int
        Ends of barrier edges in the terminal-edge regions before the repair: a frontier edge with the same region on
        both sides ends there, ``twin(next(h)) == h``. All of them are counted, whereas the authors' program leaves out
        a tip at the target of the halfedge where its walk begins (their ``n_barrier_edge_tips``).
    n_repaired : int
        Regions that were cut because they passed a vertex twice: by a tip, by an island, by touching themselves. (Their
        ``n_polygons_to_repair`` are those with a tip alone.)
    n_added : int
        Polygons that the cuts made in addition: ``n_polygons_added_after_repair``.
    triangle_polygon : ndarray of int32, shape (n face slots,)
        The polygon of every triangle; -1 for deleted faces.
    seconds : dict of str to float
        Time of each phase: ``label`` (longest edges; with them, frontier edges), ``seeds`` (terminal edges), ``travel``
        (around all regions), ``repair``, ``write`` (numbers and columns of the result), ``attributes`` (points and
        other data that are carried over).
    """

    n_triangles: int
    n_polygons: int
    n_frontier_edges: int
    n_tips: int
    n_repaired: int
    n_added: int
    triangle_polygon: NDArray[np.int32]
    seconds: dict[str, float]

    @property
    def total_seconds(self) -> float:
        """The whole time, in seconds."""
        return sum(self.seconds.values())

    def as_dict(self) -> dict[str, Any]:
        """The counts and times as numbers, for JSON; without `triangle_polygon`."""
        counts = {name: getattr(self, name) for name, _ in _ROWS}
        return counts | {"seconds": dict(self.seconds), "total_seconds": self.total_seconds}

    def __str__(self) -> str:
        counts = [(label, f"{getattr(self, name):,}") for name, label in _ROWS]
        times = [(name, f"{1e3 * s:,.2f} ms") for name, s in [*self.seconds.items(), ("total", self.total_seconds)]]
        left = max(len(label) for label, _ in counts + times)
        right = max(len(value) for _, value in counts + times)
        return "\n".join(f"{label:<{left}}  {value:>{right}}" for label, value in counts + times)

    def __repr__(self) -> str:
        return (
            f"<PolyllaReport: {self.n_triangles} triangles, {self.n_polygons} polygons, {self.n_repaired} repaired, "
            f"{1e3 * self.total_seconds:.3g} ms>"
        )


_ROWS = (
    ("n_triangles", "triangles"),
    ("n_polygons", "polygons"),
    ("n_frontier_edges", "frontier edges"),
    ("n_tips", "barrier-edge tips"),
    ("n_repaired", "regions repaired"),
    ("n_added", "polygons added"),
)
