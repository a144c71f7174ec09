"""How messages name the first few of many."""

from __future__ import annotations

from typing import Any

__all__ = ["SHOWN", "listed"]

SHOWN = 3  # elements named in a message; the exception carries them all


def listed(items: Any, what: str = "") -> str:
    """``3, 8, 12, ... (40 in all)``: the first few of many."""
    items = list(items[: SHOWN + 1]) + [None] * max(0, len(items) - SHOWN - 1)
    text = ", ".join(str(i) for i in items[:SHOWN])
    return f"{what}{text}" + (f", ... ({len(items)} in all)" if len(items) > SHOWN else "")
