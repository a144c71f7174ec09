"""Memory: what a build holds, and its peak, beyond the input (Linux only: it reads /proc)."""

from __future__ import annotations

import ctypes
import gc
import sys
from pathlib import Path
from typing import Any

from benchmarks.compare.peer import Peer
from benchmarks.data import load
from benchmarks.task import Case, Task, size
from benchmarks.timing import NotOfferedError, Plan, Way


def cases(plan: Plan) -> list[Case]:
    return [
        Case(f"{size(plan.large)} {order}", f"sphere-{plan.large}" + ("-shuffled" if order == "shuffled" else ""))
        for order in ("coherent", "shuffled")
    ]


def measure(peer: Peer, case: Case, plan: Plan) -> list[dict[str, Any]]:
    """A small build first, so that imports, threads and compiled code are not counted."""
    if sys.platform != "linux":
        raise NotOfferedError("memory is measured on Linux only")
    first = next(iter(peer.builds(load(f"sphere-{plan.small}")).values()))
    first.run()
    surface = load(case.mesh)
    label, way = next(iter(peer.builds(surface).items()))
    settle()
    before = status("VmRSS")
    mesh, peak = peak_of(way)
    settle()
    held = status("VmRSS") - before
    columns = getattr(peer, "column_bytes", lambda mesh: 0)(mesh)
    return [{"way": label, "note": way.note, "items": surface.n_faces, "held": held, "peak": peak, "columns": columns}]


def peak_of(way: Way) -> tuple[Any, int]:
    """What a call makes, and by how much the process was larger meanwhile than before."""
    settle()
    Path("/proc/self/clear_refs").write_text("5")
    before = status("VmRSS")
    made = way.run()
    return made, status("VmHWM") - before


def settle() -> None:
    """Give freed memory back to the system."""
    gc.collect()
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim:
        trim(0)


def status(key: str) -> int:
    """A line of /proc/self/status in bytes."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith(f"{key}:"))


MEMORY = Task("memory", "Memory of a build, beyond the input", "triangle", cases, measure, repeats=False)
