"""A task: what is measured, on which cases, and how a library is asked."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from benchmarks.compare.peer import Peer, Ways
from benchmarks.data import Surface, load
from benchmarks.timing import Plan, race


@dataclass(frozen=True)
class Case:
    """One column of a task's table; `mesh` names its data, `only` the one library that is asked (all if empty)."""

    name: str
    mesh: str = ""
    only: str = ""


@dataclass(frozen=True)
class Task:
    """`measure` returns one record per way: the fields of a `Timing`, or figures of its own."""

    name: str
    title: str
    item: str  # what a case counts: one triangle, one vertex, one step
    cases: Callable[[Plan], list[Case]]
    measure: Callable[[Peer, Case, Plan], list[dict[str, Any]]]
    patience: float = 150.0  # seconds until a library is given up
    repeats: bool = True  # whether more than one pass is of use


def racing(
    ways: Callable[[Peer, Surface], Ways], items: Callable[[Surface], int]
) -> Callable[[Peer, Case, Plan], list[dict[str, Any]]]:
    """The usual `measure`: race the library's ways on the case's mesh."""

    def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
        surface = load(case.mesh)
        return [timing.as_dict() for timing in race(ways(peer, surface), plan, items(surface))]

    return measure


def size(level: int) -> str:
    """The level of a sphere as its number of triangles."""
    return f"{20 * 4**level:,}"
