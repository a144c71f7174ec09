"""Operators in a kernel: split every face and collapse it back; every fifth edge flipped where it may be.

The C++ of others can't run here: its figures are quoted, not measured.
"""

from __future__ import annotations

from typing import Any

from benchmarks.task import Case, Task, racing, size
from benchmarks.timing import Plan

Record = dict[str, Any]

SPLIT = "split every face, collapse back, compact"
FLIP = "flip every fifth edge"

# Seconds by C++ compiled with -O3 on a machine with 2 cores of 2.5 GHz, icosphere of 327,680 triangles; 98,072 flips.
QUOTED_TRIANGLES = 327_680
QUOTED = {SPLIT: {"pmp": 0.519, "OpenMesh": 2.498}, FLIP: {"pmp": 0.042, "OpenMesh": 0.142}}


def operations(record: Record) -> int:
    """How many collapses or flips there were."""
    return int(record["facts"].get("collapses") or record["facts"]["flips"])


def cases(plan: Plan) -> list[Case]:
    name = f"sphere-{plan.medium}"
    return [
        Case(f"{size(plan.medium)} {order}", name + ("-shuffled" if order == "shuffled" else ""), "halfmesh")
        for order in ("coherent", "shuffled")
    ]


measure = racing(lambda peer, surface: peer.operators(surface), items=lambda surface: surface.n_faces)
OPERATORS = Task("operators", "Operators in a kernel", "operation", cases, measure)
