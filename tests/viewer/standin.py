"""The least that a picture reads of a mesh, wired up from a face list in the slow and obvious way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass
class StandInTopology:
    next: NDArray[np.int32]
    prev: NDArray[np.int32]
    origin: NDArray[np.int32]
    face: NDArray[np.int32]
    vertex_halfedge: NDArray[np.int32]
    face_halfedge: NDArray[np.int32]


@dataclass
class StandIn:
    topology: StandInTopology
    points: NDArray[np.float64]


def stand_in(faces: Sequence[Sequence[int]], points: Sequence[Sequence[float]]) -> StandIn:
    """A manifold mesh with at most one fan at each vertex."""
    halfedge: dict[tuple[int, int], int] = {}
    for corners in faces:
        for a, b in zip(corners, [*corners[1:], corners[0]], strict=True):
            if (a, b) not in halfedge:
                halfedge[a, b] = len(halfedge)
                halfedge[b, a] = len(halfedge)
    n = len(halfedge)
    nxt, face, origin = np.full(n, -1), np.full(n, -1), np.empty(n, int)
    for (a, _), h in halfedge.items():
        origin[h] = a
    for f, corners in enumerate(faces):
        loop = [halfedge[a, b] for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
        nxt[loop] = loop[1:] + loop[:1]
        face[loop] = f
    exterior = [h for h in range(n) if face[h] == -1]
    for h in exterior:
        nxt[h] = next(g for g in exterior if origin[g] == origin[h ^ 1])
    prev = np.empty(n, int)
    prev[nxt] = np.arange(n)
    at = np.full(len(points), -1)
    for h in [*range(n), *exterior]:
        at[origin[h]] = h
    first = [halfedge[corners[0], corners[1]] for corners in faces]
    columns = (np.asarray(c, dtype=np.int32) for c in (nxt, prev, origin, face, at, first))
    flat = np.asarray(points, dtype=np.float64).reshape(len(points), -1 if len(points) else 2)
    xyz = np.zeros((len(points), 3))
    xyz[:, : flat.shape[1]] = flat
    return StandIn(StandInTopology(*columns), xyz)
