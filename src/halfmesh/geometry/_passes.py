"""A flat loop over all elements of a kind, cut into equal ranges for the threads."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from halfmesh._jit import Kernel, n_threads, parallel

if TYPE_CHECKING:
    from halfmesh.mesh.mesh import Mesh

Floats = NDArray[np.float64]

_PART = 20_000  # elements; below that a second thread costs more than it saves


def run(kernel: Kernel[Any, Any], n: int, *arguments: Any, scratch: Callable[[], tuple[Any, ...]] = tuple) -> None:
    """Call ``kernel(*arguments, *scratch(), low, high)`` on ranges that make up 0..n.

    Each call must write to its own places only; `scratch` makes the arrays that a range has for itself.
    """
    parallel(kernel.at(n), [(*arguments, *scratch(), low, high) for low, high in ranges(n)])


def ranges(n: int) -> list[tuple[int, int]]:
    """The range 0..n in equal parts, one a thread."""
    count = max(1, min(n_threads(), n // _PART))
    bounds = [n * i // count for i in range(count + 1)]
    return list(pairwise(bounds))


def points_of(mesh: Mesh) -> Floats:
    """The points in the one form that kernels are compiled for."""
    return np.require(mesh.points, dtype=np.float64, requirements=["C", "A", "W"])
