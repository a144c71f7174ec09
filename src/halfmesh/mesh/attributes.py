"""Named arrays on the elements of a mesh: one table for each kind of element.

A *column* keeps its values in an array that may be longer than there are elements, so that it can grow at an amortised
constant cost; ``table[name]`` is a view of the part in use. A kernel that is to grow a column takes the column itself,
``table.column(name)``, and finds the array as ``.values``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, MutableMapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from halfmesh import _jit
from halfmesh.errors import InvalidMeshError
from halfmesh.mesh.keeping import Keeper
from halfmesh.mesh.policies import Policy, checked_policy, default_policy, replay

__all__ = ["AttributeTable", "Column", "positions_at"]

_CARRIER = _jit.declare_carrier("Column", ("values", "default"), growing=_jit.filled)
positions_at = _CARRIER.at(("f8", 2), ("f8", 2))


class Column:
    """One attribute of one kind of element, as a kernel takes it that gives values to elements it makes.

    In the kernel ``column[i]`` is the value of element `i`, and ``column[i] = x`` or ``column[i, k] = x`` sets it; a
    column that is too short grows by itself. ``column.values`` is the array, which may be longer than there are
    elements: the quickest, for elements that were there before.
    """

    __slots__ = ("default", "lowered", "policy", "values")

    def __init__(self, values: NDArray[Any], default: Any = 0, policy: Policy | None = None) -> None:
        self.values = values
        self.default = np.empty((1, *values.shape[1:]), values.dtype)
        self.default[...] = default
        self.policy = default_policy(values.dtype) if policy is None else checked_policy(policy, values.dtype)
        self.lowered: Any = None  # the compiled form, once it was asked for

    @property
    def form(self) -> str:
        """Dtype and shape of a value, as text."""
        return f"{self.values.dtype}{list(self.values.shape[1:]) or ''}"

    def copy(self, n: int) -> Column:
        """A column with the first n values."""
        self.reach(n)
        return Column(self.values[:n].copy(), self.default, self.policy)

    def reach(self, n: int) -> None:
        """Make the column at least as long, with new values at the default."""
        if n > len(self.values):
            made = np.empty((max(n, 2 * len(self.values), 16), *self.values.shape[1:]), self.values.dtype)
            made[: len(self.values)] = self.values
            made[len(self.values) :] = self.default
            self.values, self.lowered = made, None

    def forget_compiled(self) -> None:
        """Let the compiled form go, which refers to the column's array."""
        if self.lowered is not None:
            self.__refresh__((), compiled=True)
            self.lowered = None

    def __getitem__(self, key: Any) -> Any:
        return self.values[key]

    def __setitem__(self, key: Any, value: Any) -> None:
        self.reach((key[0] if isinstance(key, tuple) else key) + 1)
        self.values[key] = value

    def __views__(self) -> Column:
        return self

    def __arrays__(self) -> Column:
        return self

    def __compiled__(self) -> Any:
        if self.lowered is None:
            self.lowered = _CARRIER.make(self.values, self.default)
        return self.lowered

    def catch_up(self) -> None:
        """Take the array from the compiled form, in which it has grown."""
        self.__refresh__((), compiled=True)

    def __refresh__(self, args: tuple[Any, ...], compiled: bool) -> None:
        if compiled and self.lowered is not None:
            values = _CARRIER.take(self.lowered)[0]
            if values.ctypes.data != self.values.ctypes.data:
                self.values = values

    def __reduce__(self) -> tuple[Any, ...]:
        return Column, (self.values, self.default, self.policy)


