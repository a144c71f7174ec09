"""First use: imports in fresh interpreters; and halfmesh on an empty cache and on a warm one."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import CACHE, load, text_file
from benchmarks.task import Case, Task, size
from benchmarks.timing import Plan, Timing, Way, race

SMALL_FILE = 2  # level of the sphere in the small file: 320 triangles


def cases(plan: Plan) -> list[Case]:
    ours = ["info on a small file", f"first build of {size(plan.medium)}", "warmup"]
    return [Case("import")] + [Case(name, only="halfmesh") for name in ours]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    if case.name == "import":
        return imports(peer, plan)
    if case.name.startswith("info"):
        file = str(text_file(f"sphere-{SMALL_FILE}", ".off"))
        return empty_then_warm([halfmesh_command(), "info", file], plan.rounds)
    if case.name.startswith("first build"):
        load(f"sphere-{plan.medium}")
        return empty_then_warm([sys.executable, "-c", FIRST_BUILD, f"sphere-{plan.medium}"], 3)
    return empty_then_warm([halfmesh_command(), "warmup"], 1)


FIRST_BUILD = """
import sys, halfmesh
from benchmarks.data import load
surface = load(sys.argv[1])
halfmesh.Mesh(surface.faces, surface.points)
"""


def imports(peer: Peer, plan: Plan) -> list[dict[str, Any]]:
    """The import of a library beside NumPy's, each in an interpreter of its own, in turns."""
    programs = ("pass", "import numpy", f"import {peer.module}")
    bare, numpy, own = race({text: Way(partial(wall, [sys.executable, "-c", text])) for text in programs}, plan, 1)
    record = own.as_dict() | {"numpy": numpy.best - bare.best, "numba": loads_numba(peer.module)}
    return [record | {key: record[key] - bare.best for key in ("first", "best", "median")}]


def loads_numba(module: str) -> bool:
    text = f"import sys, {module}; print('numba' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True)
    return done.stdout.split()[-1] == "True"


def empty_then_warm(command: list[str], rounds: int) -> list[dict[str, Any]]:
    """Seconds of a whole process: `first` on an empty cache, the others on the cache that it left."""
    with TemporaryDirectory(dir=CACHE) as cache:
        seconds = [wall(command, HALFMESH_CACHE_DIR=cache) for _ in range(rounds + 1)]
    warm = sorted(seconds[1:])
    timing = Timing("whole process", "first: empty cache", 1, seconds[0], warm[0], warm[len(warm) // 2], rounds)
    return [timing.as_dict()]


def wall(command: list[str], **variables: str) -> float:
    """Seconds of a whole process, the interpreter's start included."""
    start = perf_counter()
    # what an interpreter keeps of a module after its first import is part of every use but the first
    kept = {"PYTHONDONTWRITEBYTECODE": "", "PYTHONPYCACHEPREFIX": str(CACHE.parent / "bytecode")}
    done = subprocess.run(command, check=False, capture_output=True, text=True, env=os.environ | kept | variables)
    elapsed = perf_counter() - start
    if done.returncode:
        raise RuntimeError(f"exit code {done.returncode}: {(done.stderr.strip().splitlines() or [''])[-1]}")
    return elapsed


def halfmesh_command() -> str:
    return str(Path(sys.executable).with_name("halfmesh"))


FIRST_USE = Task("first_use", "First use", "call", cases, measure, patience=300, repeats=False)
