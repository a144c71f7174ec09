"""Runs every task for every library, one process after the other, and keeps the records in `.bench/results.json`."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import Any

from benchmarks import environment
from benchmarks.data import CACHE, ROOT, load, text_file
from benchmarks.task import Case, Task
from benchmarks.tasks import TASKS
from benchmarks.timing import QUICK, Plan

Record = dict[str, Any]
LONG = 6.0  # seconds of one worker, after which further passes are not worth their time


def results_path(quick: bool) -> Path:
    return ROOT / ".bench" / ("quick.json" if quick else "results.json")


def run(
    tasks: list[str],
    peers: list[str],
    quick: bool,
    outcomes: dict[str, environment.Outcome],
    tell: Callable[[str], None],
) -> Record:
    """Measure, merge with the records of earlier runs of other tasks and libraries, save."""
    plan = QUICK if quick else Plan()
    CACHE.mkdir(parents=True, exist_ok=True)
    path = results_path(quick)
    results: Record = json.loads(path.read_text()) if path.exists() else {"libraries": {}, "records": []}
    results["machine"] = environment.facts()
    results["quick"] = quick
    told = results["libraries"] | {name: vars(outcome) for name, outcome in outcomes.items()}
    results["libraries"] = {name: told[name] for name in environment.LIBRARIES if name in told}
    for task in (TASKS[name] for name in tasks):
        kept = [old for old in results["records"] if old["task"] != task.name or old["peer"] not in peers]
        new = []
        for case in task.cases(plan):
            asked = [peer for peer in peers if case.only in ("", peer) and outcomes[peer].version]
            tell(f"{task.title}: {case.name}")
            for peer, records in compared(task, case, asked, plan).items():
                where = {"task": task.name, "case": case.name, "peer": peer, "date": results["machine"]["date"]}
                new += [where | record for record in records]
        results["records"] = kept + new
        path.write_text(json.dumps(results, indent=1))
    return results


def compared(task: Task, case: Case, peers: list[str], plan: Plan) -> dict[str, list[Record]]:
    """The records of all libraries, from several passes; what took long or failed is not asked again."""
    prepare_data(case)
    found: dict[str, list[list[Record]]] = {peer: [] for peer in peers}
    lasting = set(peers)
    for _ in range(plan.passes if task.repeats else 1):
        for peer in sorted(lasting, key=peers.index):
            start = perf_counter()
            found[peer].append(measured(task, case, peer, plan))
            if perf_counter() - start > LONG or "best" not in found[peer][0][0]:
                lasting.discard(peer)
    return {peer: merged(passes) for peer, passes in found.items()}


def merged(passes: list[list[Record]]) -> list[Record]:
    """One record per way: the best first call and the best later one, the median of the medians."""
    records = []
    for ways in zip(*passes, strict=False):
        record = dict(ways[0])
        if len(ways) > 1 and all("best" in way for way in ways):
            record |= {key: min(way[key] for way in ways) for key in ("first", "best")}
            record |= {"median": median(way["median"] for way in ways), "runs": sum(way["runs"] for way in ways)}
        records.append(record)
    return records


def measured(task: Task, case: Case, peer: str, plan: Plan) -> list[Record]:
    """The records of one worker, or why there are none."""
    with TemporaryDirectory(dir=CACHE) as folder:
        out = Path(folder) / "records.json"
        command = [str(environment.PYTHON), "-m", "benchmarks.worker", str(out), peer, task.name, case.name]
        try:
            done = subprocess.run(
                command + ["quick"] * plan.quick,
                check=False,
                cwd=ROOT,
                env=os.environ | {"HALFMESH_CACHE_DIR": str(CACHE.parent / "cache")},
                capture_output=True,
                text=True,
                timeout=task.patience,
            )
        except subprocess.TimeoutExpired:
            return [{"error": f"given up after {task.patience:.0f} s"}]
        if not out.exists():
            return [{"error": ending(done)}]
        records: list[Record] = json.loads(out.read_text())
        return records


def prepare_data(case: Case) -> None:
    """Make the case's mesh and file before any library is watched."""
    stem, dot, suffix = case.mesh.rpartition(".")
    if dot and not case.mesh.startswith("file:") and "/" not in case.mesh:
        text_file(stem, dot + suffix)
    elif case.mesh and "/" not in case.mesh:
        load(case.mesh)


def ending(done: subprocess.CompletedProcess[str]) -> str:
    if done.returncode < 0:
        return f"crashed: {signal.Signals(-done.returncode).name}"
    return f"exit code {done.returncode}: {(done.stderr.strip().splitlines() or [''])[-1][:200]}"