class AttributeTable(MutableMapping[str, NDArray[Any]]):
    """The attributes of the vertices, halfedges, edges or faces of a mesh, by name.

    Row `i` belongs to the element with index `i`. The arrays are views: writing into one changes the mesh.

    Examples
    --------
    >>> import numpy as np, halfmesh as hm
    >>> mesh = hm.shapes.cube()
    >>> mesh.face_data["area"] = hm.geometry.face_areas(mesh)
    >>> float(mesh.face_data["area"].sum())
    6.0
    >>> weights = mesh.vertex_data.add("weight", float, default=1.0)
    >>> weights[3] = 2.0
    >>> float(mesh.vertex_data["weight"].sum())
    9.0
    """

    def __init__(
        self,
        kind: str,
        size: Callable[[], int],
        required: tuple[str, ...] = (),
        tell: Callable[[bool], None] = lambda there_are: None,
    ) -> None:
        self._kind = kind
        self._size = size
        self._tell = tell
        self._required = required
        self._columns: dict[str, Column] = {}
        self._keeper: Keeper | None = None  # of the innermost transaction, if there is any

    def add(
        self,
        name: str,
        dtype: DTypeLike = float,
        shape: tuple[int, ...] = (),
        *,
        default: Any = 0,
        policy: Policy | None = None,
    ) -> NDArray[Any]:
        """Create an attribute.

        Parameters
        ----------
        name : str
            A new name.
        dtype : dtype
            Any NumPy dtype but object.
        shape : tuple of int
            Shape of one element's value; () for a number.
        default : scalar or array of that shape
            The value of every element, and of elements that will be added.
        policy : str or callable, optional
            How values follow when elements are made and joined; see :attr:`policies`.

        Returns
        -------
        ndarray of shape (n, *shape)
            A view: writing into it changes the attribute.

        Raises
        ------
        KeyError
            The name is taken.
        ValueError
            There is no such policy, or the dtype can't follow by it.
        """
        if name in self._columns:
            raise KeyError(f"{self._kind} data {name!r} exists already; assign to it, or delete it first")
        values = np.empty((self._size(), *shape), dtype=_checked_dtype(dtype))
        values[...] = default
        self._set(name, Column(values, default, policy))
        return self[name]

    def set_policy(self, name: str, policy: Policy) -> None:
        """Have the attribute follow by another policy from now on.

        Parameters
        ----------
        name : str
        policy : str or callable
            One of ``lerp mean copy sum min max first nearest normalize``, or a function ``f(values, weights)`` that
            gives the value of an element from those of its sources, of shapes ``(n, *shape)`` and ``(n,)``. If it
            raises, so does the operator, which is done nevertheless; only this attribute did not follow. Floats start
            with ``lerp``, everything else with ``copy``.

        Raises
        ------
        KeyError
            There is no such attribute.
        ValueError
            There is no such policy, or the dtype can't follow by it.
        """
        column = self._found(name)
        column.policy = checked_policy(policy, column.values.dtype)

    @property
    def policies(self) -> dict[str, Policy]:
        """The policy of each attribute."""
        return {name: column.policy for name, column in self._columns.items()}

    def column(self, name: str) -> Column:
        """The attribute as something a kernel can grow: its array is ``.values``."""
        column = self._found(name)
        if self._keeper is not None:
            self._keeper.keep_whole(column)
        return column

    def __getitem__(self, name: str) -> NDArray[Any]:
        column = self._found(name)
        if self._keeper is not None:
            self._keeper.keep_whole(column)
        return self._in_use(column)

    def peek(self, name: str) -> NDArray[Any]:
        """The same array, to be read and not kept: a transaction does not make a copy for it."""
        return self._in_use(self._found(name))

    def row(self, name: str, index: int) -> Any:
        """The value of one element, to be read and written: a transaction keeps this row only."""
        column = self._found(name)
        if self._keeper is not None:
            self._keeper.keep_row(column, index)
        return self._in_use(column)[index]

    def _found(self, name: str) -> Column:
        try:
            return self._columns[name]
        except KeyError:
            known = ", ".join(map(repr, self._columns)) or "none"
            raise KeyError(f"no {self._kind} data {name!r}; there are: {known}") from None

    def _in_use(self, column: Column) -> NDArray[Any]:
        n = self._size()
        if n > len(column.values):
            column.reach(n)
        return column.values[:n]

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        array = np.array(values, order="C")
        array = array.astype(_checked_dtype(array.dtype), copy=False)
        if array.ndim == 0 or len(array) != self._size():
            raise InvalidMeshError(
                f"{self._kind} data {name!r} needs {self._size()} rows, one per {self._kind}; got shape {array.shape}",
                reason="bad_attribute",
            )
        old = self._columns.get(name)
        if (
            old
            and name in self._required
            and (array.shape[1:], array.dtype) != (old.values.shape[1:], old.values.dtype)
        ):
            raise InvalidMeshError(
                f"{name!r} stays {old.values.dtype} of shape (n, {old.values.shape[1]})", reason="bad_attribute"
            )
        same = old is not None and (old.values.dtype, old.values.shape[1:]) == (array.dtype, array.shape[1:])
        self._set(name, Column(array, old.default, old.policy) if old is not None and same else Column(array))

    def _keep(self, name: str, values: NDArray[Any]) -> None:
        """Take an array as it is, without a copy: of the right length, in C order, and held by nobody else."""
        self._set(name, Column(values))

    def __delitem__(self, name: str) -> None:
        if name in self._required:
            raise KeyError(f"{name!r} always exists")
        self._found(name)
        self._forget_compiled()
        del self._columns[name]
        self._tell(bool(self._columns))

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = ", ".join(f"{name}: {a.dtype}{list(a.shape[1:]) or ''}" for name, a in self._peeked())
        return f"<{self._kind} data of {self._size()}: {rows or 'none'}>"

    @property
    def nbytes(self) -> int:
        """Bytes of all attributes of this kind."""
        return sum(a.nbytes for _, a in self._peeked())

    def _peeked(self) -> list[tuple[str, NDArray[Any]]]:
        return [(name, self._in_use(column)) for name, column in self._columns.items()]

    def _set(self, name: str, column: Column) -> None:
        if not isinstance(name, str) or not name:
            raise KeyError(f"an attribute's name is a non-empty string, not {name!r}")
        self._forget_compiled()
        self._columns[name] = column
        self._tell(True)

    def _forget_compiled(self) -> None:
        """Before there are other columns: by that, who holds a compiled form of one (`desk`) sees it is out of date."""
        for column in self._columns.values():
            column.forget_compiled()

    def _is_followed(self, args: tuple[Any, ...]) -> bool:
        """Whether any attribute is not among the arguments of a kernel, and so has to follow by its notes."""
        return any(not any(column is a for a in args) for column in self._columns.values())

    def _replay(self, kind: int, notes: Any, weights: Any, args: tuple[Any, ...]) -> None:
        """Let all but the attributes that the kernel took itself follow its notes.

        Where a function of the user's raises, its attribute is left and the others follow.
        """
        failed = None
        rows = self._keeper.rows_of(notes) if self._keeper is not None and self._columns else None
        for column in self._columns.values():
            if not any(column is a for a in args):
                if self._keeper is not None and rows is not None:
                    self._keeper.keep_rows(column, rows)
                try:
                    replay(self._in_use(column), column.policy, kind, notes, weights)
                except Exception as error:
                    failed = failed or error
        if failed is not None:
            raise failed

    def _permute(self, new_of_old: NDArray[np.int32]) -> None:
        """Keep the rows of the living, after compaction."""
        living = np.flatnonzero(new_of_old >= 0)
        self._forget_compiled()
        for name, column in self._columns.items():
            column.reach(len(new_of_old))
            self._columns[name] = Column(column.values[living], column.default, column.policy)

    def _check_fits(self, other: AttributeTable) -> None:
        """Refuse another table with an attribute of the same name that is of another kind."""
        for name, theirs in other._columns.items():
            mine = self._columns.get(name)
            if mine is not None and mine.form != theirs.form:
                raise InvalidMeshError(
                    f"{self._kind} data {name!r} is {mine.form} here and {theirs.form} in the other mesh; "
                    "convert one of them first",
                    reason="bad_attribute",
                )

    def _append(self, others: dict[str, Column]) -> None:
        """Take over the rows of the elements that were appended: all these have equally many, the last ones here."""
        n = self._size()
        for name, theirs in others.items():
            if name not in self._columns:
                self._set(name, Column(theirs.values[:0], theirs.default, theirs.policy))
        for name, column in self._columns.items():
            column.reach(n)
            if name in others:
                rows = others[name].values
                column.values[n - len(rows) : n] = rows

    def _put(self, name: str, first: int, rows: NDArray[Any]) -> None:
        """Give values to new elements, from this one on."""
        column = self._columns[name]
        column.reach(first + len(rows))
        column.values[first : first + len(rows)] = rows

    def _columns_of(self, indices: NDArray[np.int64]) -> dict[str, Column]:
        """Copies with the rows of these elements only."""
        n = self._size()
        for column in self._columns.values():
            column.reach(n)
        return {name: Column(c.values[indices], c.default, c.policy) for name, c in self._columns.items()}

    def _columns_in_use(self) -> dict[str, Column]:
        """Copies without spare room."""
        return {name: column.copy(self._size()) for name, column in self._columns.items()}

    def _keeper_from_now(self, kind: int, include_held: bool) -> Keeper:
        """What keeps, from when it is put in place, that which is written; those around it keep no more meanwhile."""
        return Keeper(self._columns, self._size(), kind, self._keeper, include_held)

    def _end_keeping(self) -> None:
        """End the innermost transaction; what was written stays."""
        keeper = self._keeper
        assert keeper is not None
        self._keeper = keeper.outer
        if self._keeper is not None:
            self._keeper.absorb(keeper)

    def _put_back(self, n_written: int) -> None:
        """End it, and take the attributes of its beginning; there have been so many rows since."""
        keeper = self._keeper
        assert keeper is not None
        self._keeper = keeper.outer
        self._adopt(keeper.put_back(n_written))

    def _adopt(self, columns: dict[str, Column]) -> None:
        self._forget_compiled()
        self._columns = columns
        self._tell(bool(columns))


def _checked_dtype(dtype: DTypeLike) -> np.dtype[Any]:
    made = np.dtype(dtype)
    if made.hasobject:
        raise TypeError("attributes hold numbers, not Python objects; keep an integer label and a list beside it")
    return made.newbyteorder("=")  # compiled code knows no other
