"""Flat loops over several threads: kernels release the GIL, so a plain pool will do.

(Numba's own workqueue layer aborts the process when two threads enter parallel kernels at once.)
"""

from __future__ import annotations

import functools
import os
from collections import deque
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from halfmesh._jit import gears

__all__ = ["in_succession", "n_threads", "parallel"]

R = TypeVar("R")


@functools.cache
def _pool() -> Any:
    from concurrent.futures import ThreadPoolExecutor

    return ThreadPoolExecutor(n_threads(), thread_name_prefix="halfmesh")


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_pool.cache_clear)  # a pool's threads do not survive a fork


def n_threads() -> int:
    """How many threads flat loops are cut into: ``$HALFMESH_NUM_THREADS``, or the processors this process may use."""
    chosen = os.environ.get("HALFMESH_NUM_THREADS")
    if chosen and chosen.isdecimal():
        return max(1, int(chosen))
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def parallel(function: Callable[..., R], jobs: list[tuple[Any, ...]]) -> list[R]:
    """Run ``function(*job)`` for every job, at the same time where it releases the GIL; the results in order."""
    if len(jobs) == 1 or n_threads() == 1 or gears.interpret_only:
        return [function(*job) for job in jobs]
    return list(_pool().map(lambda job: function(*job), jobs))


def in_succession(function: Callable[..., R], jobs: list[tuple[Any, ...]]) -> Iterator[R]:
    """The same one by one, a few jobs ahead of what was taken: for results too large to be kept."""
    if len(jobs) == 1 or n_threads() == 1 or gears.interpret_only:
        yield from (function(*job) for job in jobs)
        return
    running: deque[Any] = deque()
    for job in jobs:
        running.append(_pool().submit(function, *job))
        if len(running) > 2 * n_threads():
            yield running.popleft().result()
    while running:
        yield running.popleft().result()
