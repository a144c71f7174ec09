"""The clock: a fair race between several ways to do one thing."""

from __future__ import annotations

import gc
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from statistics import median
from time import perf_counter
from typing import Any


class NotOfferedError(Exception):
    """The library does not offer this; the message says why."""


@dataclass(frozen=True)
class Way:
    """One way to do a task: a call, and what to know about it.

    `fresh` makes what a call takes and uses up, a mesh to be changed, before the clock starts; without it the call
    takes nothing. `items` is how many elements one call treats (its unit is the task's), 0 for the case's own number;
    `facts` turns the result of a call into figures that every library must agree on; `points` takes the coordinates
    out of it.
    """

    run: Callable[..., Any]
    note: str = ""
    items: int = 0
    facts: Callable[[Any], dict[str, float]] = lambda result: {}
    points: Callable[[Any], Any] = lambda result: None
    fresh: Callable[[], Any] | None = None


@dataclass(frozen=True)
class Plan:
    """How large: levels of the sphere, sizes of the adversarial meshes and of those that grow; how many steps through
    handles, turns of an operator and queries, random points to triangulate. How long: rounds and seconds in one
    process.

    Passes go over all libraries, each in a new process, so that a slow moment of the machine meets them all.
    """

    small: int = 6
    medium: int = 7
    large: int = 8
    adversarial: int = 100_000
    sides: int = 1_000_000
    steps: int = 200_000
    growing: tuple[int, ...] = (10_000, 100_000, 1_000_000)
    turns: int = 1_000
    points: tuple[int, ...] = (100_000, 1_000_000)
    rounds: int = 4
    seconds: float = 4.0
    passes: int = 3
    quick: bool = False


QUICK = Plan(
    small=5,
    medium=5,
    large=6,
    adversarial=10_000,
    sides=100_000,
    steps=20_000,
    growing=(1_000, 10_000, 100_000),
    points=(10_000, 50_000),
    rounds=3,
    seconds=1.0,
    passes=1,
    quick=True,
)


@dataclass
class Timing:
    """Seconds of one way: the first call apart, then the best and the median of the others."""

    way: str
    note: str
    items: int
    first: float
    best: float = 0.0
    median: float = 0.0
    runs: int = 0
    facts: dict[str, float] = field(default_factory=dict)

    as_dict = asdict


def race(ways: dict[str, Way], plan: Plan, items: int) -> list[Timing]:
    """Time the ways in turns, so that a slow moment of the machine meets them all; collect garbage before each call."""
    timings, seconds = [], {label: list[float]() for label in ways}
    for label, way in ways.items():
        elapsed, result = timed(way)
        timings.append(Timing(label, way.note, way.items or items, elapsed, facts=way.facts(result)))
        del result
    until = perf_counter() + plan.seconds
    for turn in range(plan.rounds):
        if turn and perf_counter() > until:
            break
        for label, way in ways.items():
            seconds[label].append(timed(way)[0])
    for timing in timings:
        own = seconds[timing.way]
        timing.best, timing.median, timing.runs = min(own), median(own), len(own)
    return timings


def timed(way: Way) -> tuple[float, Any]:
    taken = (way.fresh(),) if way.fresh else ()
    gc.collect()
    start = perf_counter()
    result = way.run(*taken)
    return perf_counter() - start, result
