"""Reading: OFF and OBJ, the medium sphere with all its digits, and real files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CORPUS, load, text_file
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, race

REAL = ("off/dge__9handles.off", "obj/oded__nefertiti-lowres.obj")


def cases(plan: Plan) -> list[Case]:
    made = [Case(f"{suffix[1:].upper()} {size(plan.medium)}", f"sphere-{plan.medium}{suffix}") for suffix in FORMATS]
    return made + [Case(path.split("__")[1], path) for path in REAL if (CORPUS / path).exists()]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    path = file_of(case)
    return [timing.as_dict() for timing in race(peer.readers(path), plan, path.stat().st_size)]


def file_of(case: Case) -> Path:
    """The case's file, in the corpus or written now."""
    if "/" in case.mesh:
        return CORPUS / case.mesh
    name, _, suffix = case.mesh.rpartition(".")
    load(name)
    return text_file(name, f".{suffix}")


FORMATS = (".off", ".obj")
READING = Task("reading", "Reading a file", "byte", cases, measure)
