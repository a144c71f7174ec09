"""What is kept of attributes while a transaction runs, so that they can be put back.

An attribute is written in two ways. The library itself writes single rows, and says which beforehand. Whoever was
handed an array writes where he likes: so a column is copied before an array of it is handed out, once. Arrays that
were handed out before the transaction began are known by their references, and their columns are copied at once.

Rows of new elements need no copy: they go back to the default.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from halfmesh.core.notes import noted_elements

if TYPE_CHECKING:
    from halfmesh.mesh.attributes import Column
    from halfmesh.mesh.policies import Policy

__all__ = ["Keeper"]

_Part = tuple[Any, NDArray[Any]]  # which rows (one, the first as a slice, or an array of indices), and their values


class _Kept:
    """One column as it was: the column itself, its array and policy, and the rows that may have been written since."""

    __slots__ = ("column", "is_whole", "name", "parts", "policy", "values")

    def __init__(self, name: str, column: Column) -> None:
        self.name, self.column = name, column
        self.values: NDArray[Any] = column.values
        self.policy: Policy = column.policy
        self.parts: list[_Part] = []  # to be put back last first
        self.is_whole = False

    def put_back(self, n: int, n_written: int, n_around: int) -> Column:
        column = self.column
        column.forget_compiled()
        if column.values is not self.values and _n_references(self.values) > _ALONE + n_around:
            column.values = self.values  # it has grown since, but others hold views of this one
        for rows, values in reversed(self.parts):
            column.values[rows] = values
        column.values[n : None if self.is_whole else n_written] = column.default
        column.policy = self.policy
        return column


class Keeper:
    """The attributes of one kind as they were at the beginning of a transaction.

    Parameters
    ----------
    columns : dict of str to Column
    n : int
        Rows in use.
    kind : int
        The kind of element in notes.
    outer : Keeper or None
        That of the transaction around this one.
    include_held : bool
        Whether to copy the columns of which somebody holds an array.
    """

    def __init__(self, columns: dict[str, Column], n: int, kind: int, outer: Keeper | None, include_held: bool) -> None:
        self.n, self.kind, self.outer = n, kind, outer
        self._kept: dict[int, _Kept] = {}
        for name in columns:  # noqa: PLC0206 - a variable for the column would be one more that holds it
            columns[name].reach(n)
            is_held = include_held and self._is_held(columns, name)
            kept = self._kept[id(columns[name])] = _Kept(name, columns[name])
            if is_held:
                self._keep_whole(kept)

    def keep_whole(self, column: Column) -> None:
        """Before an array of the column is handed out."""
        kept = self._kept.get(id(column))
        if kept is not None:  # else it was made in this transaction, and goes with it
            self._keep_whole(kept)

    def keep_row(self, column: Column, row: int) -> None:
        """Before this row may be written."""
        kept = self._kept.get(id(column))
        if kept is not None and not kept.is_whole and row < self.n:
            kept.parts.append((row, column.values[row].copy()))

    def rows_of(self, notes: NDArray[np.int32]) -> NDArray[np.int64]:
        """The rows that were there before and will be written when the notes are replayed."""
        rows = np.empty(len(notes), np.int64)
        return rows[: noted_elements.at(len(notes) // 5)(notes, len(notes), self.kind, self.n, rows)].copy()

    def keep_rows(self, column: Column, rows: NDArray[np.int64]) -> None:
        """Before these rows are written."""
        kept = self._kept.get(id(column))
        if kept is None or kept.is_whole or not len(rows):
            return
        if len(rows) < self.n:
            kept.parts.append((rows, column.values[rows]))
        else:
            self._keep_whole(kept)

    def put_back(self, n_written: int) -> dict[str, Column]:
        """The columns, with the values they had; `n_written` rows have been in use since."""
        return {
            kept.name: kept.put_back(self.n, n_written, self._n_around(kept.column, kept.values)[1])
            for kept in self._kept.values()
        }

    def absorb(self, inner: Keeper) -> None:
        """Take over what a transaction inside this one has kept: it is over, and what it wrote stays for now."""
        for key, kept in inner._kept.items():
            mine = self._kept.get(key)
            if mine is not None and not mine.is_whole:
                mine.parts += kept.parts if inner.n == self.n else _before(self.n, kept.parts)
                mine.is_whole = kept.is_whole

    @property
    def nbytes(self) -> int:
        """Bytes of what is kept."""
        return sum(values.nbytes for kept in self._kept.values() for _, values in kept.parts)

    def _keep_whole(self, kept: _Kept) -> None:
        if not kept.is_whole:
            kept.parts.append((slice(0, self.n), kept.column.values[: self.n].copy()))
            kept.is_whole = True

    def _is_held(self, columns: dict[str, Column], name: str) -> bool:
        """Whether anybody but the mesh and its transactions holds the column, or an array of its memory."""
        columns[name].forget_compiled()  # which refers to the array too
        n_columns, n_arrays = self._n_around(columns[name], columns[name].values)
        return (
            _n_references(columns[name]) > _ALONE + n_columns
            or _n_references(columns[name].values) > _ALONE + n_arrays
            or isinstance(columns[name].values.base, np.ndarray)  # what others hold may refer to that one
        )

    def _n_around(self, column: Column, values: NDArray[Any]) -> tuple[int, int]:
        """How many of the transactions around this one hold the column, and this array of it."""
        n_columns = n_arrays = 0
        keeper = self.outer
        while keeper is not None:
            kept = keeper._kept.get(id(column))
            n_columns += kept is not None
            n_arrays += kept is not None and kept.values is values
            keeper = keeper.outer
        return n_columns, n_arrays


def _before(n: int, parts: list[_Part]) -> Iterator[_Part]:
    """What was kept of the first `n` rows."""
    for rows, values in parts:
        if isinstance(rows, slice):
            yield slice(0, min(n, len(values))), values[:n]
        elif not isinstance(rows, int):
            yield rows[rows < n], values[rows < n]
        elif rows < n:
            yield rows, values


def _n_references(value: Any) -> int:
    """How often something is referred to, as seen from here: hand it over without giving it a name."""
    return sys.getrefcount(value)


_PROBE = [object()]
_ALONE = _n_references(_PROBE[0])
