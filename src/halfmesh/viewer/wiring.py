"""What a picture needs to know of a mesh, read once into plain Python lists and checked."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from halfmesh.errors import ElementError, PreconditionError

__all__ = ["MAX_FACES", "MAX_HALFEDGES", "Drawable", "Wiring", "chosen_halfedge", "read_wiring"]

MAX_FACES = 60
"""More faces than this can't be labelled readably."""

MAX_HALFEDGES = 400
"""The same for halfedges: a mesh of few faces may still have many sides."""


class Columns(Protocol):
    """The columns of a topology that are read here: integers, one per halfedge, vertex or face."""

    @property
    def next(self) -> NDArray[np.integer]: ...
    @property
    def prev(self) -> NDArray[np.integer]: ...
    @property
    def origin(self) -> NDArray[np.integer]: ...
    @property
    def face(self) -> NDArray[np.integer]: ...
    @property
    def vertex_halfedge(self) -> NDArray[np.integer]: ...
    @property
    def face_halfedge(self) -> NDArray[np.integer]: ...


class Drawable(Protocol):
    """Anything with ``points`` and ``topology``, such as a :class:`halfmesh.Mesh`."""

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions, shape (n_vertices, 2 or more)."""

    @property
    def topology(self) -> Any:
        """The columns of the topology."""


@dataclass(frozen=True)
class Wiring:
    """The links of a small mesh; -1 stands for "none", the lists of living indices leave deleted elements out."""

    next: list[int]
    prev: list[int]
    origin: list[int]
    face: list[int]
    points: list[complex]  # x + iy, y upwards; moved and scaled into the unit square
    vertices: list[int]
    halfedges: list[int]
    faces: dict[int, list[int]]  # the halfedges of each living face, in order

    def target(self, h: int) -> int:
        """The vertex in which halfedge ``h`` ends."""
        return self.origin[h ^ 1]

    def is_exterior(self, h: int) -> bool:
        """Whether no face lies on the left of ``h``."""
        return self.face[h] == -1

    def roominess(self, f: int) -> float:
        """Twice the area over the perimeter of face ``f``, as large as its incircle; negative if seen from below."""
        corners = [self.points[self.origin[h]] for h in self.faces[f]]
        sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
        perimeter = sum(abs(q - p) for p, q in sides)
        return sum((p.conjugate() * q).imag for p, q in sides) / perimeter if perimeter > 0 else 0.0


def read_wiring(mesh: Drawable) -> Wiring:
    """Read ``mesh`` into lists.

    Raises
    ------
    PreconditionError
        The mesh has more than `MAX_FACES` faces or `MAX_HALFEDGES` halfedges, or a point is not finite.
    """
    t: Columns = mesh.topology
    # A slot whose element was deleted holds less than -1; -1 alone is "isolated" for a vertex.
    _check_size(int(np.count_nonzero(t.face_halfedge >= 0)), MAX_FACES, "faces")
    _check_size(int(np.count_nonzero(t.next >= 0)), MAX_HALFEDGES, "halfedges")
    _check_size(int(np.count_nonzero(t.vertex_halfedge >= -1)), MAX_HALFEDGES, "vertices")
    following = [int(h) for h in t.next]
    origin = [int(v) for v in t.origin]
    halfedges = [h for h, n in enumerate(following) if n >= 0]
    starts = [int(h) for h in t.face_halfedge]
    return Wiring(
        next=following,
        prev=[int(h) for h in t.prev],
        origin=origin,
        face=[int(f) for f in t.face],
        points=_unit_points(mesh.points, t.vertex_halfedge >= -1),
        vertices=[v for v, h in enumerate(t.vertex_halfedge) if h >= -1],
        halfedges=halfedges,
        faces={f: _loop(following, h) for f, h in enumerate(starts) if h >= 0},
    )


def chosen_halfedge(wiring: Wiring, highlight: int | None) -> int | None:
    """The halfedge to explain: ``highlight``, or else the first that is best surrounded by faces."""
    if highlight is not None:
        if highlight not in wiring.halfedges:
            raise ElementError(f"there is no halfedge {highlight} to highlight")
        return int(highlight)

    def interior(halfedges: Iterable[int]) -> int:
        return sum(not wiring.is_exterior(h) for h in halfedges)

    room = {f: wiring.roominess(f) for f in wiring.faces}
    widest = max(room.values(), default=0.0) or 1.0

    def rank(h: int) -> tuple[int, float, int, float, int]:
        around = interior((h ^ 1, wiring.prev[h] ^ 1, wiring.next[h] ^ 1))
        wide = round(room.get(wiring.face[h], -widest) / abs(widest), 1)
        return -interior((h,)), wide <= 0, -around, -wide, h

    return min(wiring.halfedges, key=rank, default=None)


def _unit_points(points: NDArray[np.float64], alive: NDArray[np.bool_]) -> list[complex]:
    """The points seen from above, their bounding box fitted into the unit square; deleted vertices are at zero."""
    xy = np.array(points, dtype=np.float64)[:, :2]
    xy[~alive] = 0.0
    lost = np.flatnonzero(~np.isfinite(xy).all(axis=1))
    if len(lost):
        raise PreconditionError(f"vertex {lost[0]} has no finite position, so the mesh can't be drawn")
    for _ in range(2):  # twice: the first time keeps differences of huge numbers finite
        xy /= np.abs(xy).max(initial=0.0) or 1.0
        if alive.any():
            xy -= xy[alive].min(axis=0)
    return [complex(x, y) for x, y in xy.tolist()]


def _loop(following: list[int], start: int) -> list[int]:
    """The halfedges from ``start`` along next; bounded, so that broken links end too."""
    loop = [start]
    while following[loop[-1]] != start and len(loop) < len(following):
        loop.append(following[loop[-1]])
    return loop


def _check_size(count: int, limit: int, kind: str) -> None:
    if count > limit:
        raise PreconditionError(
            f"the mesh has {count:,} {kind}; the structure diagram labels every element and stays readable "
            f"up to {limit} {kind}: draw a small part of the mesh"
        )
