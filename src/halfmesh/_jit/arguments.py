"""How arguments enter a kernel, in each gear."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np

from halfmesh._jit import gears

__all__ = [
    "Carrier",
    "Views",
    "announce",
    "array_of",
    "arrays",
    "interpretable",
    "is_bound",
    "lowered",
    "refresh",
    "view",
]


class Views:
    """The interpreted carrier: the arrays of a carrier as memoryviews, under the same names."""

    rules: Mapping[Any, Any] = {}
    """The rules that mean another kernel on this carrier, see `CarrierType.bind`."""

    def ask(self, rule: Any, index: int) -> Any:
        """The answer of a rule, interpreted, whatever it means here."""
        return rule.bound(self, index)


def is_bound(form: Any) -> bool:
    """Whether rules are bound anew for this argument, in its interpreted form."""
    return isinstance(form, Views) and bool(form.rules)


class Carrier(Protocol):
    """An object that kernels take as one argument; it lends its arrays in three forms."""

    def __compiled__(self) -> Any:
        """The structref proxy; made by :func:`structref_class`."""

    def __views__(self) -> Views:
        """An object whose attributes are memoryviews."""

    def __arrays__(self) -> Any:
        """An object whose attributes are NumPy arrays."""

    def __announce__(self, args: tuple[Any, ...]) -> None:
        """Called before a kernel runs on these arguments, of which this is one."""

    def __refresh__(self, args: tuple[Any, ...], compiled: bool) -> None:
        """Called after the kernel: take the arrays anew, from the gear that ran, if it made them larger."""


def lowered(argument: Any) -> Any:
    return argument.__compiled__() if hasattr(argument, "__compiled__") else argument


def interpretable(argument: Any) -> Any:
    return argument.__views__() if hasattr(argument, "__views__") else argument


def arrays(argument: Any) -> Any:
    return argument.__arrays__() if hasattr(argument, "__arrays__") else argument


def announce(args: tuple[Any, ...]) -> None:
    for argument in args:
        if hasattr(argument, "__announce__"):
            argument.__announce__(args)


def refresh(args: tuple[Any, ...], *, compiled: bool) -> None:
    for argument in args:
        if hasattr(argument, "__refresh__"):
            argument.__refresh__(args, compiled)


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


def array_of(view: Any) -> Any:
    """The array behind a view, sharing its memory."""
    return np.asarray(view._view if isinstance(view, _StrictView) else view)
