"""The compact mesh: bits for each edge, time to make it, time of a question in a kernel, and Polylla on it."""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.compare.peer import Array, Peer
from benchmarks.data import Surface, load
from benchmarks.memory import peak_of
from benchmarks.polylla import COPIES, beside_each_other
from benchmarks.task import Case, Task
from benchmarks.timing import Plan, race

Record = dict[str, Any]

CALLS = 1_000_000
RULES = ("twin_of", "next_of", "prev_of", "origin_of", "face_of")
ENCODE, POLYLLA_ON_IT = "encode", "polylla"


def cases(plan: Plan) -> list[Case]:
    n = max(plan.points)
    return [
        Case(random_case(n), f"delaunay-{n}-coherent", "halfmesh"),
        Case(f"{n:,} points, grid", f"grid-{2 * n}", "halfmesh"),
        Case(random_case(COPIES * n), f"delaunay-{n}-coherent", "halfmesh"),
        Case(f"{COPIES * n:,} points, grid", f"grid-{2 * COPIES * n}", "halfmesh"),
    ]


def random_case(n_points: int) -> str:
    """So a case of random Delaunay triangles is named."""
    return f"{n_points:,} points, random"


def measure(peer: Peer, case: Case, plan: Plan) -> list[Record]:
    surface = load(case.mesh)
    if case.name == random_case(COPIES * max(plan.points)):
        surface = beside_each_other(surface, COPIES)
    return [*map(as_record, race(peer.compact(surface), plan, surface.n_faces)), memory(peer, surface)]


def as_record(timing: Any) -> Record:
    record: Record = timing.as_dict()
    return record


def memory(peer: Peer, surface: Surface) -> Record:
    """The peak while a compact mesh is made from a mesh, beside the bytes of that mesh; after all has run once."""
    made, peak = peak_of(peer.compact(surface)[ENCODE])
    facts = {"peak": peak, "connectivity": made.topology_nbytes, "points": made.points.nbytes}
    return {"way": "memory", "note": "", "items": surface.n_faces, "best": 0.0, "facts": facts}


def random_elements(n: int) -> Array:
    return np.random.default_rng(7).integers(0, n, CALLS)


COMPACT = Task("compact", "The compact mesh", "edge", cases, measure, patience=900.0, repeats=False)
