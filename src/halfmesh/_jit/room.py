"""Making an array larger from inside a kernel, in either gear."""

from __future__ import annotations

from typing import Any

import numpy as np

from halfmesh._jit.arguments import array_of, view
from halfmesh._jit.kernels import twofold

__all__ = ["filled", "grown"]


def _grown_view(column: Any, n: int) -> Any:
    is_array = isinstance(column, np.ndarray)
    old = column if is_array else array_of(column)
    made = np.empty((n, *old.shape[1:]), old.dtype)
    made[: len(old)] = old
    return made if is_array else view(made)


@twofold(_grown_view)
def grown(column: Any, n: int) -> Any:
    """A copy of the one-dimensional array with room for `n` numbers; those that are new are not set."""
    made = np.empty(n, column.dtype)
    for i in range(len(column)):  # a slice would compile to ten times the code, and every caller links it in
        made[i] = column[i]
    return made


def _filled_view(column: Any, n: int, row: Any) -> Any:
    made = _grown_view(column, n)
    made[len(column) :] = row
    return made


@twofold(_filled_view)
def filled(column: Any, n: int, row: Any) -> Any:
    """A copy of the array with `n` rows, of which the new ones are copies of ``row``, an array of one row."""
    made = np.empty((n,) + column.shape[1:], column.dtype)  # noqa: RUF005
    made[: len(column)] = column
    made[len(column) :] = row
    return made
