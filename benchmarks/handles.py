"""Handles: steps from element to element in plain Python."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import load
from benchmarks.task import Case, Task
from benchmarks.timing import Plan, race


def cases(plan: Plan) -> list[Case]:
    return [Case("one step", f"sphere-{plan.small}")]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    return [timing.as_dict() for timing in race(peer.steps(load(case.mesh), plan.steps), plan, plan.steps)]


HANDLES = Task("handles", "A step through handles in plain Python", "step", cases, measure)
