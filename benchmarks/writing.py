"""Writing: OFF and OBJ, the medium sphere; and what the file keeps of its coordinates."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CACHE, kept, load, read_points
from benchmarks.reading import FORMATS
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, race


def cases(plan: Plan) -> list[Case]:
    return [Case(f"{suffix[1:].upper()} {size(plan.medium)}", f"sphere-{plan.medium}{suffix}") for suffix in FORMATS]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    name, _, suffix = case.mesh.rpartition(".")
    surface = load(name)
    with TemporaryDirectory(dir=CACHE) as folder:
        path = Path(folder) / f"written.{suffix}"
        timings = race(peer.writers(surface, path), plan, surface.n_faces)
        note = kept(surface.points, read_points(path))
    return [timing.as_dict() | {"note": note} for timing in timings]


WRITING = Task("writing", "Writing a file", "triangle", cases, measure)
