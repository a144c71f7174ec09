"""Vertex normals, from the built mesh."""

from __future__ import annotations

from benchmarks.task import Case, Task, racing, size
from benchmarks.timing import Plan


def cases(plan: Plan) -> list[Case]:
    levels = sorted({plan.small, plan.medium})
    return [Case(f"{size(level)} coherent", f"sphere-{level}") for level in levels]


measure = racing(lambda peer, surface: peer.normals(surface), items=lambda surface: len(surface.points))
NORMALS = Task("normals", "Vertex normals", "vertex", cases, measure)
