"""Attempts: several steps that are all taken or none, undone at a cost proportional to what they wrote."""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit import kernel
from halfmesh.core.pens import rewind
from halfmesh.core.topology import JOURNAL_SIZE, JOURNALING, N_COUNTS, NEWS

__all__ = ["begin_attempt", "end_attempt"]


@kernel
def begin_attempt(t: Any) -> Any:
    """Journal from here on, which may be going on already; returns what `end_attempt` takes."""
    before = np.empty(N_COUNTS, np.int64)
    for i in range(N_COUNTS):
        before[i] = t.counts[i]
    t.counts[JOURNALING] = 1
    return before


@kernel
def end_attempt(t: Any, before: Any, done: bool) -> None:
    """Keep what was done since, or undo it: columns, counts and notes are as they were, bit for bit."""
    if done:
        t.counts[JOURNALING] = before[JOURNALING]
        if before[JOURNALING] == 0:
            t.counts[JOURNAL_SIZE] = before[JOURNAL_SIZE]
    else:
        rewind(t, before[JOURNAL_SIZE])
        for i in range(N_COUNTS):
            if i != NEWS:  # columns that were replaced stay replaced
                t.counts[i] = before[i]
