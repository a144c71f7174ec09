"""Epochs: which handles still mean their element after indices moved, or elements were taken back.

A handle is an index and the interpreted carrier it counts in. As long as elements are only added and marked as deleted
both stay good. Two things end this: compaction gives other indices to everything, and a rollback takes the last
elements back, whose indices will be given to others. The mesh then gets another carrier, and the old one is *closed*:
its columns refuse to be read, so that nothing is to be checked as long as all is well.

After a rollback most indices are good as before. So a closed carrier may name its *successor*, and below which indices
it is good there; a handle that was refused goes over to it and goes on.
"""

from __future__ import annotations

import weakref
from typing import Any

from halfmesh._jit import Views
from halfmesh.errors import StaleElementError

__all__ = ["COMPACTED", "ROLLED_BACK", "Limits", "close", "hand_over", "successor_of"]

COMPACTED = "is an index of before the mesh was compacted; take the handle anew"
ROLLED_BACK = "is an index of a transaction that was rolled back; take the handle anew"

Limits = tuple[int, int, int]  # vertices, edges, faces


class _Closed:
    """What stands in the place of every column of a carrier that is closed."""

    def __init__(self, why: str) -> None:
        self.why = why

    def __getitem__(self, key: Any) -> Any:
        raise StaleElementError(f"this {self.why}")

    __setitem__: Any = __getitem__


def close(views: Any, names: tuple[str, ...], why: str) -> None:
    """Have these columns refuse from now on."""
    closed = _Closed(why)
    for name in names:
        setattr(views, name, closed)


def hand_over(old: Any, new: Any, limits: Limits) -> None:
    """Let the handles of a closed carrier go over to another one, if their element is below the limits.

    Those that went before to the old one are led on directly: an old handle keeps no chain of carriers alive.
    """
    new.earlier = weakref.WeakSet([old, *getattr(old, "earlier", ())])
    for each in new.earlier:
        each.limits = tuple(map(min, limits, getattr(each, "limits", limits)))
        each.successor = new


def successor_of(views: Any, kind: int, index: int) -> Views | None:
    """The carrier in which an index of a kind (0 vertices, 1 edges, 2 faces) still means the same, if there is one."""
    found: Views | None = getattr(views, "successor", None)
    return found if found is not None and index < views.limits[kind] else None
