"""How arguments enter a kernel, in each gear."""

from __future__ import annotations

from typing import Any, Protocol

from halfmesh._jit import gears

__all__ = ["Carrier", "Views", "arrays", "interpretable", "lowered", "refresh", "view"]


class Views:
    """The interpreted carrier: the arrays of a carrier as memoryviews, under the same names."""


class Carrier(Protocol):
    """An object that kernels take as one argument; it lends its arrays in three forms."""

    def __compiled__(self) -> Any:
        """The structref proxy; made by :func:`structref_class`."""

    def __views__(self) -> Views:
        """An object whose attributes are memoryviews."""

    def __arrays__(self) -> Any:
        """An object whose attributes are NumPy arrays."""

    def __refresh__(self) -> None:
        """Called after a compiled kernel: take the arrays anew if it made them larger."""


def lowered(argument: Any) -> Any:
    return argument.__compiled__() if hasattr(argument, "__compiled__") else argument


def interpretable(argument: Any) -> Any:
    return argument.__views__() if hasattr(argument, "__views__") else argument


def arrays(argument: Any) -> Any:
    return argument.__arrays__() if hasattr(argument, "__arrays__") else argument


def refresh(argument: Any) -> None:
    if hasattr(argument, "__refresh__"):
        argument.__refresh__()


class _StrictView:
    """A memoryview that refuses negative indices: -1 means "none" here, and must never be read through."""

    def __init__(self, array: Any) -> None:
        self._view = memoryview(array)
        self.shape = self._view.shape

    def __len__(self) -> int:
        return len(self._view)

    def __getitem__(self, key: Any) -> Any:
        return self._view[self._checked(key)]

    def __setitem__(self, key: Any, value: Any) -> None:
        self._view[self._checked(key)] = value

    @staticmethod
    def _checked(key: Any) -> Any:
        for k in key if isinstance(key, tuple) else (key,):
            if k < 0:
                raise IndexError(f"a kernel used the negative index {k}")
        return key


def view(array: Any) -> Any:
    """The interpreted gear's form of an array: elements are plain ints and floats."""
    return _StrictView(array) if gears.strict else memoryview(array)
