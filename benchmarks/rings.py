"""One-rings: the mean of the neighbors of every vertex, in a loop of the user's own, from the built mesh."""

from __future__ import annotations

from benchmarks.task import Case, Task, racing, size
from benchmarks.timing import Plan


def cases(plan: Plan) -> list[Case]:
    levels = sorted({plan.small, plan.medium})
    coherent = [Case(f"{size(level)} coherent", f"sphere-{level}") for level in levels]
    return [*coherent, Case(f"{size(plan.medium)} shuffled", f"sphere-{plan.medium}-shuffled")]


measure = racing(lambda peer, surface: peer.rings(surface), items=lambda surface: len(surface.points))
RINGS = Task("rings", "One-rings in the user's own code: mean of the neighbors", "vertex", cases, measure)
