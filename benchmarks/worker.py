"""One library, one task, one case, in a process of its own: `python -m benchmarks.worker OUT PEER TASK CASE [quick]`.

Runs in the environment of the libraries; crashes, hangs and memory stay in here. The records go to the file OUT.
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

from benchmarks.data import ROOT
from benchmarks.tasks import TASKS
from benchmarks.timing import QUICK, NotOfferedError, Plan


def main(out: str, peer_name: str, task_name: str, case_name: str, *options: str) -> None:
    plan = QUICK if "quick" in options else Plan()
    Path(out).write_text(json.dumps(records(peer_name, task_name, case_name, plan)))


def records(peer_name: str, task_name: str, case_name: str, plan: Plan) -> list[dict[str, Any]]:
    task = TASKS[task_name]
    case = next(case for case in task.cases(plan) if case.name == case_name)
    try:
        peer = importlib.import_module(f"benchmarks.compare.{peer_name}").peer
        return task.measure(peer, case, plan)
    except NotOfferedError as reason:
        return [{"skipped": str(reason)}]
    except Exception as error:  # every failure of a library is a result
        told = " ".join(f"{type(error).__name__}: {error}".split())
        return [{"error": told.replace(str(ROOT), ".")[:300]}]


if __name__ == "__main__":
    main(*sys.argv[1:])
