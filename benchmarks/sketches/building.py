"""Where the time of building goes: processor time of each pass, and of a plain loop that fills as much memory.

Processor time of all threads, the least of several runs: steadier than the clock where others use the machine too.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numba
import numpy as np

import halfmesh as hm
from benchmarks.data import load
from halfmesh.core import construction, matching

RUNS = 9

spent: dict[str, float] = {}


@numba.njit(error_model="numpy", nogil=True)
def fill(column: Any) -> None:
    for i in range(len(column)):
        column[i] = i


def listened(parallel: Callable[..., Any]) -> Callable[..., Any]:
    """The same, and it adds up what the jobs of each kernel take."""

    def run(function: Callable[..., Any], jobs: list[tuple[Any, ...]]) -> list[Any]:
        def timed(*arguments: Any) -> tuple[Any, str, float]:
            before = time.thread_time()
            result = function(*arguments)
            bound = arguments[0] if function is construction._do else function
            return result, bound.__self__.__name__, time.thread_time() - before

        results = parallel(timed, jobs)
        for _, name, seconds in results:
            spent[name] = spent.get(name, 0.0) + seconds
        return [result for result, _, _ in results]

    return run


def least(action: Callable[[], Any]) -> dict[str, float]:
    runs = []
    for _ in range(RUNS + 1):
        spent.clear()
        before = time.process_time()
        made = action()
        spent["the whole"] = time.process_time() - before
        del made
        runs.append(dict(spent))
    return {name: 1e3 * min(run[name] for run in runs[1:]) for name in runs[-1]}


def main() -> None:
    for module in (matching, construction):
        module.parallel = listened(module.parallel)  # type: ignore[attr-defined]
    for order in ("", "-shuffled"):
        faces, points = load(f"sphere-8{order}")
        print(f"{len(faces):,} triangles{order}, milliseconds of processor time")
        for name, ms in least(lambda: hm.Mesh(faces, points)).items():  # noqa: B023 - called at once
            print(f"  {name.lstrip('_').replace('_', ' '):20}{ms:8.1f}")
    size = hm.Mesh(faces, points).topology.nbytes // 4
    kept = np.zeros(size, np.int32)
    print(f"filling {4 * size / 1e6:.0f} MB with a counter")
    print(f"  {'kept memory':20}{least(lambda: fill(kept))['the whole']:8.1f}")
    print(f"  {'fresh memory':20}{least(lambda: fill(np.empty(size, np.int32)))['the whole']:8.1f}")


if __name__ == "__main__":
    main()
