"""Operators from plain Python: a call for each element, through handles."""

from __future__ import annotations

from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import load
from benchmarks.task import Case, Task
from benchmarks.timing import Plan, race

KINDS = ("flip", "split_edge", "split_face", "collapse")


def cases(plan: Plan) -> list[Case]:
    """On a sphere that compas can hold with all its faces split."""
    return [Case(kind, f"sphere-{plan.small - 1}") for kind in KINDS]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    surface = load(case.mesh)
    n = surface.n_faces * 3 // 2 if case.name in ("flip", "split_edge") else surface.n_faces
    return [timing.as_dict() for timing in race(peer.edits(surface, case.name), plan, n)]


EDITS = Task("edits", "Operators in plain Python, through handles", "element", cases, measure)
