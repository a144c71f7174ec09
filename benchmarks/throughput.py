"""Reading the files of triangulations: megabytes a second, to plain arrays; and building from arrays that are there."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CACHE, load
from benchmarks.task import Case, Task
from benchmarks.timing import Plan, race

Record = dict[str, Any]

FILES = {"OFF": "off", ".node and .ele": "ele"}
BUILD = "arrays to columns"


def cases(plan: Plan) -> list[Case]:
    mesh = f"delaunay-{max(plan.points)}-coherent"
    return [Case(name, mesh, "halfmesh") for name in (*FILES, BUILD)]


def measure(peer: Peer, case: Case, plan: Plan) -> list[Record]:
    surface = load(case.mesh)
    if case.name == BUILD:
        return [timing.as_dict() for timing in race(peer.builds(surface), plan, surface.n_faces)]
    import halfmesh as hm

    path = CACHE / f"{case.mesh}.{FILES[case.name]}"
    hm.save(hm.Mesh(surface.faces, surface.points), path)
    parts = [path, path.with_suffix(".node")] if path.suffix == ".ele" else [path]
    n_bytes = sum(part.stat().st_size for part in parts)
    return [timing.as_dict() for timing in race(peer.readers(path), plan, n_bytes)]


THROUGHPUT = Task(
    "throughput", "Files of triangulations, and building", "byte or triangle", cases, measure, patience=300.0
)
