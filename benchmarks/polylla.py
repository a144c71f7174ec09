"""Polylla: from the built triangle mesh to the mesh of polygons, random Delaunay triangles; with their quality.

The program of the algorithm's authors is C++ and can't be installed by pip: its figure is quoted, not measured.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.compare.peer import Array, Peer, Surface
from benchmarks.data import load
from benchmarks.memory import peak_of
from benchmarks.task import Case, Task
from benchmarks.timing import Plan, race

Record = dict[str, Any]

COPIES = 10  # of the largest mesh, beside each other, to see how the time grows
ORDERS = ("coherent", "Qhull's order")
LARGE = 1_000_000  # points: 2 million triangles

# ns per triangle, compiled with -O3 on a machine with 2 cores of 2.5 GHz: random Delaunay, 2 million triangles in
# Qhull's order; not all of its polygons are simple
QUOTED_TIME = 430


def cases(plan: Plan) -> list[Case]:
    made = [
        Case(case_of(n, order), f"delaunay-{n}" + ("-coherent" if order == "coherent" else ""), "halfmesh")
        for n in plan.points
        for order in ORDERS
    ]
    largest = max(plan.points)
    return [*made, Case(case_of(COPIES * largest, "coherent"), f"delaunay-{largest}-coherent", "halfmesh")]


def case_of(n_points: int, order: str) -> str:
    """Points and order: so a case is named."""
    return f"{n_points:,} points, {order}"


def measure(peer: Peer, case: Case, plan: Plan) -> list[Record]:
    surface = load(case.mesh)
    if case.name not in [case_of(n, order) for n in plan.points for order in ORDERS]:
        surface = beside_each_other(surface, COPIES)
    ways = peer.polylla(surface)
    records: list[Record] = [timing.as_dict() for timing in race(ways, plan, surface.n_faces)]
    (way,) = ways.values()
    records[0]["peak"] = peak_of(way)[1]
    return records


def beside_each_other(surface: Surface, n: int) -> Surface:
    """Copies of a mesh, as components of one."""
    assert not isinstance(surface.faces, tuple)
    shift = np.arange(n, dtype=np.int32)[:, None, None]
    faces = (surface.faces + shift * np.int32(len(surface.points))).reshape(-1, 3)
    return Surface(faces, (surface.points + 2.0 * shift * np.eye(1, 3)).reshape(-1, 3))


def n_not_simple(indices: Array, offsets: Array) -> int:
    """How many polygons pass a vertex twice or have less than three sides, by sorting all their corners."""
    degrees = np.diff(offsets)
    owner = np.repeat(np.arange(len(degrees)), degrees)
    order = np.lexsort((indices, owner))
    same = (np.diff(owner[order]) == 0) & (np.diff(indices[order]) == 0)
    bad = degrees < 3
    bad[owner[order][1:][same]] = True
    return int(bad.sum())


POLYLLA = Task("polylla", "Polylla, from the built mesh", "triangle", cases, measure, patience=300.0)
