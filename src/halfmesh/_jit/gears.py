"""Which gear is chosen, for the whole process; read the switches as attributes of this module."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Iterator

__all__ = ["ENOUGH", "SMALL", "always_compile", "compiling_always", "interpret_only", "strict"]

SMALL = 3000  # elements; below it an interpreted pass (about 1 us per element and step) beats importing Numba (0.4 s)

ENOUGH = 10_000  # elements; a kernel that has interpreted so many of them, in small inputs, is compiled after all


def _is_set(name: str) -> bool:
    return os.environ.get(name, "0") not in ("", "0")


interpret_only = _is_set("NUMBA_DISABLE_JIT")
strict = _is_set("HALFMESH_STRICT")  # interpreted kernels may not use negative indices
always_compile = False


@contextlib.contextmanager
def compiling_always() -> Iterator[None]:
    """Within this context even the smallest input is compiled: how ``halfmesh warmup`` fills the cache."""
    gears = sys.modules[__name__]
    before = always_compile
    setattr(gears, "always_compile", True)  # noqa: B010 - the switch of this very module
    try:
        yield
    finally:
        setattr(gears, "always_compile", before)  # noqa: B010
