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

__all__ = ["AttributeTable", "Column"]

_CARRIER = _jit.declare_carrier("Column", ("values",))


class Column:
    """One attribute of one kind of element; kernels take it as an object with the array ``values``."""

    __slots__ = ("_proxy", "default", "values")

    def __init__(self, values: NDArray[Any], default: Any = 0) -> None:
        self.values = values
        self.default = default
        self._proxy: Any = None

    def copy(self, n: int) -> Column:
        """A column with the first n values."""
        return Column(self.values[:n].copy(), self.default)

    def __views__(self) -> Column:
        return self

    def __arrays__(self) -> Column:
        return self

    def __compiled__(self) -> Any:
        if self._proxy is None:
            self._proxy = _CARRIER.make(self.values)
        return self._proxy

    def __refresh__(self) -> None:
        (values,) = _CARRIER.take(self._proxy)
        if values.ctypes.data != self.values.ctypes.data:
            self.values = values

    def __reduce__(self) -> tuple[Any, ...]:
        return Column, (self.values, self.default)


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

    def __init__(self, kind: str, size: Callable[[], int], required: tuple[str, ...] = ()) -> None:
        self._kind = kind
        self._size = size
        self._required = required
        self._columns: dict[str, Column] = {}

    def add(
        self, name: str, dtype: DTypeLike = float, shape: tuple[int, ...] = (), *, default: Any = 0
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

        Returns
        -------
        ndarray of shape (n, *shape)
            A view: writing into it changes the attribute.

        Raises
        ------
        KeyError
            The name is taken.
        """
        if name in self._columns:
            raise KeyError(f"{self._kind} data {name!r} exists already; assign to it, or delete it first")
        values = np.empty((self._size(), *shape), dtype=_checked_dtype(dtype))
        values[...] = default
        self._set(name, Column(values, default))
        return self[name]

    def column(self, name: str) -> Column:
        """The attribute as something a kernel can grow: its array is ``.values``."""
        return self._columns[name]

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            column = self._columns[name]
        except KeyError:
            known = ", ".join(map(repr, self._columns)) or "none"
            raise KeyError(f"no {self._kind} data {name!r}; there are: {known}") from None
        return column.values[: self._size()]

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
        self._set(name, Column(array, old.default if old else 0))

    def _keep(self, name: str, values: NDArray[Any]) -> None:
        """Take an array as it is, without a copy: of the right length, in C order, and held by nobody else."""
        self._set(name, Column(values))

    def __delitem__(self, name: str) -> None:
        if name in self._required:
            raise KeyError(f"{name!r} always exists")
        self[name]
        del self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        rows = ", ".join(f"{name}: {a.dtype}{list(a.shape[1:]) or ''}" for name, a in self.items())
        return f"<{self._kind} data of {self._size()}: {rows or 'none'}>"

    @property
    def nbytes(self) -> int:
        """Bytes of all attributes of this kind."""
        return sum(a.nbytes for a in self.values())

    def _set(self, name: str, column: Column) -> None:
        if not isinstance(name, str) or not name:
            raise KeyError(f"an attribute's name is a non-empty string, not {name!r}")
        self._columns[name] = column

    def _columns_in_use(self) -> dict[str, Column]:
        """Copies without spare room."""
        return {name: column.copy(self._size()) for name, column in self._columns.items()}

    def _adopt(self, columns: dict[str, Column]) -> None:
        self._columns = columns


def _checked_dtype(dtype: DTypeLike) -> np.dtype[Any]:
    made = np.dtype(dtype)
    if made.hasobject:
        raise TypeError("attributes hold numbers, not Python objects; keep an integer label and a list beside it")
    return made.newbyteorder("=")  # compiled code knows no other
