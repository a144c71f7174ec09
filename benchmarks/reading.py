"""Reading: OFF and OBJ, the medium sphere with all its digits, and real files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CORPUS, kept, load, text_file
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, race

REAL = ("off/dge__9handles.off", "obj/oded__nefertiti-lowres.obj")


def cases(plan: Plan) -> list[Case]:
    made = [Case(f"{suffix[1:].upper()} {size(plan.medium)}", f"sphere-{plan.medium}{suffix}") for suffix in FORMATS]
    return made + [Case(path.split("__")[1], path) for path in REAL if (CORPUS / path).exists()]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    path = file_of(case)
    ways = peer.readers(path)
    records = [timing.as_dict() for timing in race(ways, plan, path.stat().st_size)]
    if "/" not in case.mesh:
        made = load(case.mesh.rpartition(".")[0]).points
        for record, way in zip(records, ways.values(), strict=True):
            record["note"] = ", ".join(filter(None, [record["note"], kept(made, way.points(way.run()))]))
    return records


def file_of(case: Case) -> Path:
    """The case's file, in the corpus or written now."""
    if "/" in case.mesh:
        return CORPUS / case.mesh
    name, _, suffix = case.mesh.rpartition(".")
    load(name)
    return text_file(name, f".{suffix}")


FORMATS = (".off", ".obj")
READING = Task("reading", "Reading a file", "byte", cases, measure)
