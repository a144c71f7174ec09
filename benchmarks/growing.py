"""Growing: single vertices and faces from plain Python, at several sizes; and whole arrays of them."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import load
from benchmarks.task import Case, Task, racing, size
from benchmarks.timing import Plan, race

KINDS = ("add_vertex", "add_face")


def cases(plan: Plan) -> list[Case]:
    return [Case(growth(kind, n), f"grid-{n}") for kind in KINDS for n in plan.growing]


def growth(kind: str, n: int) -> str:
    return f"{kind}, {n:,}"


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    """As many vertices as faces, so that the columns of the table have one size."""
    surface, kind = load(case.mesh), case.name.split(",")[0]
    return [timing.as_dict() for timing in race(peer.growth(surface, kind), plan, surface.n_faces)]


def bulk_cases(plan: Plan) -> list[Case]:
    name = f"sphere-{plan.large}"
    return [Case(f"{size(plan.large)} coherent", name), Case(f"{size(plan.large)} shuffled", f"{name}-shuffled")]


GROWING = Task("growing", "Growing by single elements in plain Python", "call", cases, measure)
BULK = Task(
    "bulk",
    "Growing by an array of faces",
    "face",
    bulk_cases,
    racing(lambda peer, surface: peer.bulk(surface), items=lambda surface: surface.n_faces),
)
