"""Queries between operators: after every change the counts are asked again, which must not depend on the size."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import load
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, race

SMALLEST = 3  # level of the sphere: 1,280 triangles


def cases(plan: Plan) -> list[Case]:
    return [Case(size(level), f"sphere-{level}", "halfmesh") for level in (SMALLEST, plan.small, plan.large)]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    return [timing.as_dict() for timing in race(peer.queries(load(case.mesh), plan.turns), plan, plan.turns)]


QUERIES = Task("queries", "Counts asked after every operator, in plain Python", "turn", cases, measure)
